// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/deepRay.h"
#include "hdDelegate/embree/integrator.h"

#include "hdDelegate/embree/media/freeFlight.h"
#include "hdDelegate/embree/media/randomWalk.h"

#include "shaders/closure.h"

#include <algorithm>
#include <cmath>

// Paths inside of participating media.

namespace patina {

vec3 Integrator::mediumLight(Path& path, const vec3& position, const sh::PhaseMixture& phase,
                             const vec3& u, TraceCounters& counters) const {
    LightSample light;
    if (!_lights.set().sample(position, vec3(0.0f), true, u, path.time, light) ||
        !(light.pdf > 0.0f))
        return vec3(0.0f);
    const LightInfo& info = _lights.info(light.light);
    const sh::LobeEval scattered = sh::phaseMixtureEval(phase, -path.direction, light.direction);
    vec3 value = scattered.value * info.diffuse;
    vec3 radiance = light.radiance;
    if (info.triangles) radiance = _lights.triangleRadiance(light, position, path.time);
    if (radiance == vec3(0.0f)) return vec3(0.0f);
    const bool sampledAlone = light.delta || (info.triangles && info.ownShadows);
    const float weight = sampledAlone ? 1.0f : misWeight(light.pdf, scattered.pdf, info.dome);
    value *= radiance * (weight / light.pdf);
    value *=
        visibility(path, path.media, position, light.direction, light.distance, info, counters);
    if (path.lightPaths)
        path.lightPaths->lit(EventType::Volume, value, vec3(0.0f), emitterOf(light.light));
    return value;
}

vec3 Integrator::transmittanceTo(Path& path, float distance) const {
    vec3 left(1.0f);
    if (!path.media.empty()) left = transmittance(path.media.extinction(), distance);
    if (_scene.fillsSpace())
        left *= _scene.transmittance(
            {path.origin, path.direction, path.near, distance, path.time, path.rays}, path.sampler);
    return left;
}

Integrator::Step Integrator::traverseMedia(Path& path, float distance,
                                           TraceCounters& counters) const {
    const bool fills = !path.media.empty();
    const vec3 extinction = fills ? path.media.extinction() : vec3(0.0f);
    const vec3 scattering = fills ? path.media.scattering() : vec3(0.0f);
    if (fills && path.media.medium().emission != vec3(0.0f)) {
        if (path.lightPaths) path.lightPaths->straight(LightEvent());
        addRadiance(path, emissionAlong(path.media.medium().emission, extinction, distance));
    }
    FreeFlight flight;
    flight.distance = distance;
    if (scattering != vec3(0.0f))
        flight = sampleFreeFlight(extinction, scattering, path.throughput, distance,
                                  path.sampler.next2());
    VolumeScene::Collision collision;
    vec3 through(1.0f);
    if (!_scene.volumes().empty()) {
        through = path.throughput;
        collision = _scene.volumes().track(path.origin, path.direction, flight.distance, path.rays,
                                           through, path.sampler);
        if (collision.emitted != vec3(0.0f)) {
            // It holds the throughput already.
            const vec3 before = path.throughput;
            path.throughput = vec3(1.0f);
            if (path.lightPaths) path.lightPaths->straight(LightEvent());
            addRadiance(path, collision.emitted);
            path.throughput = before;
            const float sum =
                (collision.emitted.x + collision.emitted.y + collision.emitted.z) / 3.0f;
            if (path.deep && path.fromCamera() && sum > 0.0f)
                path.deep->pass(
                    _camera.depthAt(path.origin + path.direction * (collision.emittedFrom / sum)),
                    path.radiance, true);
        }
    }
    // A volume that scatters before the medium does cuts the flight through the medium short.
    const bool inMedium = flight.scattered && !collision.scattered;
    const float way = collision.scattered ? collision.distance : flight.distance;
    vec3 weight =
        fills ? weighFreeFlight(extinction, scattering, path.throughput, way, inMedium).weight
              : vec3(1.0f);
    if (!_scene.splats().empty()) weight *= passSplats(path, distance, way);
    if (!_scene.volumes().empty()) path.throughput = through;
    path.throughput *= weight;
    if (!(luminance(path.throughput) > 0.0f)) return Step::Ends;
    if (collision.scattered) return scatterInside(path, collision.medium, way, counters);
    if (!inMedium) return Step::Arrives;
    return scatterInside(path, Medium(path.media.medium()), way, counters);
}

Integrator::Step Integrator::scatterInside(Path& path, const Medium& medium, float distance,
                                           TraceCounters& counters) const {
    if (path.fromCamera()) path.alpha = 1.0f;
    if (path.deep && path.fromCamera())
        path.deep->end(_camera.depthAt(path.origin + path.direction * distance), true);
    if (path.depth >= _settings.maxDepth || path.scatterings >= _settings.maxScatterings)
        return Step::Ends;
    ++path.scatterings;
    path.onPhotons = path.throughCasters = false;
    path.lightSamples = 1;
    const vec3 position = path.origin + path.direction * distance;
    const sh::PhaseMixture phase = sh::phaseMixture(medium, path.throughput);
    const vec4 u = path.sampler.next4();
    if (!_lights.set().empty())
        addRadiance(path, mediumLight(path, position, phase, vec3(u), counters));
    const vec2 uDirection = path.sampler.next2();
    const sh::LobeSample next =
        sh::phaseMixtureSample(phase, -path.direction, vec3(uDirection, 0.0f), u.w);
    path.throughput *= next.weight;
    if (!(luminance(path.throughput) > 0.0f) || !survivesRoulette(path)) return Step::Ends;

    if (path.lightPaths) path.lightPaths->scatter(EventType::Volume, false, vec3(1.0f));
    path.rays = RayVolume;
    path.specular = path.splatsSampled = false;
    path.pdf = next.pdf;
    path.vertex = position;
    path.vertexNormal = vec3(0.0f);
    path.vertexTwoSided = true;
    path.vertexSurface = nullptr;
    path.vertexInstanceCategories = nullptr;
    path.diffuseShare = vec3(1.0f);
    path.specularShare = vec3(0.0f);
    path.coneWidth += path.coneSpread * distance;
    path.coneSpread = std::min(1.0f, path.coneSpread + 0.5f);
    path.origin = position;
    path.direction = next.wi;
    path.departs = true;
    path.near = 0.0f;
    path.far = INFINITY;
    path.travelled = 0.0f;
    path.shown = true; // what lies behind is no longer seen straight
    if (!path.featured) path.featureAlbedo += glm::min(path.throughput, vec3(1.0f));
    path.featured = true;
    return Step::GoesOn;
}

bool Integrator::scatterBeneath(Path& path, const SurfacePoint& point, const Hit& hit,
                                const SubsurfaceEntry& entry, TraceCounters& counters) const {
    const ShadingPoint& s = point.shading;
    const bool back = glm::dot(s.geometricNormal, s.viewDirection) < 0.0f;
    const vec3 outside = back ? -s.geometricNormal : s.geometricNormal;
    WalkExit exit;
    // A walk that is too short to be told from staying where it is ends as on an open mesh:
    // diffuse.
    const vec3& radius = entry.radius;
    exit.open = !(std::max({radius.x, radius.y, radius.z}) > 4.0f * point.offset);
    if (!exit.open) {
        const bool flat = hit.surface->shape == Surface::Shape::Triangles;
        const vec3 start = flat ? s.position : s.position - outside * point.offset;
        const WalkMedium medium = walkMedium(entry, point.offset);
        // About the geometric normal: beneath the surface there is no shading normal.
        const vec2 u = path.sampler.next2();
        const WalkStart first = startWalk(medium, u, path.sampler.random());
        const vec3& w = first.direction;
        vec3 x, y;
        sh::completeBasis(-outside, x, y);
        const vec3 inwards = x * w.x + y * w.y - outside * w.z;
        exit = walkBeneath(_scene, medium, hit, back, outside, start, inwards, path.sampler,
                           counters.rays);
        exit.weight *= first.weight;
    }
    path.throughput *= exit.open ? entry.color * exit.weight : exit.weight;
    if (!(luminance(path.throughput) > 0.0f)) return false;

    // Light leaves as from a white diffuse surface, wherever that is.
    SurfacePoint leaving = point;
    leaving.hit = &hit;
    if (exit.found)
        computeSurfacePoint(exit.hit, exit.origin, exit.direction, path.coneWidth, leaving);
    ShadingPoint& there = leaving.shading;
    const vec3 up = back ? -there.geometricNormal : there.geometricNormal;
    there.viewDirection = up;
    Bsdf bsdf;
    bsdf.makeDiffuse(back ? -there.normal : there.normal, up);
    const Hit& exitHit = exit.found ? exit.hit : hit;
    const vec4 uLight = path.sampler.next4();
    path.lightSamples = 1;
    if (path.lightPaths) path.lightPaths->beneath = true;
    if (!_lights.set().empty())
        addRadiance(path, directLight(path, leaving, bsdf, exitHit,
                                      beginLight(path, leaving, bsdf.transmits(), vec3(uLight)),
                                      counters));
    const BsdfSample next = bsdf.sample(vec3(path.sampler.next2(), 0.0f), 0.0f);
    if (next.event == 0) return false;
    path.throughput *= next.weight;
    depart(path, leaving, exitHit, bsdf, next);
    if (path.lightPaths) path.lightPaths->beneath = false;
    return true;
}

constexpr float rouletteBelow = 0.25f; // of the throughput that a path had at the camera
constexpr int endlessDepth = 16;       // surfaces, beyond which nearly white rooms end paths too

/// Paths are ended for what they have lost, those of little light alone: what ends sooner saves
/// less time than its noise costs. A path that scatters in a bright medium goes on for long and
/// should, and so should one in a white room, up to a depth. Paths of a pixel share evenly spread
/// numbers.
bool Integrator::survivesRoulette(Path& path) const {
    if (path.depth + path.scatterings <= _settings.rouletteDepth) return true;
    const float bound = path.scatterings > 0 || path.depth <= endlessDepth ? 1.0f : 0.95f;
    const float left = std::max({path.throughput.x, path.throughput.y, path.throughput.z});
    const float survive = std::min(bound, left / rouletteBelow);
    if (survive >= 1.0f) return true;
    if (path.sampler.next2().x >= survive) return false;
    path.throughput /= survive;
    return true;
}

} // namespace patina
