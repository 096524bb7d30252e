// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/integrator.h"

#include "hdDelegate/embree/aovWriter.h"
#include "hdDelegate/embree/deepRay.h"
#include "hdDelegate/embree/media/freeFlight.h"
#include "hdDelegate/embree/path.h"
#include "hdDelegate/film/pixelFilter.h"
#include "hdDelegate/embree/sceneLights.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace patina {

void Integrator::addRadiance(Path& path, const vec3& radiance) const {
    vec3 contribution = path.throughput * radiance;
    float clamp = 1.0f;
    if (_settings.indirectClamp > 0.0f && path.indirect()) {
        const float l = std::abs(luminance(contribution));
        if (l > _settings.indirectClamp) contribution *= clamp = _settings.indirectClamp / l;
    }
    path.radiance += contribution;
    if (path.lightPaths) path.lightPaths->add(radiance, path.throughput * clamp);
}

/// Light that the surface itself gives off towards the ray.
void Integrator::addEmission(Path& path, const SurfacePoint& point, const Hit& hit,
                             float presence) const {
    const vec3 radiance =
        _lights.emission(point, path.fromCamera() ? &path.origin : &path.vertex) * presence;
    if (radiance == vec3(0.0f)) return;
    const int light = path.fromCamera() ? -1 : _lights.triangleLight(hit);
    if (light < 0) {
        if (path.lightPaths) recordEmission(path, hit);
        addRadiance(path, radiance);
        return;
    }
    if (!path.specular && _lights.info(light).ownShadows) return; // light samples have it all
    const float lightPdf =
        path.specular ? 0.0f
                      : _lights.set().pdfTriangle(light - _lights.set().lightCount(), path.vertex,
                                                  path.vertexNormal, path.vertexTwoSided,
                                                  point.shading.position);
    addLight(path, light, radiance, lightPdf);
}

LightDraw Integrator::beginLight(const Path& path, const SurfacePoint& point, bool twoSided,
                                 const vec3& u) const {
    const ShadingPoint& s = point.shading;
    return _lights.set().begin(s.position, facingNormal(s), twoSided, u, path.time);
}

/// Begun before the lobes of a vertex are set up, so that what they have to wait for comes from
/// memory meanwhile.
Integrator::LightDraws Integrator::beginLights(const Path& path, const SurfacePoint& point) const {
    LightDraws draws;
    draws.twoSided = point.slot->program->hasTransmission();
    if (path.depth >= _settings.maxDepth || _lights.set().empty()) return draws;
    Sampler ahead = path.sampler;
    const Sampler::Set u = ahead.nextSet(uint32_t(path.lightSamples));
    for (; draws.count < std::min(path.lightSamples, LightDraws::most); ++draws.count)
        draws.begun[draws.count] =
            beginLight(path, point, draws.twoSided, vec3(u.point4(uint32_t(draws.count))));
    return draws;
}

