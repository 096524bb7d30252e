// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/shadows/rasterSky.h"

#include "hdDelegate/film/sampler.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

constexpr int cells = RasterSky::side * RasterSky::side;

/// The inverse of octahedral() in shadows.glsl.
glm::vec3 fromOctahedral(glm::vec2 u) {
    const glm::vec2 p = u * 2.0f - 1.0f;
    glm::vec3 v(p, 1.0f - std::fabs(p.x) - std::fabs(p.y));
    if (v.z < 0.0f) {
        const float x = v.x;
        v.x = std::copysign(1.0f - std::fabs(v.y), v.x);
        v.y = std::copysign(1.0f - std::fabs(x), v.y);
    }
    return glm::normalize(v);
}

} // namespace

const GlTexture& RasterSky::maps() {
    const int layers = _fibres ? 2 * cells : cells;
    if (layers > _layers) {
        _maps = GlTexture(GL_TEXTURE_2D_ARRAY, GL_DEPTH_COMPONENT16, mapSize, mapSize, layers);
        _layers = layers;
        _maps.filter(GL_NEAREST);
    }
    return _maps;
}

std::vector<RasterSky::Task> RasterSky::begin(uint32_t pass, uint32_t seed,
                                              const ShadowBounds& bounds, int maximum) {
    const bool first = _drawn.empty();
    if (first) {
        _drawn.assign(cells, SkyRows());
        _fibres = bounds.hasFibres();
    }
    const bool missing =
        std::any_of(_drawn.begin(), _drawn.end(), [](const SkyRows& c) { return c.layer < 0; });
    std::vector<Task> out;
    // The first image lives by them: see PreviewSampler::sampleFirst().
    const int wanted = pass == 0 ? 2 * maximum : missing ? maximum : std::min(maximum, 2);
    const int count = std::clamp(wanted, 1, cells);
    for (int n = 0; n < count; ++n) {
        // Steps of 89, prime to the number of cells, spread those of a pass over the sphere.
        const uint32_t turn = missing ? pass * uint32_t(count) + uint32_t(n)
                                      : pass * uint32_t(count) + uint32_t(n) + 1;
        int at = int(turn % uint32_t(cells)) * 89 % cells;
        if (missing)
            for (int k = 0; k < cells && _drawn[size_t(at)].layer >= 0; ++k)
                at = (at + 89) % cells;
        SkyRows& cell = _drawn[size_t(at)];
        Sampler numbers(uint32_t(at), 2, seed, pass / uint32_t(cells / 2));
        const glm::vec2 in = numbers.next2();
        const glm::vec3 direction =
            fromOctahedral((glm::vec2(float(at % side), float(at / side)) + in) / float(side));
        const glm::vec2 turned = numbers.next2();
        const auto take = [&](const ShadowBounds& onto, int layer, int& map) {
            out.push_back({layer, distantShadow(direction, turned, onto, mapSize)});
            map = layer;
            return out.back().view.worldToMap;
        };
        cell.towards = direction;
        cell.worldToMap = take(bounds, at, cell.layer);
        if (_fibres) cell.worldToFibres = take(bounds.ofFibres(), cells + at, cell.fibreLayer);
        if (missing && std::none_of(_drawn.begin(), _drawn.end(),
                                    [](const SkyRows& c) { return c.layer < 0; }))
            break;
    }
    return out;
}

void RasterSky::bind(GLuint buffer, GLuint texture) {
    std::vector<SkyRows> all = _drawn;
    for (int i = 0; i < int(all.size()); ++i) {
        if (all[size_t(i)].layer >= 0) continue;
        const glm::vec3 middle =
            fromOctahedral((glm::vec2(float(i % side), float(i / side)) + 0.5f) / float(side));
        const auto nearest =
            std::max_element(_drawn.begin(), _drawn.end(), [&](const SkyRows& a, const SkyRows& b) {
                const float da = a.layer < 0 ? -2.0f : glm::dot(a.towards, middle);
                const float db = b.layer < 0 ? -2.0f : glm::dot(b.towards, middle);
                return da < db;
            });
        all[size_t(i)] = *nearest;
    }
    _buffer = GlBuffer(all);
    _buffer.bindStorage(buffer);
    maps().bind(texture);
}

} // namespace patina
