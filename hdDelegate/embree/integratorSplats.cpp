// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/integrator.h"

#include "hdDelegate/embree/media/freeFlight.h"

#include <algorithm>
#include <cmath>

// Splats along the ray of a path: they shine and absorb, and scatter nothing.

namespace patina {

float Integrator::passSplats(Path& path, float end, float way) const {
    const SplatScene& splats = _scene.splats();
    const SplatScene::Ray ray{path.origin, path.direction, path.near, end, path.time, path.rays};
    const bool camera = path.fromCamera(), inMedium = !path.media.empty();
    SplatScene::Look look(splats, ray);
    vec3 shines(0.0f);
    float left = 1.0f, leftAtWay = -1.0f, seen = 0.0f;
    // Volumes are asked for what they let through up to one kernel, which stands for all.
    const bool inVolumes = !_scene.volumes().empty();
    vec3 chosen(0.0f);
    float chosenAt = 0.0f, chosenWeight = 0.0f, weights = 0.0f;
    splats.along(ray, [&](const SplatHit& hit) {
        if (leftAtWay < 0.0f && hit.distance > way) leftAtWay = left;
        const float share = left * hit.alpha;
        left *= 1.0f - hit.alpha;
        if (!(camera && splats.isMatte(hit))) {
            seen += share;
            vec3 light = share * look.radiance(hit);
            if (inMedium) light *= transmittance(path.media.extinction(), hit.distance);
            shines += light;
            const float weight = std::abs(light.x) + std::abs(light.y) + std::abs(light.z);
            weights += weight;
            if (inVolumes && path.sampler.random() * weights < weight) {
                chosen = light;
                chosenAt = hit.distance;
                chosenWeight = weight;
            }
        }
        if (left < 0.5f && camera && !path.shown) {
            path.shown = true;
            path.screen = splats.primId(hit);
            path.screenPosition = path.origin + path.direction * hit.distance;
        }
        if (left < shSplats::SPLAT_END) left = 0.0f;
        return left > 0.0f;
    });
    if (inVolumes && chosenWeight > 0.0f)
        shines = chosen * (weights / chosenWeight) *
                 _scene.volumes().transmittance(path.origin, path.direction, chosenAt, path.rays,
                                                path.sampler);
    if (shines != vec3(0.0f)) {
        if (path.lightPaths) path.lightPaths->straight(LightEvent());
        addRadiance(path, shines);
        // They are their own texture.
        if (!path.featured) path.featureAlbedo += glm::clamp(path.throughput * shines, 0.0f, 1.0f);
    }
    if (camera) path.alpha += (1.0f - path.alpha) * seen;
    path.alpha += path.caught * seen;
    path.caught *= left;
    return leftAtWay < 0.0f ? left : leftAtWay;
}

} // namespace patina