vec3 Integrator::directLight(Path& path, const SurfacePoint& point, const VertexBsdf& bsdf,
                             const Hit& hit, const LightDraw& draw, TraceCounters& counters) const {
    const ShadingPoint& s = point.shading;
    const bool twoSided = bsdf.transmits();
    LightSample light;
    if (!_lights.set().sample(draw, s.position, facingNormal(s), twoSided, path.time, light) ||
        !(light.pdf > 0.0f))
        return vec3(0.0f);
    const LightInfo& info = _lights.info(light.light);
    if (!linked(info.lightCategory, hit.surface, hit.instanceCategories)) return vec3(0.0f);
    const BsdfEval f = bsdf.eval(light.direction);
    vec3 value = f.diffuse * info.diffuse + f.specular * info.specular;
    if (value == vec3(0.0f)) return vec3(0.0f);
    vec3 radiance = light.radiance;
    if (info.triangles) {
        radiance = _lights.triangleRadiance(light, s.position, path.time);
        if (radiance == vec3(0.0f)) return vec3(0.0f);
    }
    const float lightPdf = float(path.lightSamples) * light.pdf;
    const bool sampledAlone = light.delta || (info.triangles && info.ownShadows);
    const float weight = sampledAlone ? 1.0f : misWeight(lightPdf, f.pdf, info.dome);
    const float away = glm::dot(light.direction, s.geometricNormal) < 0.0f ? -1.0f : 1.0f;
    const vec3 origin = point.departure(light.direction);
    const MaterialProgram& program = *point.slot->program;
    const int priority = priorityOf(hit);
    const bool crosses = (program.hasInterior() || (priority > 0 && program.encloses())) &&
                         (glm::dot(s.viewDirection, s.geometricNormal) < 0.0f) != (away < 0.0f);
    vec3 seen;
    if (crosses) {
        MediumStack across = path.media;
        across.cross(program, s, priority, bsdf.ior() * s.surroundingIor);
        seen = visibility(path, across, origin, light.direction, light.distance, info, counters);
    } else {
        seen =
            visibility(path, path.media, origin, light.direction, light.distance, info, counters);
    }
    if (path.lightPaths) addShadow(path, value, light, radiance, seen);
    if (seen == vec3(0.0f)) return seen;
    // Last: the image of a sky takes its time to come from memory.
    if (!info.triangles) radiance *= _lights.set().image(light);
    if (path.lightPaths) recordDirect(path, s, light, f, radiance * seen * (weight / lightPdf));
    value *= radiance * (weight / lightPdf);
    return value * seen;
}

/// Sets the path on its way from a vertex, and keeps what later light hits have to know about it.
void Integrator::depart(Path& path, const SurfacePoint& point, const Hit& hit,
                        const VertexBsdf& bsdf, const BsdfSample& next) const {
    const ShadingPoint& s = point.shading;
    const bool back = glm::dot(s.geometricNormal, s.viewDirection) < 0.0f;
    path.rays = (next.event & sh::LOBE_TRANSMIT) != 0 ? RayTransmission
                : next.diffuse                        ? RayDiffuse
                                                      : RaySpecular;
    path.specular = (next.event & sh::LOBE_DELTA) != 0;
    path.splatsSampled = false;
    path.pdf = next.pdf;
    path.vertex = s.position;
    path.vertexNormal = back ? -s.normal : s.normal;
    path.vertexTwoSided = bsdf.transmits();
    path.vertexSurface = hit.surface;
    path.vertexInstanceCategories = hit.instanceCategories;
    path.diffuseShare = vec3(next.diffuse ? 1.0f : 0.0f);
    path.specularShare = vec3(1.0f) - path.diffuseShare;
    if (_lights.splitsLobes() && !path.specular) {
        const BsdfEval f = bsdf.evalDrawn(next);
        const vec3 sum = f.diffuse + f.specular;
        for (int c = 0; c < 3; ++c)
            path.diffuseShare[c] = sum[c] > 0.0f ? f.diffuse[c] / sum[c] : 0.5f;
        path.specularShare = vec3(1.0f) - path.diffuseShare;
    }
    if (path.lightPaths) recordScatter(path, next, bsdf);
    path.origin = point.departure(next.wi);
    path.direction = next.wi;
    path.departs = true;
    path.near = 0.0f;
    path.far = INFINITY;
    path.coneSpread = std::min(1.0f, path.coneSpread + 0.5f * next.roughness);
}

/// Traces the path's ray, and adds the lights that it meets on its way.
Integrator::Step Integrator::find(Path& path, Hit& hit, TraceCounters& counters) const {
    if (std::exchange(path.departs, false) && _lights.hasOwnShadows())
        addOwnShadows(path, counters);
    ++counters.rays;
    const bool found = _scene.intersect(path.origin, path.direction, path.near, path.far, path.time,
                                        path.rays, hit);
    const float distance = found ? hit.distance : path.far;
    const float end = _finiteLights ? addLightsAlong(path, distance) : distance;
    if (!path.media.empty() || _scene.fillsSpace()) {
        const Step step = traverseMedia(path, end, counters);
        if (step != Step::Arrives) return step;
    }
    if (end < distance) return Step::Ends;
    if (found) return Step::Arrives;
    if (!(path.caught > 0.0f)) addEscaped(path);
    return Step::Ends;
}

