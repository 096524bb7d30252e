// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/shadowRays.h"

#include "hdDelegate/embree/media/freeFlight.h"
#include "hdDelegate/embree/vertex.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

bool contains(const std::vector<int>& sorted, int value) {
    return std::binary_search(sorted.begin(), sorted.end(), value);
}

vec3 left(const MediumStack& media, float length) {
    return media.empty() ? vec3(1.0f) : transmittance(media.extinction(), length);
}

/// What a surface lets through of a light.
vec3 leftBehind(const SurfacePoint& point, float distance, const LightInfo& light) {
    vec3 transmittance(1.0f);
    const float opacity =
        point.slot->opaque ? 1.0f : point.slot->program->opacity(point.shading, &transmittance);
    transmittance *= 1.0f - opacity;
    if (!(light.shadowFalloff > 0.0f && light.shadowDistance > 0.0f)) return transmittance;
    const float fade =
        std::clamp((light.shadowDistance - distance) / light.shadowFalloff, 0.0f, 1.0f);
    return glm::mix(vec3(1.0f), transmittance,
                    std::pow(fade, std::max(light.shadowFalloffGamma, 1e-3f)));
}

} // namespace

bool isLinked(int category, const Surface* surface, const std::vector<int>* instance) {
    return category == SceneLights::everything || !surface ||
           contains(surface->categories, category) || (instance && contains(*instance, category));
}

vec3 ShadowRays::seen(const LightInfo& light, const Way& way, const MediumStack& media,
                      Sampler& sampler, TraceCounters& counters) const {
    if (!light.castsShadows || !_enabled) return left(media, way.distance);
    const auto throughSpace = [&] {
        return _scene.fillsSpace() ? _scene.transmittance({way.origin, way.direction, 0.0f,
                                                           way.distance, way.time, RayShadow},
                                                          sampler)
                                   : vec3(1.0f);
    };
    float far = way.distance * (1.0f - 1e-4f);
    if (light.shadowDistance > 0.0f) far = std::min(far, light.shadowDistance);
    ++counters.shadowRays;
    const bool simple = _scene.allOpaque() && !_scene.ranksMedia() &&
                        light.shadowCategory == SceneLights::everything &&
                        light.shadowFalloff <= 0.0f;
    if (simple) {
        const bool blocked =
            _scene.occluded(way.origin, way.direction, 0.0f, far, way.time, RayShadow);
        const vec3 seen = blocked ? light.shadowColor : vec3(1.0f);
        return seen == vec3(0.0f) ? seen : seen * left(media, way.distance) * throughSpace();
    }
    MediumStack here = media;
    vec3 through(1.0f);
    float near = 0.0f, last = 0.0f; // last: where the present medium began
    for (int i = 0; i < maxPassThroughs && through != vec3(0.0f); ++i) {
        Hit hit;
        if (!_scene.intersect(way.origin, way.direction, near, far, way.time, RayShadow, hit))
            break;
        SurfacePoint point;
        computeSurfacePoint(hit, way.origin, way.direction, 0.0f, point);
        near = hit.distance + std::max(point.offset, hit.distance * 1e-6f);
        if (_scene.ranksMedia()) {
            const MediumStack before = here;
            if (!isThere(here, point, hit)) {
                through *= left(before, hit.distance - last);
                last = hit.distance;
                continue;
            }
        }
        if (!isLinked(light.shadowCategory, hit.surface, hit.instanceCategories)) continue;
        through *= leftBehind(point, hit.distance, light);
        if (!point.slot->program->passThroughEnters()) continue;
        through *= left(here, hit.distance - last);
        last = hit.distance;
        here.cross(*point.slot->program, point.shading, _scene.priorityOf(hit));
    }
    if (through != vec3(0.0f)) through *= left(here, way.distance - last) * throughSpace();
    return through + (1.0f - through) * light.shadowColor;
}

} // namespace patina
