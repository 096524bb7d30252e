// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/measure/measuredSky.h"

#include "hdDelegate/film/sampler.h"
#include "base/maths.h"

#include <cmath>
#include <functional>

namespace patina::measure {

namespace {

using glm::vec3;
constexpr int densityWidth = 512; ///< RasterDomes::densityWidth

constexpr int w = MeasuredSky::width, h = MeasuredSky::height;

/// Of a texel.
float solidAngle(int y) {
    return (std::cos(float(y) / h * pi) - std::cos(float(y + 1) / h * pi)) * 2.0f * pi / w;
}

std::vector<vec3> onGrid(int width, const std::function<float(const vec3&)>& value) {
    std::vector<vec3> grid;
    for (int y = 0; y < width / 2; ++y)
        for (int x = 0; x < width; ++x)
            grid.emplace_back(value(SkyTexture::direction(x, y, width, width / 2)));
    return grid;
}

float meanOf(const std::vector<vec3>& grid) {
    double sum = 0.0;
    for (size_t i = 0; i < grid.size(); ++i)
        sum += double(grid[i].x * solidAngle(int(i) / w));
    return float(sum / (4.0 * pi));
}

std::shared_ptr<const ImageRGB> imageOf(std::vector<vec3> texels) {
    const float scale = 1.0f / meanOf(texels);
    for (vec3& t : texels)
        t *= scale;
    auto image = std::make_shared<ImageRGB>();
    image->width = w;
    image->height = h;
    image->pixels = std::move(texels);
    image->valid = true;
    return image;
}

} // namespace

MeasuredSky::MeasuredSky(const char* n, std::shared_ptr<const ImageRGB> sky)
    : name(n), map(sky, EnvironmentFormat::Latlong), image(w, h, sky->pixels),
      density(densityWidth, densityWidth / 2,
              onGrid(densityWidth, [&](const vec3& d) { return map.pdf(d); })) {
    const auto light = [&](const vec3& d) { return map.radiance(d); };
    harmonics = makeSkyHarmonics(light);
    bare = makeSkyHarmonics(light, false, false);
    const PrefilteredSky filtered(light);
    for (int i = 0; i < PrefilteredSky::levels; ++i)
        prefiltered.emplace_back(
            PrefilteredSky::width, PrefilteredSky::height,
            std::vector<vec3>(filtered.level(i).begin(), filtered.level(i).end()));
    for (int y = 0; y < h; ++y)
        for (int x = 0; x < w; ++x)
            texels.push_back({SkyTexture::direction(x, y, w, h),
                              sky->pixels[size_t(y) * w + size_t(x)].x * solidAngle(y)});
    for (uint32_t i = 0; i < 4096; ++i) {
        Drawn d;
        d.direction = map.sample(Sampler(0, 0, 0, i).next2(), d.density);
        d.radiance = radiance(d.direction);
        if (d.density > 0.0f) drawn.push_back(d);
    }
}

float MeasuredSky::densityAt(const vec3& d, float lod) const {
    const float finer = 0.5f * std::log2(2.0f * w * h) - std::log2(float(densityWidth));
    return density.at(d, std::max(lod - finer, 0.0f)).x;
}

MeasuredSky MeasuredSky::constant() {
    return MeasuredSky("constant", imageOf(std::vector<vec3>(size_t(w) * h, vec3(1.0f))));
}

MeasuredSky MeasuredSky::soft() {
    const vec3 towards = glm::normalize(vec3(1.0f, 1.0f, 0.5f));
    return MeasuredSky("soft", imageOf(onGrid(w, [&](const vec3& d) {
                           const float glow = std::max(0.0f, glm::dot(d, towards));
                           return 0.3f + 0.5f * std::max(d.y, 0.0f) + 2.0f * std::pow(glow, 8.0f);
                       })));
}

MeasuredSky MeasuredSky::sun() {
    std::vector<vec3> sky = onGrid(w, [](const vec3& d) {
        return d.y > 0.0f ? 0.5f + 0.5f * d.y : 0.5f * std::max(0.2f, 1.0f + 4.0f * d.y);
    });
    const vec3 towards = glm::normalize(vec3(0.5f, 0.6f, -0.4f));
    const std::vector<vec3> disk = onGrid(w, [&](const vec3& d) {
        const float angle = std::acos(std::min(glm::dot(d, towards), 1.0f));
        return std::max(0.0f, 1.0f - angle * angle / (0.035f * 0.035f));
    });
    const float share = 5.0f * meanOf(sky) / meanOf(disk);
    for (size_t i = 0; i < sky.size(); ++i)
        sky[i] += share * disk[i];
    return MeasuredSky("sun", imageOf(std::move(sky)));
}

} // namespace patina::measure
