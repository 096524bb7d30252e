// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/media/splatScene.h"

#include "hdDelegate/embree/embreeGroup.h"
#include "hdDelegate/embree/surfaceSpace.h"
#include "hdDelegate/scene/instancerCheck.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

template <class Visit> void forCorners(const RTCBounds& b, const mat4& m, const Visit& visit) {
    for (int corner = 0; corner < 8; ++corner)
        visit(vec3(m * vec4((corner & 1) ? b.upper_x : b.lower_x,
                            (corner & 2) ? b.upper_y : b.lower_y,
                            (corner & 4) ? b.upper_z : b.lower_z, 1.0f)));
}

} // namespace

void MovingPlace::enter(const std::vector<mat4>& around) {
    const int count = int(std::max(toWorld.size(), around.size()));
    std::vector<mat4> steps;
    for (int s = 0; s < count; ++s)
        steps.push_back(transformAtStep(around, s, count) * transformAtStep(toWorld, s, count));
    toWorld = std::move(steps);
}

mat4 SplatScene::Placed::worldToLocal(float time) const {
    if (toWorld.size() == 1) return toLocal;
    const float x = time * float(toWorld.size() - 1);
    const size_t i = std::min(size_t(x), toWorld.size() - 2);
    const float f = x - float(i);
    return glm::inverse(toWorld[i] * (1.0f - f) + toWorld[i + 1] * f);
}

void SplatScene::clear() {
    if (_scene) rtcReleaseScene(_scene);
    _scene = nullptr;
    _placed.clear();
    _lights.clear();
    _trees.clear();
    _bytes = 0;
    _min = vec3(INFINITY);
    _max = vec3(-INFINITY);
}

void SplatScene::place(const Prim& prim, const std::shared_ptr<const SplatTree>& tree,
                       const PlacesOf& placesOf, float open, float close, const dvec3& origin,
                       const RenderingSpace& space, Diagnostics& diagnostics) {
    const Splats& splats = *prim.splats;
    MotionTransform transform = splats.transform;
    for (dmat4& m : transform.values)
        m[3] = m * glm::dvec4(tree->kernels().middle(), 1.0);
    const std::vector<mat4> own =
        resample(transform, open, close, splats.group.empty() ? origin : dvec3(0.0));
    const ColorTransformPtr toRendering = transformOf(splats, space, diagnostics);
    bool unusable = false;
    for (MovingPlace around : placesOf(splats.group)) {
        MovingPlace here;
        here.toWorld = own;
        here.enter(around.toWorld);
        Placed placed{tree,
                      std::move(here.toWorld),
                      mat4(1.0f),
                      splats.visibility.mask() & around.mask,
                      splats.catching.matte || around.matte,
                      prim.id,
                      toRendering};
        bool usable = true;
        vec3 lower(INFINITY), upper(-INFINITY);
        for (const mat4& m : placed.toWorld) {
            usable &= hasInverse(m);
            forCorners(tree->bounds(), m, [&](const vec3& corner) {
                lower = glm::min(lower, corner);
                upper = glm::max(upper, corner);
            });
        }
        usable &= glm::length(lower) <= largestPlace && glm::length(upper) <= largestPlace;
        unusable |= !usable;
        if (!usable || placed.mask == 0) continue;
        placed.toLocal = glm::inverse(placed.toWorld[0]);
        _min = glm::min(_min, lower);
        _max = glm::max(_max, upper);
        _placed.push_back(std::move(placed));
    }
    if (unusable) diagnostics.warn(splats.path, "transform", messages::splatsWithoutInverse);
}

void SplatScene::update(RTCDevice device, CompiledSplats& compiled, const std::vector<Prim>& prims,
                        const PlacesOf& placesOf, float open, float close, const dvec3& origin,
                        const RenderingSpace& space, const std::atomic<bool>& stop,
                        Diagnostics& diagnostics) {
    auto known = std::move(_trees), used = decltype(_trees)();
    clear();
    for (const Prim& prim : prims) {
        auto& tree = known[prim.splats->cloud];
        if (!tree) {
            const auto made =
                std::make_shared<SplatTree>(device, compiled.kernels(prim.splats->cloud), stop);
            if (stop) { // the next update finds those that are complete
                _placed.clear();
                _trees = std::move(known);
                return;
            }
            tree = made;
        }
        used[prim.splats->cloud] = tree;
        if (tree->scene()) place(prim, tree, placesOf, open, close, origin, space, diagnostics);
    }
    _trees = std::move(used);
    for (const auto& item : _trees)
        _bytes += item.second->kernels().list().capacity() * sizeof(SplatKernel);
    if (_placed.empty()) return;
    // Kinds of rays differ in what they see, but not in what light samples find.
    const bool all = std::all_of(_placed.begin(), _placed.end(), [](const Placed& placed) {
        return (placed.mask & RayIndirect) == RayIndirect;
    });
    for (const Placed& placed : _placed)
        if (all) _lights.add(placed.tree->kernels(), placed.toWorld[0], _placed.size());
    size_t steps = 1;
    for (const Placed& placed : _placed)
        steps = std::max(steps, placed.toWorld.size());
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, unsigned(_placed.size()));
    rtcSetGeometryMask(geometry, ~0u);
    rtcSetGeometryTimeStepCount(geometry, unsigned(steps));
    for (Placed& placed : _placed) { // they share the steps
        std::vector<mat4> shared;
        for (size_t s = 0; s < steps && placed.toWorld.size() > 1; ++s)
            shared.push_back(transformAtStep(placed.toWorld, int(s), int(steps)));
        if (!shared.empty()) placed.toWorld = std::move(shared);
    }
    rtcSetGeometryUserData(geometry, this);
    rtcSetGeometryBoundsFunction(geometry, boundsOf, nullptr);
    rtcSetGeometryIntersectFunction(geometry, enter);
    rtcCommitGeometry(geometry);
    _scene = rtcNewScene(device);
    rtcSetSceneFlags(_scene, RTC_SCENE_FLAG_ROBUST);
    rtcAttachGeometry(_scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(_scene);
}

