// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/samples/lightCells.h"

#include "hdDelegate/film/sampler.h"
#include "hdDelegate/parallel.h"
#include "hdDelegate/raster/samples/lightChoice.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace patina {

namespace {

/// An entry of a list. The number takes the place of the last bits of the float, which is rounded.
uint32_t entry(float share, size_t number) {
    uint32_t bits;
    std::memcpy(&bits, &share, sizeof bits);
    return ((bits + 0x80u) & 0xffffff00u) | uint32_t(number);
}

/// Of nearly cubical cells, as many as may be.
ivec3 sidesOf(const vec3& size) {
    float least = std::max({size.x, size.y, size.z, 1e-20f}) / float(LightCells::maxCells);
    float most = std::max({size.x, size.y, size.z, 1e-20f});
    const auto with = [&](float side) {
        return glm::max(ivec3(1), ivec3(glm::floor(size / side)));
    };
    for (int i = 0; i < 40; ++i) {
        const float middle = std::sqrt(least * most);
        const ivec3 n = with(middle);
        (double(n.x) * n.y * n.z > LightCells::maxCells ? least : most) = middle;
    }
    return with(most);
}

} // namespace

LightCells::LightCells(const std::vector<LightEstimate>& estimates, size_t first, vec3 from,
                       vec3 to, uint32_t seed, uint32_t pass) {
    const vec3 size = to - from;
    if (std::isfinite(size.x + size.y + size.z) && glm::all(glm::greaterThanEqual(size, vec3(0)))) {
        low = from;
        sides = sidesOf(size);
        perUnit = vec3(sides) / glm::max(size, vec3(1e-20f));
    }
    const vec3 cell = size / vec3(sides);
    const float ball = 0.5f * glm::length(cell);
    const size_t cells = size_t(sides.x) * size_t(sides.y) * size_t(sides.z);
    lists.assign(cells * listed, 0);
    parallelFor(size_t(0), cells, [&](size_t c) {
        const ivec3 at(int(c) % sides.x, int(c) / sides.x % sides.y, int(c) / (sides.x * sides.y));
        const vec3 center = low + (vec3(at) + 0.5f) * cell;
        std::vector<float> weights;
        double sum = 0.0;
        int lit = 0;
        for (size_t i = first; i < estimates.size(); ++i) {
            weights.push_back(estimates[i].towards(center, ball));
            sum += double(weights.back());
            lit += estimates[i].power > 0.0f ? 1 : 0;
        }
        for (size_t i = 0; i < weights.size(); ++i)
            if (estimates[first + i].power > 0.0f)
                weights[i] = even / float(lit) +
                             (sum > 0.0 ? (1.0f - even) * float(double(weights[i]) / sum) : 0.0f);
            else
                weights[i] = 0.0f;
        const float u = Sampler(uint32_t(c), 3, seed, pass).next2().x;
        size_t k = c * listed;
        for (const ChosenLight& chosen : chooseLights(weights, listed, u))
            lists[k++] = entry(chosen.share, first + chosen.index);
    });
}

const LightCells& RasterManyLights::bind(const std::vector<LightEstimate>& estimates, size_t first,
                                         vec3 low, vec3 high, uint32_t seed, uint32_t pass,
                                         size_t lights) {
    const bool same =
        _lists && first == _first && low == _low && high == _high && seed == _seed &&
        pass == _pass && estimates.size() == _of.size() &&
        std::memcmp(estimates.data(), _of.data(), estimates.size() * sizeof(LightEstimate)) == 0;
    if (!same) {
        _of = estimates;
        _first = first;
        _low = low;
        _high = high;
        _seed = seed;
        _pass = pass;
        _cells =
            estimates.empty() ? LightCells() : LightCells(estimates, first, low, high, seed, pass);
        upload(lights);
    }
    _estimates.bindUniform(5);
    _lists.bind(26);
    return _cells;
}

void RasterManyLights::upload(size_t lights) {
    std::vector<LightEstimate> all = _of;
    all.resize(lights);
    if (_estimates.size() != all.size() * sizeof(LightEstimate))
        _estimates = GlBuffer(all);
    else
        _estimates.write(all.data(), all.size() * sizeof(LightEstimate));
    constexpr int width = LightCells::aRow * LightCells::listed;
    if (!_lists) {
        _lists = GlTexture(GL_TEXTURE_2D, GL_R32UI, width, LightCells::rows);
        _lists.filter(GL_NEAREST);
    }
    std::vector<uint32_t> texels = _cells.lists;
    const size_t rows = (texels.size() + width - 1) / width;
    texels.resize(rows * width);
    if (rows > 0)
        gl.TextureSubImage2D(_lists.id(), 0, 0, 0, width, GLsizei(rows), GL_RED_INTEGER,
                             GL_UNSIGNED_INT, texels.data());
}

} // namespace patina
