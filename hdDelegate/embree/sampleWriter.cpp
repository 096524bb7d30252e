// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/sampleWriter.h"

#include "hdDelegate/embree/deepRay.h"

#include <algorithm>
#include <utility>

namespace patina {

/// Without the quarters of pixels, which come last and which no surface shows.
static std::vector<AovSpec> shown(std::vector<AovSpec> aovs) {
    while (!aovs.empty() && isOfQuarters(aovs.back().id))
        aovs.pop_back();
    return aovs;
}

SampleWriter::SampleWriter(const std::vector<AovSpec>& aovs, const CameraRays& camera,
                           float filterRadius)
    : _aovs(shown(aovs)), _camera(camera), _lightPaths(aovs), _filterRadius(filterRadius) {
    for (size_t i = 0; i < aovs.size(); ++i) {
        const auto remember = [&](AovId id, int& place) {
            if (aovs[i].id == id) place = int(i);
        };
        remember(AovId::denoisingAlbedo, _all.albedo);
        remember(AovId::denoisingNormal, _all.normal);
        remember(AovId::denoisingHalfColor, _half.color);
        remember(AovId::denoisingHalfAlbedo, _half.albedo);
        remember(AovId::denoisingHalfNormal, _half.normal);
        remember(AovId::quarterColors, _quarterColors);
        remember(AovId::quarterShares, _quarterShares);
    }
}

Sampler SampleWriter::sampler(int x, int y, uint32_t seed, uint32_t index) const {
    const auto numbers = [&](uint32_t number, uint32_t i) {
        return Sampler(uint32_t(x), uint32_t(y), number, i);
    };
    if (_half.color < 0) return numbers(seed, index);
    return numbers(index % 2 ? Sampler::hash(~seed) : seed, index / 2);
}

void SampleWriter::Denoising::add(Film& film, int x, int y, const vec3& c, const vec3& a,
                                  const vec3& n) const {
    if (color >= 0) film.addAov(color, x, y, &c.x, 0.0f);
    if (albedo >= 0) film.addAov(albedo, x, y, &a.x, 0.0f);
    if (normal >= 0) film.addAov(normal, x, y, &n.x, 0.0f);
}

void SampleWriter::show(Path& path, const SurfacePoint& point, const Bsdf& bsdf,
                        const AovTarget& target) const {
    if (!std::exchange(path.shown, true)) {
        writeAovs(_aovs, target, _camera, point, bsdf);
        if (path.deep) path.deep->end(_camera.depthAt(point.shading.position));
    }
    const bool guided = _all.albedo >= 0 || _all.normal >= 0;
    if (path.featured || !guided || !bsdf.hasNonDelta()) return;
    path.featured = true;
    // Behind what splats show. Many samples for one guide would cost more than the path.
    path.featureAlbedo +=
        path.throughput * (bsdf.stochastic() ? bsdf.likelyAlbedo() : bsdf.albedo());
    path.featureNormal = point.shading.normal;
}

void SampleWriter::add(const vec3& color, float alpha, const vec3& albedo, const vec3& normal,
                       const AovTarget& target) const {
    Film& film = target.film;
    _all.add(film, target.x, target.y, color, albedo, normal);
    if (film.nextSample(target.x, target.y) % 2 == 0) // one that is dropped counts as black there
        _half.add(film, target.x, target.y, film.usable(color, alpha) ? color : vec3(0.0f), albedo,
                  normal);
    if (splats())
        film.addQuarter(_quarterColors, _quarterShares, target.x, target.y, target.quarter, color,
                        alpha, _filterRadius);
    film.addColor(target.x, target.y, color, alpha);
}

void SampleWriter::write(const Path& path, const AovTarget& target, const vec3& origin) const {
    if (path.screen >= 0)
        writeScreenAovs(_aovs, target, _camera, path.screenPosition, origin, path.screen);
    Film& film = target.film;
    const float scale = _camera.camera().exposureScale;
    const vec3 color = path.radiance * scale;
    const bool usable = film.usable(color, path.alpha);
    if (path.lightPaths) _lightPaths.write(*path.lightPaths, target, scale, !usable);
    if (path.deep)
        path.deep->write(*film.deep(), target.x, target.y, path.radiance, path.alpha, scale,
                         usable);
    // Surfaces that only mirror, lamps and skies are their own texture.
    add(color, path.alpha,
        path.featured ? path.featureAlbedo : glm::clamp(path.radiance, vec3(0.0f), vec3(1.0f)),
        path.featureNormal, target);
}

/// Darkness counts in the means of light's parts as it does in the colour's.
void SampleWriter::writeDark(const AovTarget& target) const {
    if (!_lightPaths.empty()) _lightPaths.write(LightPathRecord(_lightPaths), target, 1.0f, false);
    if (target.film.deep()) target.film.deep()->add(target.x, target.y, nullptr, 0);
    add(vec3(0.0f), 0.0f, vec3(0.0f), vec3(0.0f), target);
}

void SampleWriter::writeGrey(float seen, float depth, const AovTarget& target) const {
    DeepEvent event;
    event.depth = depth;
    event.color = vec3(std::max(seen, 0.0f));
    event.alpha = seen < 0.0f ? 0.0f : 1.0f;
    if (target.film.deep()) target.film.deep()->add(target.x, target.y, &event, 1);
    add(event.color, event.alpha, vec3(0.0f), vec3(0.0f), target);
}

} // namespace patina
