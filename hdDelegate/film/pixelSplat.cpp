// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/film/pixelSplat.h"

#include "hdDelegate/film/pixelFilter.h"
#include "hdDelegate/parallel.h"

#include <algorithm>
#include <string>

namespace patina {

namespace {

const std::string colorsAov = "quarterColors", sharesAov = "quarterShares";
constexpr size_t sharesOf = PixelSplat::Sample::shareCount;

} // namespace

PixelSplat::Sample::Sample(int quarter, const glm::vec3& color, float alpha, float radius) {
    for (int c = 0; c < 3; ++c)
        colors[size_t(3 * quarter + c)] = color[c];
    shares[size_t(quarter)] = alpha;
    shares[size_t(quarters + quarter)] = 1.0f;
    shares[2 * quarters] = radius;
}

PixelSplat::Noise::Noise(float radius) {
    const std::vector<float> halves = PixelFilter(radius).halfPixelWeights();
    const int side = int(halves.size() / 2), reach = side / 2; // the outermost half may be alone
    double fine = 0.0, coarse = 0.0;
    const auto half = [&](int i) {
        return i < -side || i >= side ? 0.0 : double(halves[size_t(i + side)]);
    };
    for (int k = -reach; k <= reach; ++k) {
        weights.push_back(half(2 * k - 1) + half(2 * k));
        fine += 2.0 * (half(2 * k - 1) * half(2 * k - 1) + half(2 * k) * half(2 * k));
        coarse += weights.back() * weights.back();
    }
    // Along both axes: the root of a square.
    finer = fine / coarse;
    together = 1.0 / (fine * fine);
}

PixelSplat::PixelSplat(const Film& film)
    : _film(film), _width(size_t(film.width())), _height(size_t(film.height())),
      _shares(film.resolve(sharesAov)) {
    float radius = 0.0f;
    for (size_t i = sharesOf - 1; i < _shares.size(); i += sharesOf)
        radius = std::max(radius, _shares[i]);
    // A file of others may hold any.
    _weights = PixelFilter(std::min(radius, float(PixelFilter::largestReach))).halfPixelWeights();
}

/// @param values parts of all samples, of each quarter of each pixel
template <size_t n>
std::vector<float> PixelSplat::filtered(const std::vector<float>& values) const {
    const size_t columns = 2 * _width;
    const int side = int(_weights.size() / 2);
    // Along rows of half pixels: sums of the values, then of the weights.
    std::vector<float> rows(2 * _height * _width * (n + 1));
    parallelFor(size_t(0), 2 * _height, [&](size_t v) {
        std::vector<float> line(columns * (n + 1));
        for (size_t u = 0; u < columns; ++u) {
            const size_t pixel = v / 2 * _width + u / 2, quarter = u % 2 + v % 2 * 2;
            const float share = _shares[pixel * sharesOf + quarters + quarter];
            if (!(share > 0.0f)) continue;
            for (size_t c = 0; c < n; ++c)
                line[u * (n + 1) + c] = values[(pixel * quarters + quarter) * n + c] / share;
            line[u * (n + 1) + n] = 1.0f;
        }
        for (size_t x = 0; x < _width; ++x)
            for (int i = -side; i < side; ++i) {
                const int u = int(2 * x + 1) + i;
                if (u < 0 || u >= int(columns)) continue;
                for (size_t c = 0; c <= n; ++c)
                    rows[(v * _width + x) * (n + 1) + c] +=
                        _weights[size_t(i + side)] * line[size_t(u) * (n + 1) + c];
            }
    });
    std::vector<float> out(_width * _height * n);
    parallelFor(size_t(0), _height, [&](size_t y) {
        for (size_t x = 0; x < _width; ++x) {
            const float* own = &_shares[(y * _width + x) * sharesOf + quarters];
            if (!(own[0] + own[1] + own[2] + own[3] > 0.0f)) continue; // beyond a crop, say
            std::array<float, n + 1> sums{};
            for (int i = -side; i < side; ++i) {
                const int v = int(2 * y + 1) + i;
                if (v < 0 || v >= int(2 * _height)) continue;
                for (size_t c = 0; c <= n; ++c)
                    sums[c] +=
                        _weights[size_t(i + side)] * rows[(size_t(v) * _width + x) * (n + 1) + c];
            }
            for (size_t c = 0; c < n && sums[n] > 0.0f; ++c)
                out[(y * _width + x) * n + c] = sums[c] / sums[n];
        }
    });
    return out;
}

std::vector<float> PixelSplat::color(const std::vector<float>& own) const {
    std::vector<float> colors = _film.resolve(colorsAov);
    if (own.empty()) return filtered<3>(colors);
    parallelFor(size_t(0), _width * _height, [&](size_t i) {
        const int x = int(i % _width), y = int(i / _width);
        if (!_film.sampleCount(x, y)) return;
        const glm::vec3 mean = _film.color(x, y);
        for (size_t c = 0; c < 3; ++c) {
            const auto part = [&](size_t q) -> float& {
                return colors[(i * quarters + q) * 3 + c];
            };
            const double wanted = own[i * 3 + c], there = mean[int(c)];
            bool scales = there > 0.0; // but not what cancels out, by lights that take light away
            for (size_t q = 0; q < quarters; ++q)
                scales = scales && part(q) >= 0.0f;
            for (size_t q = 0; q < quarters; ++q)
                part(q) = float(scales ? double(part(q)) * wanted / there
                                       : double(part(q)) +
                                             (wanted - there) *
                                                 double(_shares[i * sharesOf + quarters + q]));
        }
    });
    return filtered<3>(colors);
}

std::vector<float> PixelSplat::alpha() const {
    std::vector<float> parts(_width * _height * quarters);
    for (size_t i = 0; i < parts.size(); ++i)
        parts[i] = _shares[i / quarters * sharesOf + i % quarters];
    return filtered<1>(parts);
}

} // namespace patina
