// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/integrator.h"

#include "hdDelegate/embree/ambientOcclusion.h"
#include "hdDelegate/embree/caustics/causticCasters.h"
#include "hdDelegate/embree/deepRay.h"
#include "hdDelegate/embree/media/mediaAround.h"
#include "hdDelegate/embree/media/splatsAlong.h"
#include "hdDelegate/embree/media/subsurface.h"
#include "hdDelegate/embree/sampleBlock.h"
#include "hdDelegate/embree/vertex.h"

#include <cmath>
#include <optional>
#include <utility>

namespace patina {

Integrator::Integrator(const EmbreeScene& scene, const SceneLights& lights,
                       const CameraRays& camera, const RenderSettings& settings,
                       const std::vector<AovSpec>& aovs)
    : _scene(scene), _lights(lights), _camera(camera), _settings(settings),
      _writer(aovs, camera, settings.filterRadius), _shadows(scene, settings.enableShadows),
      _events(lights, _writer.lightPaths()), _lightSampling(scene, lights, _shadows, _events),
      _metLights(scene, lights, _shadows, _events, camera, settings.enableSceneLights),
      _media(scene, _lightSampling, camera, _settings),
      _photonTracer(scene, lights, _shadows, _media, _settings),
      _filter(_writer.splats() ? 0.5f : settings.filterRadius),
      _wavelengths(Wavelengths::of(*RenderingSpace::find(settings.renderingColorSpace))),
      _cullBack(settings.cullStyle.rfind("back", 0) == 0),
      _cullFront(settings.cullStyle.rfind("front", 0) == 0),
      _cullDoubleSided(settings.cullStyle.find("Unless") == std::string::npos),
      _ambientOcclusion(settings.integrator == "ambientOcclusion") {
    const vec3 eye = vec3(glm::inverse(camera.worldToCamera())[3]);
    if (std::isfinite(eye.x + eye.y + eye.z)) _cameraMedia = mediaAround(scene, eye, 0.5f);
}

/// Lets a path of a block of samples begin at the camera.
void Integrator::start(Path& path, const CameraRay& ray, uint32_t block) const {
    path.indirectClamp = _settings.indirectClamp;
    if (_settings.indirectRoughness > 0.0f)
        path.indirectRoughness = _settings.indirectRoughness * SampleBlock::radius(int(block));
    path.origin = ray.origin;
    path.direction = ray.direction;
    path.near = ray.near;
    path.far = ray.far;
    path.time = ray.time;
    path.coneWidth = ray.coneWidth;
    path.coneSpread = ray.coneSpread;
    path.media = _cameraMedia;
}

/// Lets a path begin that shows nothing. @returns false where the camera sees nothing
bool Integrator::start(Path& path, const vec2& place, uint32_t block) const {
    const vec4 uFilm = path.sampler.next4();
    const float uTime = path.sampler.next2().x;
    const CameraRay ray =
        _camera.ray(place + _filter.sample(vec2(uFilm)), vec2(uFilm.z, uFilm.w), uTime, place);
    if (!ray.seen) return false;
    start(path, ray, block);
    path.shown = path.featured = true;
    return true;
}

void Integrator::findLight(uint32_t block, uint32_t index, SharedPoints& found,
                           TraceCounters& counters) const {
    constexpr uint32_t own = 0x5a4ed119u; // numbers that no pixel has
    Path path(Sampler(own, block, _settings.seed, index));
    const vec2 size(_settings.width, _settings.height);
    const vec2 place = glm::min(glm::floor(path.sampler.next2() * size), size - 1.0f);
    if (!start(path, place + 0.5f, block)) return;
    path.seen = false; // it does not split
    path.indirectClamp = 0.0f;
    path.found = &found;
    found.begin();
    Film nowhere;
    while (advance(path, {nowhere, int(place.x), int(place.y), 0.0f}, counters)) {
    }
    ++counters.paths;
    found.end(path.radiance);
}

void Integrator::split(const std::atomic<bool>& stopped) {
    const Splitting wanted{_settings.lightSamples, _settings.branches};
    _splitting = SplitProbe::splitting;
    _splitting = _ambientOcclusion
                     ? Splitting()
                     : chooseSplitting(_settings.width, _settings.height, wanted,
                                       [&](int x, int y, uint32_t i) {
                                           return stopped ? SplitProbe() : probe(x, y, i);
                                       });
    _isSplit = true;
}

SplitProbe Integrator::probe(int x, int y, uint32_t index) const {
    SplitProbe result;
    Path path(Sampler(uint32_t(x), uint32_t(y), 0, index));
    if (!start(path, vec2(x, y) + 0.5f, 0)) return result;
    path.probe = &result;
    TraceCounters counters;
    Film nowhere;
    while (advance(path, {nowhere, x, y, 0.0f}, counters)) {
    }
    result.end(path.radiance, counters.cost());
    return result;
}

void Integrator::sample(Film& film, int x, int y, uint32_t index, TraceCounters& counters) const {
    Sampler sampler = _writer.sampler(x, y, _settings.seed, index);
    const vec4 uFilm = sampler.next4();
    const float uTime = sampler.next2().x;
    const vec2 offset = _filter.sample(vec2(uFilm));
    const vec2 pixel = vec2(x, y) + 0.5f + offset;
    const CameraRay ray = _camera.ray(pixel, vec2(uFilm.z, uFilm.w), uTime, vec2(x, y) + 0.5f);
    const AovTarget target{film, x, y, glm::length(offset), PixelFilter::quarterOf(offset)};
    if (!ray.seen) return _writer.writeDark(target);
    counters.clock.enter(nullptr);
    if (_ambientOcclusion) {
        const AmbientOcclusion occlusion{_scene, _settings.ambientOcclusionSamples};
        float depth = deepBackground;
        const float seen =
            occlusion.sample(ray, sampler, _writer.aovs(), target, _camera, counters.rays, depth);
        ++counters.paths;
        return _writer.writeGrey(seen, depth, target);
    }

    Path path(sampler);
    start(path, ray, index / SampleBlock::samples);
    std::optional<DeepRay> deep;
    if (film.deep()) path.deep = &deep.emplace();
    path.shown = _writer.aovs().empty() && !path.deep;
    std::optional<LightPathRecord> record;
    if (!_writer.lightPaths().empty()) path.lightPaths = &record.emplace(_writer.lightPaths());
    while (advance(path, target, counters)) {
    }
    ++counters.paths;
    _writer.write(path, target, vec3(_scene.origin()));
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
        path.pass(point);
        return ++path.passThroughs <= maxPassThroughs;
    }
    const bool caught = path.fromCamera() && catchingOf(hit).any();
    step = meet(path, point, hit, caught);
    if (step != Step::Arrives) return step == Step::GoesOn;
    if (path.fromCamera() && !caught) path.alpha = 1.0f;
    path.alpha += std::exchange(path.caught, 0.0f);
    path.lightSamples = path.seen ? _splitting.lightSamples : 1;
    path.coneWidth = width;
    path.travelled = 0.0f;
    // What photons went through as it is stays so: the two have the light of one surface together.
    if (!(path.onPhotons && castsCaustics(program)))
        point.shading.leastRoughness = path.indirectRoughness * path.blur;