/// Sees a surface among overlapping objects: what it borders on, or that a medium of a higher
/// priority hides it. Then the media are those behind it.
bool Integrator::isThere(MediumStack& media, SurfacePoint& point, const Hit& hit) const {
    const MaterialProgram& program = *point.slot->program;
    ShadingPoint& s = point.shading;
    const int priority = program.encloses() ? dielectricPriorityOf(hit) : 0;
    s.surroundingIor = media.iorAround(program, s, priority);
    if (priority == 0 || !media.hides(program, s, priority)) return true;
    s.surroundingIor = 1.0f;
    Bsdf bsdf;
    setUpLobes(point, bsdf);
    media.cross(program, s, priority, bsdf.ior());
    return false;
}

/// Adds what a surface gives off, and decides by the chance of its presence whether the path meets
/// it or passes straight through.
Integrator::Step Integrator::meet(Path& path, SurfacePoint& point, const Hit& hit,
                                  bool caught) const {
    const MaterialProgram& program = *point.slot->program;
    const ShadingPoint& s = point.shading;
    const bool back = glm::dot(s.geometricNormal, s.viewDirection) < 0.0f;
    const bool culled = path.fromCamera() &&
                        (back ? cullsBack(*hit.surface->prim) : cullsFront(*hit.surface->prim));
    vec3 transmittance(1.0f);
    float presence = 1.0f, opacity = culled ? 0.0f : 1.0f;
    if (!culled && !point.slot->opaque) {
        // Shadow rays have no width. A scattered ray must pass the same surfaces as they do: where
        // a cutout blurs away, the two ways to find a light would see different surfaces.
        const float footprint = s.uvFootprint;
        if (!path.fromCamera()) point.shading.uvFootprint = 0.0f;
        opacity = program.opacity(s, &transmittance, &presence);
        point.shading.uvFootprint = footprint;
    }
    // The present share emits, whether or not light also passes.
    if (!culled && !caught && presence > 0.0f) addEmission(path, point, hit, presence);
    if (!(opacity < 1.0f) || path.sampler.random() < opacity) return Step::Arrives;
    if (path.deep && path.fromCamera()) path.deep->pass(_camera.depthAt(s.position), path.radiance);
    path.throughput *= transmittance;
    if (++path.passThroughs > maxPassThroughs || path.throughput == vec3(0.0f)) return Step::Ends;
    if (program.passThroughEnters() && !culled) path.media.cross(program, s, priorityOf(hit));
    path.origin = s.position + path.direction * std::max(point.offset, 1e-7f);
    path.near = 0.0f;
    path.splatsSampled = false;
    return Step::GoesOn;
}

/// AOVs and the denoiser's guides get what they show of a vertex.
void Integrator::show(Path& path, const SurfacePoint& point, const Bsdf& bsdf,
                      const AovTarget& target) const {
    if (!std::exchange(path.shown, true)) {
        writeAovs(_aovs, target, _camera, point, bsdf);
        if (path.deep) path.deep->end(_camera.depthAt(point.shading.position));
    }
    if (path.featured || !_guided || !bsdf.hasNonDelta()) return;
    path.featured = true;
    path.featureAlbedo += path.throughput * bsdf.albedo(); // behind what splats show
    path.featureNormal = point.shading.normal;
}

/// Takes the path through a vertex of one wavelength, or of three channels.
bool Integrator::scatter(Path& path, const SurfacePoint& point, const Hit& hit, float width,
                         const AovTarget& target, TraceCounters& counters) const {
    LightDraws draws = beginLights(path, point);
    Bsdf bsdf;
    setUpLobes(point, bsdf);
    if (bsdf.stochastic()) bsdf.seed(path.sampler.randomBits());
    show(path, point, bsdf, target);
    if (endsAt(path, hit)) return false;
    if (_photons) meetCaustics(path, point, bsdf, width);
    if (bsdf.stochastic() || bsdf.transmits() != draws.twoSided) draws.count = 0;
    return goOn(path, point, hit, bsdf, nullptr, draws, counters);
}

