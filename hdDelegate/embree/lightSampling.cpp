// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/lightSampling.h"

#include "hdDelegate/embree/vertex.h"

#include <algorithm>

namespace patina {

namespace {

/// @param lightPdf density of all samples that the vertex takes; @param pdf of following the path
float weightOf(const LightSample& light, const LightInfo& info, float lightPdf, float pdf) {
    const bool sampledAlone = light.delta || (info.triangles && info.ownShadows);
    return sampledAlone ? 1.0f : misWeight(lightPdf, pdf, info.dome);
}

} // namespace

LightDraw LightSampling::begin(const Path& path, const SurfacePoint& point, bool twoSided,
                               const vec3& u) const {
    const ShadingPoint& s = point.shading;
    const LightDraw draw = _lights.set().begin(s.position, facingNormal(s), twoSided, u, path.time);
    _lights.request(draw.light);
    return draw;
}

LightSampling::Draws LightSampling::beginAll(const Path& path, const SurfacePoint& point,
                                             int maxDepth) const {
    Draws draws;
    draws.twoSided = point.slot->program->hasTransmission();
    if (path.depth >= maxDepth || empty()) return draws;
    Sampler ahead = path.sampler;
    const Sampler::Set u = ahead.nextSet(uint32_t(path.lightSamples));
    for (; draws.count < std::min(path.lightSamples, Draws::most); ++draws.count)
        draws.begun[draws.count] =
            begin(path, point, draws.twoSided, vec3(u.point4(uint32_t(draws.count))));
    return draws;
}

const LightInfo* LightSampling::sample(const Path& path, const SurfacePoint& point, const Hit& hit,
                                       const LightDraw& draw, bool twoSided,
                                       LightSample& light) const {
    const ShadingPoint& s = point.shading;
    if (!_lights.set().sample(draw, s.position, facingNormal(s), twoSided, path.time, light) ||
        !(light.pdf > 0.0f))
        return nullptr;
    const LightInfo& info = _lights.info(light.light);
    return isLinked(info.lightCategory, hit.surface, hit.instanceCategories) ? &info : nullptr;
}

vec3 LightSampling::atSurface(Path& path, const SurfacePoint& point, const VertexBsdf& bsdf,
                              const Hit& hit, const LightDraw& draw,
                              TraceCounters& counters) const {
    const ShadingPoint& s = point.shading;
    LightSample light;
    const LightInfo* info = sample(path, point, hit, draw, bsdf.transmits(), light);
    if (!info) return vec3(0.0f);
    const BsdfEval f = bsdf.eval(light.direction);
    vec3 value = f.diffuse * info->diffuse + f.specular * info->specular;
    if (value == vec3(0.0f)) return value;
    vec3 radiance = _lights.radiance(light, s.position, path.time);
    if (radiance == vec3(0.0f) && info->triangles) return radiance;
    const float lightPdf = float(path.lightSamples) * light.pdf;
    const float weight = weightOf(light, *info, lightPdf, f.pdf * float(path.branches));
    const ShadowRays::Way way{point.departure(light.direction), light.direction, light.distance,
                              path.time};
    const MaterialProgram& program = *point.slot->program;
    const int priority = _scene.priorityOf(hit);
    const bool crosses = (program.hasInterior() || (priority > 0 && program.encloses())) &&
                         !staysOutside(point, light.direction);
    vec3 seen;
    if (crosses) {
        MediumStack across = path.media;
        across.cross(program, s, priority, bsdf.ior() * s.surroundingIor);
        seen = _shadows.seen(*info, way, across, path.sampler, counters);
    } else {
        seen = _shadows.seen(*info, way, path.media, path.sampler, counters);
    }
    if (path.lightPaths) _events.shadow(path, value, light, radiance, seen);
    if (seen == vec3(0.0f)) return seen;
    radiance *= _lights.image(light); // last: that of a sky takes its time to come from memory
    if (path.lightPaths) _events.direct(path, s, light, f, radiance * seen * (weight / lightPdf));
    value *= radiance * (weight / lightPdf);
    return value * seen;
}

vec3 LightSampling::inMedium(Path& path, const vec3& position, const sh::PhaseMixture& phase,
                             const vec3& u, TraceCounters& counters) const {
    LightSample light;
    if (!_lights.set().sample(position, vec3(0.0f), true, u, path.time, light) ||
        !(light.pdf > 0.0f))
        return vec3(0.0f);
    const LightInfo& info = _lights.info(light.light);
    const sh::LobeEval scattered = sh::phaseMixtureEval(phase, -path.direction, light.direction);
    vec3 value = scattered.value * info.diffuse;
    const vec3 radiance = _lights.radiance(light, position, path.time);
    if (radiance == vec3(0.0f)) return radiance;
    value *= radiance * (weightOf(light, info, light.pdf, scattered.pdf) / light.pdf);
    value *= _shadows.seen(info, {position, light.direction, light.distance, path.time}, path.media,
                           path.sampler, counters);
    if (path.lightPaths)
        path.lightPaths->lit(EventType::Volume, value, vec3(0.0f), _events.emitter(light.light));
    return value;
}

/// Of several light samples one is chosen by its light, and its shadow ray traced: the mean of what
/// the rays see is the light with shadows over that without (resampled importance sampling, Talbot
/// et al. 2005; the bias falls as one over the number of samples, and is none for one light of
/// small size).
float LightSampling::shadowed(Path& path, const SurfacePoint& point, const Hit& hit,
                              const Bsdf& bsdf, TraceCounters& counters) const {
    constexpr uint32_t candidates = 16;
    const Sampler::Set u = path.sampler.nextSet(candidates);
    LightSample chosen;
    float sum = 0.0f;
    for (uint32_t i = 0; i < candidates; ++i) {
        LightSample light;
        const bool twoSided = bsdf.transmits();
        const LightDraw draw = begin(path, point, twoSided, vec3(u.point4(i)));
        const LightInfo* info = sample(path, point, hit, draw, twoSided, light);
        if (!info) continue;
        const BsdfEval f = bsdf.eval(light.direction);
        const vec3 radiance =
            _lights.radiance(light, point.shading.position, path.time) * _lights.image(light);
        const float weight =
            luminance(
                glm::abs((f.diffuse * info->diffuse + f.specular * info->specular) * radiance)) /
            light.pdf;
        if (!(weight > 0.0f)) continue;
        sum += weight;
        if (path.sampler.random() * sum < weight) chosen = light;
    }
    if (!(sum > 0.0f)) return 0.0f;
    const ShadowRays::Way way{point.departure(chosen.direction), chosen.direction, chosen.distance,
                              path.time};
    const vec3 seen =
        _shadows.seen(_lights.info(chosen.light), way, path.media, path.sampler, counters);
    return std::clamp(1.0f - luminance(seen), 0.0f, 1.0f);
}

} // namespace patina
