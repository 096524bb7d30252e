// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/media/mediaTransport.h"

#include "hdDelegate/embree/deepRay.h"
#include "hdDelegate/embree/lightSampling.h"
#include "hdDelegate/embree/media/freeFlight.h"
#include "hdDelegate/embree/media/splatsAlong.h"

#include "shaders/closure.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

/// Adds what shines along the ray itself. @param light over the throughput
void addGlow(Path& path, const vec3& light) {
    if (path.lightPaths) path.lightPaths->straight(LightEvent());
    path.add(light);
}

} // namespace

vec3 transmittanceTo(const EmbreeScene& scene, Path& path, float distance) {
    vec3 left(1.0f);
    if (!path.media.empty()) left = transmittance(path.media.extinction(), distance);
    if (scene.fillsSpace())
        left *= scene.transmittance(
            {path.origin, path.direction, path.near, distance, path.time, path.rays}, path.sampler);
    return left;
}

Path::Step MediaTransport::traverse(Path& path, float distance, TraceCounters& counters) const {
    const bool fills = !path.media.empty();
    const vec3 extinction = fills ? path.media.extinction() : vec3(0.0f);
    const vec3 scattering = fills ? path.media.scattering() : vec3(0.0f);
    if (fills && path.media.medium().emission != vec3(0.0f))
        addGlow(path, emissionAlong(path.media.medium().emission, extinction, distance));
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
            const vec3 before = std::exchange(path.throughput, vec3(1.0f));
            addGlow(path, collision.emitted);
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
    if (!_scene.splats().empty()) weight *= passSplats(_scene, path, distance, way);
    if (!_scene.volumes().empty()) path.throughput = through;
    path.throughput *= weight;
    if (!(luminance(path.throughput) > 0.0f)) return Path::Step::Ends;
    if (collision.scattered) return scatter(path, collision.medium, way, counters);
    if (!inMedium) return Path::Step::Arrives;
    return scatter(path, Medium(path.media.medium()), way, counters);
}

Path::Step MediaTransport::scatter(Path& path, const Medium& medium, float distance,
                                   TraceCounters& counters) const {
    if (path.fromCamera()) path.alpha = 1.0f;
    if (path.deep && path.fromCamera())
        path.deep->end(_camera.depthAt(path.origin + path.direction * distance), true);
    if (path.depth >= _settings.maxDepth || path.scatterings >= _settings.maxScatterings)
        return Path::Step::Ends;
    ++path.scatterings;
    path.onPhotons = path.throughCasters = false;
    path.lightSamples = 1;
    const vec3 position = path.origin + path.direction * distance;
    const sh::PhaseMixture phase = sh::phaseMixture(medium, path.throughput);
    const vec4 u = path.sampler.next4();
    if (!_lights.empty()) path.add(_lights.inMedium(path, position, phase, vec3(u), counters));
    const vec2 uDirection = path.sampler.next2();
    const sh::LobeSample next =
        sh::phaseMixtureSample(phase, -path.direction, vec3(uDirection, 0.0f), u.w);
    path.throughput *= next.weight;
    if (!(luminance(path.throughput) > 0.0f) || !path.survivesRoulette(_settings.rouletteDepth))
        return Path::Step::Ends;

    if (path.lightPaths) path.lightPaths->scatter(EventType::Volume, false, vec3(1.0f));
    path.rays = RayVolume;
    path.specular = path.splatsSampled = path.seen = false;
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
    path.blur = 1.0f;
    path.origin = position;
    path.direction = next.wi;
    path.departs = true;
    path.near = 0.0f;
    path.far = INFINITY;
    path.travelled = 0.0f;
    path.shown = true; // what lies behind is no longer seen straight
    if (!path.featured) path.featureAlbedo += glm::min(path.throughput, vec3(1.0f));
    path.featured = true;
    return Path::Step::GoesOn;
}

} // namespace patina
