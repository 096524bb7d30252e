// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/media/splatTree.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

bool goesOn(void* stop, double) {
    return !*static_cast<const std::atomic<bool>*>(stop);
}

} // namespace

void SplatQuery::add(const SplatHit& hit, float& far) {
    if (sums) {
        constexpr double most = 64.0; // of one kernel; far beyond SPLAT_END
        depth += int64_t(std::min(-std::log1p(-double(hit.alpha)), most) * perUnit);
        if (double(depth) > -std::log(double(shSplats::SPLAT_END)) * perUnit) far = -INFINITY;
        return;
    }
    if (!after.isBefore(hit)) return;
    if (count == most && !hit.isBefore(hits[most - 1])) return;
    int i = count < most ? count++ : most - 1;
    for (; i > 0 && hit.isBefore(hits[i - 1]); --i)
        hits[i] = hits[i - 1];
    hits[i] = hit;
    // What a ray enters behind the last hit is densest behind it, too; but for rounding.
    if (count == most) far = hits[most - 1].distance * (1.0f + slack);
}

SplatTree::SplatTree(RTCDevice device, std::shared_ptr<const SplatKernels> kernels,
                     const std::atomic<bool>& stop)
    : _kernels(std::move(kernels)) {
    if (_kernels->list().empty()) return;
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, unsigned(_kernels->list().size()));
    rtcSetGeometryMask(geometry, ~0u);
    rtcSetGeometryUserData(geometry, const_cast<SplatKernels*>(_kernels.get()));
    rtcSetGeometryBoundsFunction(geometry, boundsOf, nullptr);
    rtcSetGeometryIntersectFunction(geometry, meet);
    rtcCommitGeometry(geometry);
    _scene = rtcNewScene(device);
    rtcSetSceneFlags(_scene, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneProgressMonitorFunction(_scene, goesOn, const_cast<std::atomic<bool>*>(&stop));
    rtcAttachGeometry(_scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(_scene);
    rtcSetSceneProgressMonitorFunction(_scene, nullptr, nullptr);
}

SplatTree::~SplatTree() {
    if (_scene) rtcReleaseScene(_scene);
}

RTCBounds SplatTree::bounds() const {
    RTCBounds bounds;
    rtcGetSceneBounds(_scene, &bounds);
    return bounds;
}

void SplatTree::boundsOf(const RTCBoundsFunctionArguments* args) {
    const auto& kernels = *static_cast<const SplatKernels*>(args->geometryUserPtr);
    const SplatKernel& kernel = kernels.list()[args->primID];
    const vec3 half = kernels.halfOf(kernel);
    const vec3 lower = kernel.center - half, upper = kernel.center + half;
    RTCBounds& b = *args->bounds_o;
    b.lower_x = lower.x, b.lower_y = lower.y, b.lower_z = lower.z;
    b.upper_x = upper.x, b.upper_y = upper.y, b.upper_z = upper.z;
}

void SplatTree::meet(const RTCIntersectFunctionNArguments* args) {
    if (!args->valid[0]) return;
    const auto& kernels = *static_cast<const SplatKernels*>(args->geometryUserPtr);
    auto& query = *reinterpret_cast<SplatQuery*>(args->context);
    RTCRay& ray = reinterpret_cast<RTCRayHit*>(args->rayhit)->ray;
    const SplatKernel& kernel = kernels.list()[args->primID];
    const shSplats::SplatPoint point =
        shSplats::splatPoint(kernel.shape, kernel.center, kernel.toUnit,
                             {ray.org_x, ray.org_y, ray.org_z}, {ray.dir_x, ray.dir_y, ray.dir_z});
    if (!(point.away < kernel.reach)) return;
    if (!(point.distance >= ray.tnear) || !(point.distance <= ray.tfar)) return;
    query.add({point.distance, shSplats::splatAlpha(kernel.shape, kernel.opacity, point.away),
               query.place, args->primID},
              ray.tfar);
}

} // namespace patina
