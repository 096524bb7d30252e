// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/seenOrigin.h"

#include "hdDelegate/embree/cameraRays.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace patina {

namespace {

constexpr int probes = 16;           ///< along each side of the image
constexpr double farAway = 60.0;     ///< widths of the view
constexpr double cellsPerView = 8.0; ///< origins are that many widths of the view apart, or more

double largest(const dvec3& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

/// Where rays meet nothing, it may be for their few digits: at the eye they have more. Points
/// beside the origin stay there, and those found to be far stay where they are.
dvec3 originAtEye(const EmbreeScene& scene, const dvec3& eye) {
    const double extent = largest(dvec3(scene.boundsMax()) - dvec3(scene.boundsMin()));
    const double away = largest(eye);
    if (!std::isfinite(away) || !(extent >= 0.0) || away <= farAway * extent || away == 0.0)
        return dvec3(0.0);
    const double moved = largest(eye - scene.origin());
    return moved <= farAway * extent && scene.origin() != dvec3(0.0) ? scene.origin() : eye;
}

} // namespace

dvec3 originOfSeen(const EmbreeScene& scene, const Camera& camera, const RenderSettings& settings) {
    RenderSettings sharp = settings;
    sharp.enableDepthOfField = false;
    const CameraRays rays(camera, sharp, scene.origin());
    struct Seen {
        float distance;
        vec3 place;
    };
    std::vector<Seen> seen;
    for (int y = 0; y < probes; ++y)
        for (int x = 0; x < probes; ++x) {
            const vec2 pixel((float(x) + 0.5f) / probes * float(settings.width),
                             (float(y) + 0.5f) / probes * float(settings.height));
            const CameraRay ray = rays.ray(pixel, vec2(0.5f), 0.5f);
            Hit hit;
            if (!ray.seen) continue;
            if (scene.intersect(ray.origin, ray.direction, ray.near, ray.far, ray.time, RayCamera,
                                hit))
                seen.push_back({hit.distance, ray.origin + ray.direction * hit.distance});
        }
    const vec3 eye = vec3(glm::inverse(rays.worldToCamera())[3]);
    const auto see = [&](const auto& part) {
        if (part.empty()) return;
        const vec3 nearest = glm::clamp(eye, part.boundsMin(), part.boundsMax());
        seen.push_back({glm::length(nearest - eye), nearest});
    };
    see(scene.volumes());
    see(scene.splats());
    if (seen.empty()) return originAtEye(scene, dvec3(eye) + scene.origin());
    // Near objects are seen largest; the horizon would pull the origin away from it.
    std::sort(seen.begin(), seen.end(),
              [](const Seen& a, const Seen& b) { return a.distance < b.distance; });
    const size_t near = (seen.size() + 1) / 2;
    dvec3 middle(0.0);
    for (size_t i = 0; i < near; ++i)
        middle += dvec3(seen[i].place) / double(near);
    middle += scene.origin();
    const double distance = rays.orthographic() ? 1.0 : double(seen[near - 1].distance);
    const double width = std::max(double(rays.pixelSpread()) * double(settings.width) * distance,
                                  1e-6 * double(seen[near - 1].distance));
    return originNear(middle, width, farAway, cellsPerView);
}

} // namespace patina
