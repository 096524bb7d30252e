// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/sharing/sharedVertex.h"

#include "hdDelegate/embree/vertex.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

/// A point on one side of the surface that a path has come to.
SharedPoint pointOf(const Path& path, const SurfacePoint& point, bool behind) {
    const ShadingPoint& s = point.shading;
    const bool back = glm::dot(s.viewDirection, s.geometricNormal) < 0.0f;
    return {s.position, back == behind ? s.geometricNormal : -s.geometricNormal, path.depth,
            path.coneWidth, vec3(0.0f)};
}

/// Black where the light of a point is not to be shared: the lobes differ from one time to the
/// next, or light comes from the inside of an object.
DiffuseAlbedo albedoOf(const SurfacePoint& point, const Bsdf& bsdf) {
    if (bsdf.stochastic() || point.fibre) return {};
    const DiffuseAlbedo albedo = bsdf.diffuseAlbedo();
    const bool inside = albedo.transmitted != vec3(0.0f) && point.slot->program->hasInterior();
    return inside ? DiffuseAlbedo() : albedo;
}

} // namespace

void SharedPoints::meet(Path& path, SurfacePoint& point, Bsdf& bsdf) {
    const DiffuseAlbedo albedo = albedoOf(point, bsdf);
    const float reflected = luminance(albedo.reflected),
                both = luminance(albedo.reflected + albedo.transmitted);
    if (!(both > 0.0f)) return;
    Bsdf others = bsdf;
    const float left = others.dropDiffuse();
    if (path.sampler.random() < left) {
        bsdf = others;
        path.throughput /= left;
        return;
    }
    const bool behind = path.sampler.random() * both >= reflected;
    const vec3 side = behind ? albedo.transmitted : albedo.reflected;
    path.throughput *= side * (both / (luminance(side) * (1.0f - left)));
    const SharedPoint found = pointOf(path, point, behind);
    if (behind) point.shading.viewDirection = -point.shading.viewDirection;
    bsdf.makeDiffuse(facingNormal(point.shading), found.normal);
    points.push_back(found);
    _open.push_back({path.throughput, path.radiance});
}

void SharedPoints::end(const vec3& radiance) {
    constexpr float dark = 1e-3f; // over the brightest channel: nothing is known of the light
    size_t kept = _first;
    for (size_t i = _first; i < points.size(); ++i) {
        const Open& open = _open[i - _first];
        const vec3& t = open.throughput;
        const vec3 light = (radiance - open.radiance) / t;
        if (!(std::min({t.x, t.y, t.z}) > dark * std::max({t.x, t.y, t.z})) ||
            !std::isfinite(light.x + light.y + light.z))
            continue;
        points[kept] = points[i];
        points[kept++].light = light;
    }
    points.resize(kept);
    _open.clear();
}

bool takeShared(const SharedLight& shared, Path& path, const SurfacePoint& point, Bsdf& bsdf) {
    const DiffuseAlbedo albedo = albedoOf(point, bsdf);
    if (!(luminance(albedo.reflected + albedo.transmitted) > 0.0f)) return true;
    const vec2 u = path.sampler.next2();
    vec3 before(0.0f), behind(0.0f);
    if (albedo.reflected != vec3(0.0f) && !shared.find(pointOf(path, point, false), u, before))
        return true;
    if (albedo.transmitted != vec3(0.0f) && !shared.find(pointOf(path, point, true), u, behind))
        return true;
    path.add(albedo.reflected * before + albedo.transmitted * behind);
    const float left = bsdf.dropDiffuse();
    if (!(left > 0.0f) || path.sampler.random() >= left) return false;
    path.throughput /= left;
    return true;
}

} // namespace patina
