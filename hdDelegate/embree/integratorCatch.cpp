// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/integrator.h"

#include "shaders/closure.h"

#include <algorithm>

// Mattes, and catchers of shadows and reflections: what the camera sees of them is put over a
// picture that shows them already.

namespace patina {

/// Of several light samples one is chosen by its light, and its shadow ray traced: the mean of what
/// the rays see is the light with shadows over that without (resampled importance sampling, Talbot
/// et al. 2005; the bias falls as one over the number of samples, and is none for one light of
/// small size).
float Integrator::shadowed(Path& path, const SurfacePoint& point, const Hit& hit, const Bsdf& bsdf,
                           TraceCounters& counters) const {
    constexpr uint32_t candidates = 16;
    const ShadingPoint& s = point.shading;
    const bool twoSided = bsdf.transmits();
    const Sampler::Set u = path.sampler.nextSet(candidates);
    LightSample chosen;
    float sum = 0.0f;
    for (uint32_t i = 0; i < candidates; ++i) {
        LightSample light;
        const LightDraw draw = beginLight(path, point, twoSided, vec3(u.point4(i)));
        if (!_lights.set().sample(draw, s.position, facingNormal(s), twoSided, path.time, light) ||
            !(light.pdf > 0.0f))
            continue;
        const LightInfo& info = _lights.info(light.light);
        if (!linked(info.lightCategory, hit.surface, hit.instanceCategories)) continue;
        const BsdfEval f = bsdf.eval(light.direction);
        const vec3 radiance = info.triangles
                                  ? _lights.triangleRadiance(light, s.position, path.time)
                                  : light.radiance * _lights.set().image(light);
        const float weight =
            luminance(
                glm::abs((f.diffuse * info.diffuse + f.specular * info.specular) * radiance)) /
            light.pdf;
        if (!(weight > 0.0f)) continue;
        sum += weight;
        if (path.sampler.random() * sum < weight) chosen = light;
    }
    if (!(sum > 0.0f)) return 0.0f;
    const vec3 seen =
        visibility(path, path.media, point.departure(chosen.direction), chosen.direction,
                   chosen.distance, _lights.info(chosen.light), counters);
    return std::clamp(1.0f - luminance(seen), 0.0f, 1.0f);
}

bool Integrator::catchLight(Path& path, const SurfacePoint& point, const Hit& hit,
                            const AovTarget& target, TraceCounters& counters) const {
    Bsdf bsdf;
    setUpLobes(point, bsdf);
    if (bsdf.stochastic()) bsdf.seed(path.sampler.randomBits());
    show(path, point, bsdf, target);
    const Catching catching = catchingOf(hit);
    if (catching.matte) return false;
    float left = 1.0f - path.alpha; // of the picture behind, past splats
    if (catching.shadows && bsdf.hasNonDelta() && !_lights.set().empty()) {
        const float dark = left * shadowed(path, point, hit, bsdf, counters);
        path.alpha += dark;
        left -= dark;
    }
    if (!catching.reflections || path.depth >= _settings.maxDepth) return false;
    const vec4 u = path.sampler.next4();
    const BsdfSample next = bsdf.sample(vec3(u), u.w);
    if (next.event == 0 || next.diffuse ||
        (next.event & (sh::LOBE_TRANSMIT | LOBE_SUBSURFACE)) != 0)
        return false;
    path.throughput *= next.weight;
    path.caught = luminance(next.weight) * left;
    if (!(path.caught > 0.0f)) return false;
    depart(path, point, hit, bsdf, next);
    path.specular = true; // no light sample was taken beside it
    ++path.depth;
    return true;
}

} // namespace patina