    return caught                ? shadeCatcher(path, point, hit, target, counters)
           : program.disperses() ? disperse(path, point, hit, target, counters)
                                 : scatter(path, point, hit, target, counters);
}

/// Traces the path's ray, and adds the lights that it meets on its way.
Integrator::Step Integrator::find(Path& path, Hit& hit, TraceCounters& counters) const {
    if (std::exchange(path.departs, false) && _lights.hasOwnShadows())
        _metLights.withOwnShadows(path, counters);
    ++counters.rays;
    const bool found = _scene.intersect(path.origin, path.direction, path.near, path.far, path.time,
                                        path.rays, hit);
    const float distance = found ? hit.distance : path.far;
    const float end = _metLights.along(path, distance);
    if (!path.media.empty() || _scene.fillsSpace()) {
        const Step step = _media.traverse(path, end, counters);
        if (step != Step::Arrives) return step;
    }
    if (end < distance) return Step::Ends;
    if (found) return Step::Arrives;
    if (!(path.caught > 0.0f)) _metLights.escaped(path);
    return Step::Ends;
}

/// Adds what a surface gives off, and decides by the chance of its presence whether the path meets
/// it or passes straight through.
Integrator::Step Integrator::meet(Path& path, SurfacePoint& point, const Hit& hit,
                                  bool caught) const {
    const MaterialProgram& program = *point.slot->program;
    const ShadingPoint& s = point.shading;
    const bool back = glm::dot(s.geometricNormal, s.viewDirection) < 0.0f;
    const bool culled = path.fromCamera() && culls(*hit.surface->prim, back);
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
    if (!culled && !caught && presence > 0.0f) _metLights.emission(path, point, hit, presence);
    if (!(opacity < 1.0f) || path.sampler.random() < opacity) return Step::Arrives;
    if (path.deep && path.fromCamera()) path.deep->pass(_camera.depthAt(s.position), path.radiance);
    path.throughput *= transmittance;
    if (++path.passThroughs > maxPassThroughs || path.throughput == vec3(0.0f)) return Step::Ends;
    if (program.passThroughEnters() && !culled)
        path.media.cross(program, s, _scene.priorityOf(hit));
    path.pass(point);
    return Step::GoesOn;
}

