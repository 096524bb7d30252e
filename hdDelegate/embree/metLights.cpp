// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/metLights.h"

#include "hdDelegate/embree/deepRay.h"
#include "hdDelegate/embree/media/mediaTransport.h"
#include "hdDelegate/embree/vertex.h"

#include <cmath>

namespace patina {

vec3 MetLights::filtered(const Path& path, int light, float distance) const {
    const vec3 point = path.fromCamera() ? path.origin : path.vertex;
    const float passed = glm::length(path.origin - point); // surfaces that let the ray through
    return _lights.set().filtered(light, point, path.direction, passed + distance, path.time);
}

float MetLights::densityOf(const Path& path, const LightHit& hit) const {
    return path.specular ? 0.0f
                         : _lights.set().pdf(hit.light, path.vertex, path.vertexNormal,
                                             path.vertexTwoSided, path.time, hit);
}

void MetLights::show(Path& path, int light, const vec3& radiance) const {
    path.radiance += radiance;
    if (path.lightPaths) path.lightPaths->see(_events.emitter(light), radiance);
    path.alpha = 1.0f;
}

float MetLights::along(Path& path, float distance) const {
    if (!_shapes) return distance;
    LightHit hits[8];
    const int count = _lights.set().intersect(path.origin, path.direction, path.near, distance,
                                              path.time, hits, 8);
    for (int i = 0; i < count; ++i)
        hits[i].radiance *= filtered(path, hits[i].light, hits[i].distance);
    if (path.fromCamera()) {
        // The camera sees lights as solid shapes; every other ray passes through them, as shadow
        // rays do, so that light and BSDF samples agree.
        const LightHit* nearest = nullptr;
        for (int i = 0; i < count; ++i)
            if (_lights.info(hits[i].light).cameraVisible &&
                (!nearest || hits[i].distance < nearest->distance))
                nearest = &hits[i];
        if (!nearest) return distance;
        show(path, nearest->light,
             path.throughput * transmittanceTo(_scene, path, nearest->distance) *
                 nearest->radiance);
        if (path.deep)
            path.deep->end(_camera.depthAt(path.origin + path.direction * nearest->distance));
        return nearest->distance;
    }
    for (int i = 0; i < count; ++i)
        if (path.specular || !_lights.info(hits[i].light).ownShadows)
            add(path, hits[i].light,
                transmittanceTo(_scene, path, hits[i].distance) * hits[i].radiance,
                densityOf(path, hits[i]));
    return distance;
}

void MetLights::withOwnShadows(Path& path, TraceCounters& counters) const {
    if (path.specular || path.throughCasters) return;
    const auto seen = [&](int light, float distance) {
        return filtered(path, light, distance) *
               _shadows.seen(_lights.info(light),
                             {path.origin, path.direction, distance, path.time}, path.media,
                             path.sampler, counters);
    };
    LightHit hits[8];
    const int count =
        _lights.set().intersect(path.origin, path.direction, 0.0f, INFINITY, path.time, hits, 8);
    for (int i = 0; i < count; ++i)
        if (_lights.info(hits[i].light).ownShadows)
            add(path, hits[i].light, hits[i].radiance * seen(hits[i].light, hits[i].distance),
                densityOf(path, hits[i]));
    for (int light : _lights.set().infiniteLights())
        if (_lights.info(light).ownShadows) addInfinite(path, light, seen(light, INFINITY));
}

void MetLights::addInfinite(Path& path, int light, const vec3& seen) const {
    const EnvironmentMap::Place place = _lights.set().place(light, path.direction, path.time);
    const vec3 radiance = _lights.set().environment(light, place, path.time) * seen;
    if (radiance == vec3(0.0f)) return;
    add(path, light, radiance,
        path.specular ? 0.0f
                      : _lights.set().pdfInfinite(light, path.vertex, path.vertexNormal,
                                                  path.vertexTwoSided, place, path.time));
}

void MetLights::add(Path& path, int light, const vec3& radiance, float lightPdf) const {
    if (path.throughCasters) return;
    const LightInfo& info = _lights.info(light);
    if (!isLinked(info.lightCategory, path.vertexSurface, path.vertexInstanceCategories)) return;
    const float weight =
        path.specular ? 1.0f : misWeight(path.pdf, float(path.lightSamples) * lightPdf, info.dome);
    const vec3 share = path.diffuseShare * info.diffuse + path.specularShare * info.specular;
    if (path.lightPaths)
        path.lightPaths->found(_events.emitter(light), radiance * weight, info.diffuse,
                               info.specular);
    path.add(share * radiance * weight);
}

void MetLights::escaped(Path& path) const {
    // A ray that is not traced for want of a direction has no place in an image.
    if (!std::isfinite(path.direction.x + path.direction.y + path.direction.z)) return;
    for (int light : _lights.set().infiniteLights()) {
        const LightInfo& info = _lights.info(light);
        if (!path.fromCamera()) {
            if (path.specular || !info.ownShadows)
                addInfinite(path, light, filtered(path, light, INFINITY));
        } else if (info.cameraVisible && info.dome) {
            const EnvironmentMap::Place place =
                _lights.set().place(light, path.direction, path.time);
            show(path, light,
                 path.throughput * (_lights.set().environment(light, place, path.time) *
                                    filtered(path, light, INFINITY)));
        }
    }
}

void MetLights::emission(Path& path, const SurfacePoint& point, const Hit& hit,
                         float presence) const {
    const vec3 radiance =
        _lights.emission(point, path.fromCamera() ? &path.origin : &path.vertex) * presence;
    if (radiance == vec3(0.0f)) return;
    const int light = path.fromCamera() ? -1 : _lights.triangleLight(hit);
    if (light < 0) {
        if (path.lightPaths) _events.emission(path, hit);
        path.add(radiance);
        return;
    }
    if (!path.specular && _lights.info(light).ownShadows) return; // light samples have it all
    add(path, light, radiance,
        path.specular ? 0.0f
                      : _lights.set().pdfTriangle(light - _lights.set().lightCount(), path.vertex,
                                                  path.vertexNormal, path.vertexTwoSided,
                                                  point.shading.position));
}

} // namespace patina