/// Takes light samples at a vertex, and the path on from it.
bool Integrator::goOn(Path& path, const SurfacePoint& point, const Hit& hit, const Bsdf& bsdf,
                      const DispersedBsdf* dispersed, const LightDraws& draws,
                      TraceCounters& counters) const {
    const VertexBsdf vertex(bsdf, dispersed);
    const Sampler::Set uLight = path.sampler.nextSet(uint32_t(path.lightSamples));
    if (vertex.hasNonDelta() && !path.throughCasters && !_lights.set().empty())
        for (int i = 0; i < path.lightSamples; ++i) {
            const LightDraw draw = i < draws.count ? draws.begun[i]
                                                   : beginLight(path, point, vertex.transmits(),
                                                                vec3(uLight.point4(uint32_t(i))));
            addRadiance(path, directLight(path, point, vertex, hit, draw, counters));
        }

    const bool litBySplats = vertex.hasNonDelta() && !_scene.splats().lights().empty();
    if (litBySplats) addRadiance(path, splatLight(path, point, vertex, counters));

    const vec4 u = path.sampler.next4();
    const BsdfSample next =
        dispersed ? dispersed->sample(vec3(u), u.w, path.waves) : bsdf.sample(vec3(u), u.w);
    if (next.event == 0) return false;
    path.throughput *= next.weight;
    if (!(luminance(path.throughput) > 0.0f)) return false;
    if ((next.event & LOBE_SUBSURFACE) != 0) {
        path.onPhotons = false;
        if (!scatterBeneath(path, point, hit, bsdf.subsurface(next), counters)) return false;
    } else {
        if ((next.event & sh::LOBE_TRANSMIT) != 0)
            path.media.cross(*point.slot->program, point.shading, priorityOf(hit),
                             bsdf.ior() * point.shading.surroundingIor);
        depart(path, point, hit, vertex, next);
        path.splatsSampled = litBySplats && !path.specular && staysOutside(point, next.wi);
    }
    ++path.depth;
    return survivesRoulette(path);
}

/// Takes the path to the next surface that its ray meets, and on from there.
bool Integrator::advance(Path& path, const AovTarget& target, TraceCounters& counters) const {
    Hit hit;
    Step step = find(path, hit, counters);
    if (step != Step::Arrives) return step == Step::GoesOn;
    path.travelled += hit.distance;
    SurfacePoint point;
    const float width = path.coneWidth + path.coneSpread * path.travelled;
    computeSurfacePoint(hit, path.origin, path.direction, width, point);
    const MaterialProgram& program = *point.slot->program;
    counters.clock.enter(&program);
    if (program.jitters()) point.shading.seed = path.sampler.randomBits();

    if (_scene.ranksMedia() && !isThere(path.media, point, hit)) {
        path.origin = point.shading.position + path.direction * std::max(point.offset, 1e-7f);
        path.near = 0.0f;
        path.splatsSampled = false;
        return ++path.passThroughs <= maxPassThroughs;
    }
    const bool caught = path.fromCamera() && catchingOf(hit).any();
    step = meet(path, point, hit, caught);
    if (step != Step::Arrives) return step == Step::GoesOn;
    if (path.fromCamera() && !caught) path.alpha = 1.0f;
    path.alpha += std::exchange(path.caught, 0.0f);
    // The camera's first hit counts most, and its vertex is paid for.
    path.lightSamples = path.fromCamera() ? _lightSamples : 1;

    const bool goesOn = caught                ? catchLight(path, point, hit, target, counters)
                        : program.disperses() ? disperse(path, point, hit, width, target, counters)
                                              : scatter(path, point, hit, width, target, counters);
    path.coneWidth = width;
    path.travelled = 0.0f;
    return goesOn;
}

void Integrator::trace(Path& path, const AovTarget& target, TraceCounters& counters) const {
    while (advance(path, target, counters)) {
    }
}

} // namespace patina
