// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/integrator.h"

#include "hdDelegate/embree/ambientOcclusion.h"
#include "hdDelegate/embree/deepRay.h"
#include "hdDelegate/embree/media/mediaAround.h"
#include "hdDelegate/film/film.h"

#include <algorithm>
#include <cmath>
#include <optional>

// A sample of a pixel: its ray, and where its light goes.

namespace patina {

Integrator::Integrator(const EmbreeScene& scene, const SceneLights& lights,
                       const CameraRays& camera, const RenderSettings& settings,
                       const std::vector<AovSpec>& aovs)
    : _scene(scene), _lights(lights), _camera(camera), _settings(settings), _aovs(aovs),
      _lightPaths(aovs), _filter(settings.filterRadius),
      _wavelengths(Wavelengths::of(*RenderingSpace::find(settings.renderingColorSpace))),
      _cullBack(settings.cullStyle.rfind("back", 0) == 0),
      _cullFront(settings.cullStyle.rfind("front", 0) == 0),
      _cullDoubleSided(settings.cullStyle.find("Unless") == std::string::npos),
      _ambientOcclusion(settings.integrator == "ambientOcclusion"),
      _lightSamples(settings.lightSamples > 0 ? settings.lightSamples
                                              : lights.worthwhileSamples()) {
    for (size_t i = 0; i < aovs.size(); ++i) {
        if (aovs[i].id == AovId::denoisingAlbedo) _denoisingAlbedo = int(i);
        if (aovs[i].id == AovId::denoisingNormal) _denoisingNormal = int(i);
    }
    _guided = _denoisingAlbedo >= 0 || _denoisingNormal >= 0;
    _finiteLights = settings.enableSceneLights && lights.set().hasIntersectable();
    const vec3 eye = vec3(glm::inverse(camera.worldToCamera())[3]);
    if (std::isfinite(eye.x + eye.y + eye.z)) _cameraMedia = mediaAround(scene, eye, 0.5f);
}

void Integrator::sample(Film& film, int x, int y, uint32_t index, TraceCounters& counters) const {
    Sampler sampler(uint32_t(x), uint32_t(y), _settings.seed, index);
    const vec4 uFilm = sampler.next4();
    const float uTime = sampler.next2().x;
    const vec2 offset = _filter.sample(vec2(uFilm));
    const vec2 pixel = vec2(x, y) + 0.5f + offset;
    const CameraRay ray = _camera.ray(pixel, vec2(uFilm.z, uFilm.w), uTime, vec2(x, y) + 0.5f);
    const AovTarget target{film, x, y, glm::length(offset)};
    if (!ray.seen) { // darkness counts in the means of light's parts as it does in the colour's
        if (!_lightPaths.empty())
            _lightPaths.write(LightPathRecord(_lightPaths), target, 1.0f, false);
        addFeatures(Path(sampler), target);
        film.addColor(x, y, vec3(0.0f), 0.0f);
        if (film.deep()) film.deep()->add(x, y, nullptr, 0);
        return;
    }
    counters.clock.enter(nullptr);
    if (_ambientOcclusion) {
        const AmbientOcclusion occlusion{_scene, _settings.ambientOcclusionSamples};
        DeepEvent event;
        const float seen =
            occlusion.sample(ray, sampler, _aovs, target, _camera, counters.rays, event.depth);
        ++counters.paths;
        event.color = vec3(std::max(seen, 0.0f));
        event.alpha = seen < 0.0f ? 0.0f : 1.0f;
        if (film.deep()) film.deep()->add(x, y, &event, 1);
        film.addColor(x, y, vec3(std::max(seen, 0.0f)), seen < 0.0f ? 0.0f : 1.0f);
        return;
    }

    Path path(sampler);
    std::optional<DeepRay> deep;
    if (film.deep()) path.deep = &deep.emplace();
    path.shown = _aovs.empty() && !path.deep;
    path.origin = ray.origin;
    path.direction = ray.direction;
    path.near = ray.near;
    path.far = ray.far;
    path.time = ray.time;
    path.coneWidth = ray.coneWidth;
    path.coneSpread = ray.coneSpread;
    path.media = _cameraMedia;
    std::optional<LightPathRecord> lightPaths;
    if (!_lightPaths.empty()) path.lightPaths = &lightPaths.emplace(_lightPaths);
    trace(path, target, counters);
    ++counters.paths;
    addFeatures(path, target);
    const vec3 color = path.radiance * _camera.camera().exposureScale;
    if (lightPaths)
        _lightPaths.write(*lightPaths, target, _camera.camera().exposureScale,
                          !film.usable(color, path.alpha));
    if (deep)
        deep->write(*film.deep(), x, y, path.radiance, path.alpha, _camera.camera().exposureScale,
                    film.usable(color, path.alpha));
    film.addColor(x, y, color, path.alpha);
}

/// The denoiser's guides, of every sample, so that means fade at outlines as the colour does.
void Integrator::addFeatures(const Path& path, const AovTarget& target) const {
    if (!_guided) return;
    // Surfaces that only mirror, lamps and skies are their own texture.
    const vec3 albedo =
        path.featured ? path.featureAlbedo : glm::clamp(path.radiance, vec3(0.0f), vec3(1.0f));
    if (_denoisingAlbedo >= 0)
        target.film.addAov(_denoisingAlbedo, target.x, target.y, &albedo.x, 0.0f);
    if (_denoisingNormal >= 0)
        target.film.addAov(_denoisingNormal, target.x, target.y, &path.featureNormal.x, 0.0f);
}

} // namespace patina
