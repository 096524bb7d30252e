// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/sharing/sharedVertex.h"

#include "base/maths.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

/// A point on one side of the surface that a path has come to. @param normal towards the viewer
SharedPoint pointOf(const Path& path, const SurfacePoint& point, const vec3& normal, bool behind) {
    const ShadingPoint& s = point.shading;
    const bool back = glm::dot(s.viewDirection, s.geometricNormal) < 0.0f;
    return {s.position,
            back == behind ? s.geometricNormal : -s.geometricNormal,
            behind ? -normal : normal,
            path.depth,
            path.coneWidth,
            vec3(0.0f)};
}

/// Empty where the light of a point is not to be shared: the lobes give random values, or light
/// comes from the inside of an object.
LambertPart partOf(const SurfacePoint& point, const Bsdf& bsdf) {
    if (bsdf.stochastic() || point.fibre) return {};
    const LambertPart part = bsdf.lambertPart();
    const bool inside = part.transmitted != vec3(0.0f) && point.slot->program->hasInterior();
    return inside ? LambertPart() : part;
}

} // namespace

void SharedPoints::meet(Path& path, SurfacePoint& point, Bsdf& bsdf) {
    if (_open.size() >= perPath) return;
    const LambertPart part = partOf(point, bsdf);
    const float reflected = luminance(part.reflected),
                both = luminance(part.reflected + part.transmitted);
    if (!(both > 0.0f)) return;
    Bsdf others = bsdf;
    const float left = others.dropLambert();
    if (path.sampler.random() < left) {
        bsdf = others;
        path.throughput /= left;
        return;
    }
    const bool behind = path.sampler.random() * both >= reflected;
    const vec3 side = behind ? part.transmitted : part.reflected;
    path.throughput *= side * (both / (luminance(side) * (1.0f - left)));
    points.push_back(pointOf(path, point, part.normal, behind));
    if (behind) point.shading.viewDirection = -point.shading.viewDirection;
    bsdf.makeDiffuse(points.back().normal, points.back().side);
    _open.push_back({path.throughput, path.radiance});
    path.radiance = vec3(0.0f);
}

void SharedPoints::end(const vec3& radiance) {
    constexpr float dark = 1e-3f; // over the brightest channel: nothing is known of the light
    vec3 after = radiance;
    size_t kept = points.size();
    for (size_t i = points.size(); i-- > _first;) {
        const Open& open = _open[i - _first];
        const vec3& t = open.throughput;
        const vec3 light = after / t;
        after += open.gathered;
        if (!(std::min({t.x, t.y, t.z}) > dark * std::max({t.x, t.y, t.z})) ||
            !std::isfinite(light.x + light.y + light.z))
            continue;
        points[--kept] = points[i];
        points[kept].light = light;
    }
    points.erase(points.begin() + long(_first), points.begin() + long(kept));
    _open.clear();
}

bool takeShared(const SharedLight& shared, Path& path, const SurfacePoint& point, Bsdf& bsdf) {
    const LambertPart part = partOf(point, bsdf);
    if (part.empty()) return true;
    const vec2 u = path.sampler.next2();
    const auto find = [&](const vec3& albedo, bool behind, vec3& light) {
        return albedo == vec3(0.0f) ||
               shared.find(pointOf(path, point, part.normal, behind), u, light);
    };
    vec3 before(0.0f), behind(0.0f);
    if (!find(part.reflected, false, before) || !find(part.transmitted, true, behind)) return true;
    path.add(part.reflected * before + part.transmitted * behind);
    const float left = bsdf.dropLambert();
    if (!(left > 0.0f) || path.sampler.random() >= left) return false;
    path.throughput /= left;
    return true;
}

} // namespace patina
