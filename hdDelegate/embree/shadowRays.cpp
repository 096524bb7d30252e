// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/integrator.h"

#include "hdDelegate/embree/media/freeFlight.h"

#include <algorithm>
#include <cmath>

// Shadow rays: what is left of a light on its way to a point.

namespace patina {

namespace {

bool contains(const std::vector<int>& sorted, int value) {
    return std::binary_search(sorted.begin(), sorted.end(), value);
}

} // namespace

bool Integrator::linked(int category, const Surface* surface,
                        const std::vector<int>* instance) const {
    return category == SceneLights::everything || !surface ||
           contains(surface->categories, category) || (instance && contains(*instance, category));
}

/// The part of a light that reaches a point past everything in between. Surfaces block it but for
/// their presence; media take their share, those of objects without a refracting surface too.
/// @param media at the point, on the side that the light comes from
vec3 Integrator::visibility(Path& path, const MediumStack& media, const vec3& origin,
                            const vec3& direction, float distance, const LightInfo& light,
                            TraceCounters& counters) const {
    const auto left = [](const MediumStack& stack, float length) {
        return stack.empty() ? vec3(1.0f) : transmittance(stack.extinction(), length);
    };
    if (!light.castsShadows || !_settings.enableShadows) return left(media, distance);
    const auto volumes = [&] {
        return _scene.volumes().empty() ? vec3(1.0f)
                                        : _scene.volumes().transmittance(
                                              origin, direction, distance, RayShadow, path.sampler);
    };
    float far = distance * (1.0f - 1e-4f);
    if (light.shadowDistance > 0.0f) far = std::min(far, light.shadowDistance);
    ++counters.shadowRays;
    const bool simple = _scene.allOpaque() && !_scene.ranksMedia() &&
                        light.shadowCategory == SceneLights::everything &&
                        light.shadowFalloff <= 0.0f;
    if (simple) {
        const bool blocked = _scene.occluded(origin, direction, 0.0f, far, path.time, RayShadow);
        const vec3 seen = blocked ? light.shadowColor : vec3(1.0f);
        return seen == vec3(0.0f) ? seen : seen * left(media, distance) * volumes();
    }
    MediumStack here = media;
    vec3 through(1.0f);
    float near = 0.0f, last = 0.0f; // last: where the present medium began
    for (int i = 0; i < maxPassThroughs && through != vec3(0.0f); ++i) {
        Hit hit;
        if (!_scene.intersect(origin, direction, near, far, path.time, RayShadow, hit)) break;
        SurfacePoint point;
        computeSurfacePoint(hit, origin, direction, 0.0f, point);
        if (_scene.ranksMedia()) {
            const MediumStack before = here;
            if (!isThere(here, point, hit)) {
                through *= left(before, hit.distance - last);
                last = hit.distance;
                near = hit.distance + std::max(point.offset, hit.distance * 1e-6f);
                continue;
            }
        }
        if (linked(light.shadowCategory, hit.surface, hit.instanceCategories)) {
            const MaterialProgram& program = *point.slot->program;
            vec3 transmittance(1.0f);
            const float opacity =
                point.slot->opaque ? 1.0f : program.opacity(point.shading, &transmittance);
            transmittance *= 1.0f - opacity;
            if (light.shadowFalloff > 0.0f && light.shadowDistance > 0.0f) {
                const float fade = std::clamp(
                    (light.shadowDistance - hit.distance) / light.shadowFalloff, 0.0f, 1.0f);
                transmittance = glm::mix(vec3(1.0f), transmittance,
                                         std::pow(fade, std::max(light.shadowFalloffGamma, 1e-3f)));
            }
            through *= transmittance;
            if (program.passThroughEnters()) {
                through *= left(here, hit.distance - last);
                last = hit.distance;
                here.cross(program, point.shading, priorityOf(hit));
            }
        }
        near = hit.distance + std::max(point.offset, hit.distance * 1e-6f);
    }
    if (through != vec3(0.0f)) through *= left(here, distance - last) * volumes();
    return through + (1.0f - through) * light.shadowColor;
}

} // namespace patina
