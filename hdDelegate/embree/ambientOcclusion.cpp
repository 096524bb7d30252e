// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/ambientOcclusion.h"

#include "base/maths.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

/// A frame around a unit normal (Duff et al. 2017).
void frameOf(const vec3& n, vec3& x, vec3& y) {
    const float sign = std::copysign(1.0f, n.z);
    const float a = -1.0f / (sign + n.z), b = n.x * n.y * a;
    x = vec3(1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x);
    y = vec3(b, sign + n.y * n.y * a, -n.y);
}

} // namespace

float AmbientOcclusion::sample(const CameraRay& ray, Sampler& sampler,
                               const std::vector<AovSpec>& aovs, const AovTarget& target,
                               const CameraRays& camera, uint64_t& rayCount, float& depth) const {
    Hit hit;
    ++rayCount;
    if (!scene.intersect(ray.origin, ray.direction, ray.near, ray.far, ray.time, RayCamera, hit))
        return -1.0f;
    depth = camera.depthAt(ray.origin + ray.direction * hit.distance);
    if (!aovs.empty()) {
        SurfacePoint point;
        computeSurfacePoint(hit, ray.origin, ray.direction,
                            ray.coneWidth + ray.coneSpread * hit.distance, point);
        writeAovs(aovs, target, camera, point, Bsdf());
    }
    vec3 normal = hit.groupNormal;
    if (hit.instanced) normal = glm::transpose(glm::inverse(mat3(hit.groupToWorld))) * normal;
    const float length = glm::length(normal);
    if (!(length > 0.0f)) return 1.0f;
    normal /= glm::dot(normal, ray.direction) > 0.0f ? -length : length;

    const vec3 position = ray.origin + ray.direction * hit.distance;
    const vec3 size = glm::abs(position);
    const float offset = 1e-5f * std::max({size.x, size.y, size.z, hit.distance});
    const vec3 origin = position + normal * offset;
    vec3 x, y;
    frameOf(normal, x, y);
    // A rank-1 lattice (golden ratio), shifted at random: stratified for any number of rays. From
    // one ray to the next its angle turns by the golden angle.
    constexpr float turnX = -0.73736888f, turnY = -0.67549029f; // cos, sin of 2 pi 0.6180340
    const vec2 shift = sampler.next2();
    const float phi = 2.0f * pi * shift.y;
    vec2 around(std::cos(phi), std::sin(phi));
    int seen = 0;
    for (int begin = 0; begin < rays; begin += WorldRays::packet) {
        const int count = std::min(rays - begin, WorldRays::packet);
        vec3 directions[WorldRays::packet];
        for (int i = 0; i < count; ++i) {
            const float u = (float(begin + i) + shift.x) / float(rays);
            const vec2 across = std::sqrt(u) * around;
            directions[i] =
                x * across.x + y * across.y + normal * std::sqrt(std::max(0.0f, 1.0f - u));
            around = vec2(around.x * turnX - around.y * turnY, around.x * turnY + around.y * turnX);
        }
        if (hit.instanced) { // rays into different instances share no part of a packet's way
            for (int i = 0; i < count; ++i)
                seen += !scene.occluded(origin, directions[i], 0.0f, INFINITY, ray.time, RayShadow);
            continue;
        }
        const unsigned blocked = scene.occludedRays(origin, directions, count, ray.time, RayShadow);
        for (int i = 0; i < count; ++i)
            seen += (blocked >> i & 1u) == 0;
    }
    rayCount += uint64_t(rays);
    return float(seen) / float(rays);
}

} // namespace patina
