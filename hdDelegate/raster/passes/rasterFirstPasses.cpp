// SPDX-License-Identifier: Apache-2.0
// The passes of first looks, see RasterLook.

#include "hdDelegate/raster/passes/rasterPasses.h"

#include "hdDelegate/parallel.h"

#include <algorithm>
#include <cmath>

namespace patina {

/// Brings the film's share of what smoothing does to that of one pass more.
/// @param look whether the pass is one of those that are smoothed
/// @param pixels what smoothing does to it; overwritten
void RasterPasses::smooth(const RasterSample& sample, bool look, std::vector<vec4>& pixels,
                          Film& film) {
    if (sample.pass == 0) _smoothing.assign(size_t(_width) * size_t(_height), vec4(0.0f));
    if (sample.pass >= RasterLook::smoothed || _smoothing.empty()) return;
    const std::vector<vec4> before = _smoothing;
    if (look) {
        takeSplats(pixels, _width, _height, sample, _window, [&](int x, int y, const vec4& value) {
            if (std::isfinite(value.x + value.y + value.z))
                _smoothing[size_t(y) * size_t(_width) + size_t(x)] += value;
        });
    }
    const float was = RasterLook::share(sample.pass), is = RasterLook::share(sample.pass + 1);
    parallelFor(_window[1], std::max(_window[1], _window[3] + 1), [&](int y) {
        for (int x = _window[0]; x <= _window[2]; ++x) {
            const size_t at = size_t(y) * size_t(_width) + size_t(x);
            const vec3 change = vec3(_smoothing[at]) * is - vec3(before[at]) * was;
            if (change == vec3(0.0f) || film.sampleCount(x, y) == 0) continue;
            const vec3 mean = film.color(x, y) + change / float(film.sampleCount(x, y));
            const float least = film.allowsNegative() ? -INFINITY : 0.0f;
            film.setMean(x, y, glm::max(mean, vec3(least)), film.alpha(x, y));
        }
    });
}

/// Shows an image until the mean of the later passes is better.
/// @param pixels overwritten
void RasterPasses::beginFirst(std::vector<vec4>& pixels, const RasterSample& sample, Film& film) {
    _first.assign(size_t(_width) * size_t(_height), vec4(0.0f));
    _sums.assign(_first.size(), vec4(0.0f));
    takeSplats(pixels, _width, _height, sample, _window, [&](int x, int y, const vec4& value) {
        _first[size_t(y) * size_t(_width) + size_t(x)] = value;
        film.addColor(x, y, vec3(value), value.w);
    });
}

/// Mixes that image with the mean of the passes after it, by less from pass to pass.
/// @param pixels of the pass; overwritten
void RasterPasses::showFirst(std::vector<vec4>& pixels, const RasterSample& sample, Film& film) {
    const uint32_t passes = sample.pass + 1;
    const float share = RasterLook::shareOfFirst(passes);
    takeSplats(pixels, _width, _height, sample, _window, [&](int x, int y, const vec4& value) {
        const size_t at = size_t(y) * size_t(_width) + size_t(x);
        film.addColor(x, y, vec3(value), value.w);
        _sums[at] += value;
        const vec4 mean = _sums[at] / float(passes - 1);
        if (!std::isfinite(mean.x + mean.y + mean.z) || film.sampleCount(x, y) == 0) return;
        film.setMean(x, y, glm::mix(vec3(mean), vec3(_first[at]), share), mean.w);
    });
    if (passes == RasterLook::smoothed) _first.clear();
}

} // namespace patina
