// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/lights/rasterDomes.h"

#include "hdDelegate/raster/lights/prefilteredSky.h"
#include "base/maths.h"
#include "shaders/lights.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

using glm::vec3;
using glm::vec4;

vec3 latlongDirection(int x, int y, int w, int h) {
    return shLights::domeDirection(
        glm::vec2((float(x) + 0.5f) / float(w), (float(y) + 0.5f) / float(h)));
}

void smoothLatlong(const GlTexture& texture, GLint smaller) {
    texture.parameter(GL_TEXTURE_MIN_FILTER, smaller);
    texture.parameter(GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    texture.parameter(GL_TEXTURE_WRAP_S, GL_REPEAT);
    texture.parameter(GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

/// Writes a layer with all its levels, whose sides are powers of two. Not by
/// glGenerateTextureMipmap, which draws: see HeldFences.
/// @param texels of the first level; overwritten
template <class Texel>
void writeLevels(std::vector<Texel>& texels, const GlTexture& to, int layer, GLenum format) {
    int w = to.width(), h = to.height();
    for (int level = 0; level < to.levels(); ++level) {
        gl.TextureSubImage3D(to.id(), level, 0, 0, layer, w, h, 1, format, GL_FLOAT, texels.data());
        const int right = w > 1, down = h > 1 ? w : 0, step = right + 1;
        const int nextW = std::max(1, w / 2), nextH = std::max(1, h / 2);
        for (int y = 0; y < nextH; ++y)
            for (int x = 0; x < nextW; ++x) {
                const Texel* at = &texels[size_t(y) * size_t(down + w) + size_t(x * step)];
                texels[size_t(y) * size_t(nextW) + size_t(x)] =
                    0.25f * ((at[0] + at[right]) + (at[down] + at[down + right]));
            }
        w = nextW, h = nextH;
    }
}

} // namespace

int RasterDomes::layer(const std::shared_ptr<const EnvironmentMap>& map) {
    for (size_t i = 0; i < _wanted.size(); ++i)
        if (_wanted[i] == map) return int(i);
    if (_wanted.size() >= size_t(maxImages)) return -1;
    _wanted.push_back(map);
    return int(_wanted.size()) - 1;
}

const SkyHarmonics& RasterDomes::harmonics(const std::shared_ptr<const EnvironmentMap>& map) {
    const auto found = _harmonics.find(map);
    if (found != _harmonics.end()) return found->second;
    return _harmonics
        .emplace(map, makeSkyHarmonics([&](const vec3& d) { return map->radiance(d); }))
        .first->second;
}

void RasterDomes::upload(bool prefiltered) {
    if (prefiltered && _filtered != _wanted) uploadPrefiltered();
    for (auto it = _harmonics.begin(); it != _harmonics.end();)
        it = std::find(_wanted.begin(), _wanted.end(), it->first) == _wanted.end()
                 ? _harmonics.erase(it)
                 : std::next(it);
    if (_uploaded == _wanted) return;
    _uploaded = _wanted;
    _maps = GlTexture();
    _densities = GlTexture();
    if (_wanted.empty()) return;
    int w = 1;
    bool same = true; // texels are the image's pixels, so that interpolating twice blurs no kinks
    for (const auto& map : _wanted)
        w = std::max(w, map->width());
    for (const auto& map : _wanted)
        same &= map->width() == w && 2 * map->height() == w;
    if (!same || (w & (w - 1)) != 0 || w > 2048) {
        const int widest = w;
        for (w = 1024; w < 4 * widest && w < 2048;)
            w *= 2;
    }
    while (size_t(w) * size_t(w / 2) * _wanted.size() > maxTexels && w > 2 * densityWidth)
        w /= 2;
    const int h = w / 2, dw = densityWidth, dh = dw / 2, layers = int(_wanted.size());
    _maps = GlTexture(GL_TEXTURE_2D_ARRAY, GL_RGBA32F, w, h, layers, 0);
    _densities = GlTexture(GL_TEXTURE_2D_ARRAY, GL_R32F, dw, dh, layers, 0);
    std::vector<vec4> image(size_t(w) * size_t(h));
    std::vector<float> density(size_t(dw) * size_t(dh));
    for (int k = 0; k < layers; ++k) {
        const EnvironmentMap& map = *_wanted[size_t(k)];
        for (int y = 0; y < h; ++y)
            for (int x = 0; x < w; ++x)
                image[size_t(y) * size_t(w) + size_t(x)] =
                    vec4(map.radiance(latlongDirection(x, y, w, h)), 1.0f);
        for (int y = 0; y < dh; ++y)
            for (int x = 0; x < dw; ++x)
                density[size_t(y) * size_t(dw) + size_t(x)] =
                    map.pdf(latlongDirection(x, y, dw, dh));
        writeLevels(image, _maps, k, GL_RGBA);
        writeLevels(density, _densities, k, GL_RED);
    }
    smoothLatlong(_maps, GL_LINEAR_MIPMAP_LINEAR);
    smoothLatlong(_densities, GL_LINEAR_MIPMAP_LINEAR);
    _densities.parameter(GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

void RasterDomes::uploadPrefiltered() {
    _filtered = _wanted;
    _prefiltered = GlTexture();
    if (_wanted.empty()) return;
    const int w = PrefilteredSky::width, h = PrefilteredSky::height;
    _prefiltered = GlTexture(GL_TEXTURE_2D_ARRAY, GL_RGBA32F, w, h,
                             int(_wanted.size()) * PrefilteredSky::levels);
    for (size_t k = 0; k < _wanted.size(); ++k) {
        const PrefilteredSky sky([&](const vec3& d) { return _wanted[k]->radiance(d); });
        for (int i = 0; i < PrefilteredSky::levels; ++i)
            gl.TextureSubImage3D(_prefiltered.id(), 0, 0, 0, int(k) * PrefilteredSky::levels + i, w,
                                 h, 1, GL_RGBA, GL_FLOAT, sky.level(i).data());
    }
    smoothLatlong(_prefiltered, GL_LINEAR);
}

} // namespace patina
