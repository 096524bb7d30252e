// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/sampleWriter.h"

#include "hdDelegate/embree/deepRay.h"

#include <algorithm>
#include <utility>

namespace patina {

SampleWriter::SampleWriter(const std::vector<AovSpec>& aovs, const CameraRays& camera)
    : _aovs(aovs), _camera(camera), _lightPaths(aovs) {
    for (size_t i = 0; i < aovs.size(); ++i) {
        if (aovs[i].id == AovId::denoisingAlbedo) _albedo = int(i);
        if (aovs[i].id == AovId::denoisingNormal) _normal = int(i);
    }
}

void SampleWriter::show(Path& path, const SurfacePoint& point, const Bsdf& bsdf,
                        const AovTarget& target) const {
    if (!std::exchange(path.shown, true)) {
        writeAovs(_aovs, target, _camera, point, bsdf);
        if (path.deep) path.deep->end(_camera.depthAt(point.shading.position));
    }
    const bool guided = _albedo >= 0 || _normal >= 0;
    if (path.featured || !guided || !bsdf.hasNonDelta()) return;
    path.featured = true;
    path.featureAlbedo += path.throughput * bsdf.albedo(); // behind what splats show
    path.featureNormal = point.shading.normal;
}

void SampleWriter::addGuides(const vec3& albedo, const vec3& normal,
                             const AovTarget& target) const {
    if (_albedo >= 0) target.film.addAov(_albedo, target.x, target.y, &albedo.x, 0.0f);
    if (_normal >= 0) target.film.addAov(_normal, target.x, target.y, &normal.x, 0.0f);
}

void SampleWriter::write(const Path& path, const AovTarget& target, const vec3& origin) const {
    if (path.screen >= 0)
        writeScreenAovs(_aovs, target, _camera, path.screenPosition, origin, path.screen);
    // Surfaces that only mirror, lamps and skies are their own texture.
    addGuides(path.featured ? path.featureAlbedo
                            : glm::clamp(path.radiance, vec3(0.0f), vec3(1.0f)),
              path.featureNormal, target);
    Film& film = target.film;
    const float scale = _camera.camera().exposureScale;
    const vec3 color = path.radiance * scale;
    const bool usable = film.usable(color, path.alpha);
    if (path.lightPaths) _lightPaths.write(*path.lightPaths, target, scale, !usable);
    if (path.deep)
        path.deep->write(*film.deep(), target.x, target.y, path.radiance, path.alpha, scale,
                         usable);
    film.addColor(target.x, target.y, color, path.alpha);
}

/// Darkness counts in the means of light's parts as it does in the colour's.
void SampleWriter::writeDark(const AovTarget& target) const {
    if (!_lightPaths.empty()) _lightPaths.write(LightPathRecord(_lightPaths), target, 1.0f, false);
    addGuides(vec3(0.0f), vec3(0.0f), target);
    Film& film = target.film;
    film.addColor(target.x, target.y, vec3(0.0f), 0.0f);
    if (film.deep()) film.deep()->add(target.x, target.y, nullptr, 0);
}

void SampleWriter::writeGrey(float seen, float depth, const AovTarget& target) const {
    DeepEvent event;
    event.depth = depth;
    event.color = vec3(std::max(seen, 0.0f));
    event.alpha = seen < 0.0f ? 0.0f : 1.0f;
    Film& film = target.film;
    if (film.deep()) film.deep()->add(target.x, target.y, &event, 1);
    film.addColor(target.x, target.y, event.color, event.alpha);
}

} // namespace patina
