// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/deepRay.h"
#include "hdDelegate/embree/integrator.h"

#include <cmath>

// Lights that a ray meets.

namespace patina {

/// The share of a light that its filters leave for the point that it lights: where the path comes
/// from.
/// @param distance along the ray
vec3 Integrator::filteredTo(const Path& path, int light, float distance) const {
    const vec3 point = path.fromCamera() ? path.origin : path.vertex;
    const float passed = glm::length(path.origin - point); // surfaces that let the ray through
    return _lights.set().filtered(light, point, path.direction, passed + distance, path.time);
}

/// Light that the ray meets before `distance`: area lights, and at infinity domes and suns.
/// @returns where the camera's ray ends on a light, or `distance`.
float Integrator::addLightsAlong(Path& path, float distance) const {
    LightHit hits[8];
    const int count = _lights.set().intersect(path.origin, path.direction, path.near, distance,
                                              path.time, hits, 8);
    for (int i = 0; i < count; ++i)
        hits[i].radiance *= filteredTo(path, hits[i].light, hits[i].distance);
    if (path.fromCamera()) {
        // The camera sees lights as solid shapes; every other ray passes through them, as shadow
        // rays do, so that light and BSDF samples agree.
        const LightHit* nearest = nullptr;
        for (int i = 0; i < count; ++i)
            if (_lights.info(hits[i].light).cameraVisible &&
                (!nearest || hits[i].distance < nearest->distance))
                nearest = &hits[i];
        if (!nearest) return distance;
        const vec3 seen =
            path.throughput * transmittanceTo(path, nearest->distance) * nearest->radiance;
        path.radiance += seen;
        if (path.lightPaths) path.lightPaths->see(emitterOf(nearest->light), seen);
        path.alpha = 1.0f;
        if (path.deep)
            path.deep->end(_camera.depthAt(path.origin + path.direction * nearest->distance));
        return nearest->distance;
    }
    for (int i = 0; i < count; ++i)
        if (path.specular || !_lights.info(hits[i].light).ownShadows)
            addLight(path, hits[i].light,
                     transmittanceTo(path, hits[i].distance) * hits[i].radiance,
                     densityOf(path, hits[i]));
    return distance;
}

float Integrator::densityOf(const Path& path, const LightHit& hit) const {
    return path.specular ? 0.0f
                         : _lights.set().pdf(hit.light, path.vertex, path.vertexNormal,
                                             path.vertexTwoSided, path.time, hit);
}

/// Lights with shadows of their own, which a ray from a vertex finds past the shapes that stop it,
/// as light samples do. Triangles that glow are left to light samples. A mirror shows lights where
/// its ray meets them.
void Integrator::addOwnShadows(Path& path, TraceCounters& counters) const {
    if (path.specular || path.throughCasters) return;
    const auto seen = [&](int light, float distance) {
        const LightInfo& info = _lights.info(light);
        return filteredTo(path, light, distance) *
               visibility(path, path.media, path.origin, path.direction, distance, info, counters);
    };
    LightHit hits[8];
    const int count =
        _lights.set().intersect(path.origin, path.direction, 0.0f, INFINITY, path.time, hits, 8);
    for (int i = 0; i < count; ++i)
        if (_lights.info(hits[i].light).ownShadows)
            addLight(path, hits[i].light, hits[i].radiance * seen(hits[i].light, hits[i].distance),
                     densityOf(path, hits[i]));
    for (int light : _lights.set().infiniteLights())
        if (_lights.info(light).ownShadows) addInfinite(path, light, seen(light, INFINITY));
}

/// @param seen what is left of the light on its way
void Integrator::addInfinite(Path& path, int light, const vec3& seen) const {
    const EnvironmentMap::Place place = _lights.set().place(light, path.direction, path.time);
    const vec3 radiance = _lights.set().environment(light, place, path.time) * seen;
    if (radiance == vec3(0.0f)) return;
    const float lightPdf = path.specular
                               ? 0.0f
                               : _lights.set().pdfInfinite(light, path.vertex, path.vertexNormal,
                                                           path.vertexTwoSided, place, path.time);
    addLight(path, light, radiance, lightPdf);
}

/// Light found by following the BSDF, weighted against what light samples would have found.
void Integrator::addLight(Path& path, int light, const vec3& radiance, float lightPdf) const {
    if (path.throughCasters) return;
    const LightInfo& info = _lights.info(light);
    if (!linked(info.lightCategory, path.vertexSurface, path.vertexInstanceCategories)) return;
    const float weight =
        path.specular ? 1.0f : misWeight(path.pdf, float(path.lightSamples) * lightPdf, info.dome);
    const vec3 share = path.diffuseShare * info.diffuse + path.specularShare * info.specular;
    if (path.lightPaths)
        path.lightPaths->found(emitterOf(light), radiance * weight, info.diffuse, info.specular);
    addRadiance(path, share * radiance * weight);
}

void Integrator::addEscaped(Path& path) const {
    // A ray that is not traced for want of a direction has no place in an image.
    if (!std::isfinite(path.direction.x + path.direction.y + path.direction.z)) return;
    for (int light : _lights.set().infiniteLights()) {
        const LightInfo& info = _lights.info(light);
        if (path.fromCamera() && (!info.cameraVisible || !info.dome)) continue;
        if (!path.fromCamera()) {
            if (path.specular || !info.ownShadows)
                addInfinite(path, light, filteredTo(path, light, INFINITY));
            continue;
        }
        const EnvironmentMap::Place place = _lights.set().place(light, path.direction, path.time);
        const vec3 radiance =
            _lights.set().environment(light, place, path.time) * filteredTo(path, light, INFINITY);
        path.radiance += path.throughput * radiance;
        if (path.lightPaths) path.lightPaths->see(emitterOf(light), path.throughput * radiance);
        path.alpha = 1.0f;
    }
}

} // namespace patina