/// Makes lobes ready to be drawn from, and shows the vertex.
void Integrator::prepare(Path& path, const SurfacePoint& point, Bsdf& bsdf,
                         const AovTarget& target) const {
    if (bsdf.stochastic()) bsdf.seed(path.sampler.randomBits());
    _writer.show(path, point, bsdf, target);
}

/// Mattes, and catchers of shadows and reflections: what the camera sees of them is put over a
/// picture that shows them already. The path may go on by reflection.
bool Integrator::shadeCatcher(Path& path, const SurfacePoint& point, const Hit& hit,
                              const AovTarget& target, TraceCounters& counters) const {
    Bsdf bsdf;
    setUpLobes(point, bsdf);
    prepare(path, point, bsdf, target);
    const Catching catching = catchingOf(hit);
    if (catching.matte) return false;
    float left = 1.0f - path.alpha; // of the picture behind, past splats
    if (catching.shadows && bsdf.hasNonDelta() && !_lightSampling.empty()) {
        const float dark = left * _lightSampling.shadowed(path, point, hit, bsdf, counters);
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
    path.depart(point, hit, bsdf, next, _lights.splitsLobes());
    path.specular = true; // no light sample was taken beside it
    ++path.depth;
    return true;
}

/// Takes the path through a vertex of one wavelength, or of three channels.
bool Integrator::scatter(Path& path, SurfacePoint& point, const Hit& hit, const AovTarget& target,
                         TraceCounters& counters) const {
    const bool shares = (_shared || path.found) && comesFromRough(path);
    LightSampling::Draws draws;
    if (!shares) draws = _lightSampling.beginAll(path, point, _settings.maxDepth);
    Bsdf bsdf;
    setUpLobes(point, bsdf);
    prepare(path, point, bsdf, target);
    if (endsAt(path, hit)) return false;
    if (_photons) _photons->meet(path, point, bsdf, path.coneWidth, _camera, _settings.maxDepth);
    if (shares && path.found) path.found->meet(path, point, bsdf);
    if (shares && !path.found && !takeShared(*_shared, path, point, bsdf)) return false;
    if (bsdf.stochastic() || bsdf.transmits() != draws.twoSided) draws.count = 0;
    return goOn(path, point, hit, bsdf, nullptr, draws, target, counters);
}

/// Takes the path through a vertex whose lobes differ between wavelengths. They are chosen where it
/// first meets such a material: until then its three channels stand for all of the spectrum.
bool Integrator::disperse(Path& path, SurfacePoint& point, const Hit& hit, const AovTarget& target,
                          TraceCounters& counters) const {
    HeroWavelengths& waves = path.waves;
    if (waves.alone) { // as without dispersion, then
        point.shading.wavelength = waves.nm[0];
        return scatter(path, point, hit, target, counters);
    }
    path.onPhotons = path.throughCasters = false;
    const MaterialProgram& program = *point.slot->program;
    if (!waves.chosen()) path.throughput *= waves.begin(path.sampler.next2().x, _wavelengths);
    if (!waves.alone && !program.hasHeroWavelengths()) path.throughput *= waves.leaveOthers();
    point.shading.wavelength = waves.nm[0];
    Bsdf bsdf;
    setUpLobes(point, bsdf);
    std::optional<DispersedBsdf> dispersed;
    if (!waves.alone) {
        dispersed.emplace(program, point.shading, waves, bsdf);
        // Lobes of random values have no density that could weigh one wavelength by another.
        if (dispersed->stochastic()) {
            path.throughput *= waves.leaveOthers();
            dispersed.reset();
        }
    }
    prepare(path, point, bsdf, target);
    return !endsAt(path, hit) && goOn(path, point, hit, bsdf, dispersed ? &*dispersed : nullptr,
                                      LightSampling::Draws(), target, counters);
}

/// Takes light samples at a vertex, and the path on from it. What the camera sees is left by
/// several branches, of which all but the last are followed to their end here.
/// @param dispersed the lobes of several wavelengths, or null
bool Integrator::goOn(Path& path, const SurfacePoint& point, const Hit& hit, const Bsdf& bsdf,
                      const DispersedBsdf* dispersed, const LightSampling::Draws& draws,
                      const AovTarget& target, TraceCounters& counters) const {
    const VertexBsdf vertex(bsdf, dispersed);
    const bool splits = path.seen && vertex.hasNonDelta();
    path.branches = splits ? _splitting.branches : 1;
    addLightSamples(path, point, hit, vertex, draws, counters);
    const bool litBySplats = vertex.hasNonDelta() && !_scene.splats().lights().empty();
    if (litBySplats) path.add(sampleSplats(_scene, path, point, vertex, counters));

    if (path.branches > 1) return branch(path, point, hit, vertex, litBySplats, target, counters);
    return leave(path, point, hit, vertex, litBySplats, path.sampler.next4(), counters);
}

bool Integrator::branch(Path& path, const SurfacePoint& point, const Hit& hit,
                        const VertexBsdf& vertex, bool litBySplats, const AovTarget& target,
                        TraceCounters& counters) const {
    const uint32_t branches = uint32_t(path.branches);
    const Sampler::Set u = path.sampler.nextSet(branches);
    path.throughput *= path.share = 1.0f / float(branches);
    std::optional<LightPathRecord> record;
    if (path.lightPaths) record.emplace(*path.lightPaths);
    for (uint32_t i = 0;; ++i) {
        const bool isLast = i + 1 == branches; // it goes on as the path itself
        std::optional<Path> copy;
        Path& own = isLast ? path : copy.emplace(path);
        own.sampler.split(i, branches);
        if (path.probe)
            path.probe->begin(SplitProbe::Branch + int(i), path.radiance, counters.cost());
        bool goesOn = leave(own, point, hit, vertex, litBySplats, u.point4(i), counters);
        if (isLast) return goesOn;
        while (goesOn)
            goesOn = advance(own, target, counters);
        path.radiance = own.radiance;
        if (record) path.lightPaths->goBack(*record);
    }
}

void Integrator::addLightSamples(Path& path, const SurfacePoint& point, const Hit& hit,
                                 const VertexBsdf& vertex, const LightSampling::Draws& draws,
                                 TraceCounters& counters) const {
    const Sampler::Set u = path.sampler.nextSet(uint32_t(path.lightSamples));
    if (!vertex.hasNonDelta() || path.throughCasters || _lightSampling.empty()) return;
    for (int i = 0; i < path.lightSamples; ++i) {
        if (path.probe && path.seen) path.probe->begin(i, path.radiance, counters.cost());
        const LightDraw draw = i < draws.count
                                   ? draws.begun[i]
                                   : _lightSampling.begin(path, point, vertex.transmits(),
                                                          vec3(u.point4(uint32_t(i))));
        path.add(_lightSampling.atSurface(path, point, vertex, hit, draw, counters));
    }
    if (path.probe && path.seen)
        path.probe->begin(SplitProbe::Between, path.radiance, counters.cost());
}

/// Takes a path on from a vertex. @param u of the choice
bool Integrator::leave(Path& path, const SurfacePoint& point, const Hit& hit,
                       const VertexBsdf& vertex, bool litBySplats, const vec4& u,
                       TraceCounters& counters) const {
    const BsdfSample next = vertex.sample(u, path.waves);
    if (next.event == 0) return false;
    path.throughput *= next.weight;
    if (!(luminance(path.throughput) > 0.0f)) return false;
    if ((next.event & LOBE_SUBSURFACE) != 0) {
        path.onPhotons = false;
        if (!scatterBeneath(_scene, _lightSampling, path, point, hit,
                            vertex.bsdf().subsurface(next), counters))
            return false;
    } else {
        if ((next.event & sh::LOBE_TRANSMIT) != 0)
            path.media.cross(*point.slot->program, point.shading, _scene.priorityOf(hit),
                             vertex.bsdf().ior() * point.shading.surroundingIor);
        path.depart(point, hit, vertex, next, _lights.splitsLobes());
        path.splatsSampled = litBySplats && !path.specular && staysOutside(point, next.wi);
    }
    ++path.depth;
    return path.survivesRoulette(_settings.rouletteDepth);
}

} // namespace patina