void SplatScene::boundsOf(const RTCBoundsFunctionArguments* args) {
    const auto& self = *static_cast<const SplatScene*>(args->geometryUserPtr);
    const Placed& placed = self._placed[args->primID];
    const mat4& m = placed.toWorld[std::min<size_t>(args->timeStep, placed.toWorld.size() - 1)];
    vec3 lower(INFINITY), upper(-INFINITY);
    forCorners(placed.tree->bounds(), m, [&](const vec3& corner) {
        lower = glm::min(lower, corner);
        upper = glm::max(upper, corner);
    });
    const vec3 slack = 1e-5f * glm::max(glm::abs(lower), glm::abs(upper));
    lower -= slack;
    upper += slack;
    RTCBounds& b = *args->bounds_o;
    b.lower_x = lower.x, b.lower_y = lower.y, b.lower_z = lower.z;
    b.upper_x = upper.x, b.upper_y = upper.y, b.upper_z = upper.z;
}

void SplatScene::enter(const RTCIntersectFunctionNArguments* args) {
    if (!args->valid[0]) return;
    auto& query = *reinterpret_cast<SplatQuery*>(args->context);
    const auto& self = *static_cast<const SplatScene*>(query.scene);
    const Placed& placed = self._placed[args->primID];
    RTCRay& ray = reinterpret_cast<RTCRayHit*>(args->rayhit)->ray;
    if ((placed.mask & ray.mask) == 0) return;
    const mat4 toLocal = placed.worldToLocal(ray.time);
    const vec3 o = vec3(toLocal * vec4(ray.org_x, ray.org_y, ray.org_z, 1.0f));
    const vec3 d = mat3(toLocal) * vec3(ray.dir_x, ray.dir_y, ray.dir_z);
    RTCRayHit local;
    local.ray = {o.x, o.y, o.z, ray.tnear, d.x, d.y, d.z, 0.0f, ray.tfar, ~0u, 0, 0};
    local.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    local.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    if (!isTraceable(local.ray, largestTraced)) return;
    query.place = args->primID;
    embreeIntersect(placed.tree->scene(), &query.base, &local);
    ray.tfar = local.ray.tfar;
}

void SplatScene::trace(const Ray& ray, SplatQuery& query) const {
    initContext(&query.base);
    query.scene = this;
    const float near =
        std::max(ray.near, query.after.distance * (1.0f - SplatQuery::slack)); // -inf at first
    RTCRayHit rayHit;
    rayHit.ray = {ray.origin.x,
                  ray.origin.y,
                  ray.origin.z,
                  near,
                  ray.direction.x,
                  ray.direction.y,
                  ray.direction.z,
                  ray.time,
                  ray.far,
                  ray.rays,
                  0,
                  0};
    rayHit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rayHit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    if (isTraceable(rayHit.ray, largestTraced)) embreeIntersect(_scene, &query.base, &rayHit);
}

void SplatScene::gather(const Ray& ray, SplatQuery& query) const {
    query.count = 0;
    if (!empty()) trace(ray, query);
}

float SplatScene::transmittance(const Ray& ray) const {
    if (empty()) return 1.0f;
    SplatQuery query;
    query.sums = true;
    query.after.distance = -INFINITY;
    trace(ray, query);
    const double left = std::exp(-double(query.depth) / SplatQuery::perUnit);
    return left < double(shSplats::SPLAT_END) ? 0.0f : float(left);
}

vec3 SplatScene::Look::radiance(const SplatHit& hit) {
    const Placed& placed = _scene._placed[hit.place];
    if (_place != int64_t(hit.place)) {
        _place = hit.place;
        _basis = shSplats::splatBasis(
            glm::normalize(mat3(placed.worldToLocal(_ray.time)) * _ray.direction));
    }
    vec3 color = placed.tree->kernels().radiance(hit.kernel, _basis);
    if (placed.toRendering) placed.toRendering->apply(&color.x, 1, 3);
    return color;
}

} // namespace patina
