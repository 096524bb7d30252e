// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/film/outliers.h"

#include "hdDelegate/parallel.h"
#include "base/maths.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace patina {

namespace {

constexpr float brighter = 1.3f;       // than the second brightest neighbour
constexpr float neighbourNoise = 3.0f; // standard errors of the neighbours, which chance explains
constexpr float ownNoise = 4.0f;       // and of the pixel itself
constexpr float share = 0.05f;         // of the light around that a pixel may get in addition
constexpr int passes = 2; // of two outliers side by side the second shows when the first is gone
constexpr float smallest = 2.0f; // radius of the area, in pixels
constexpr int finest = 32;       // largest radius in steps of nodes

float luminanceOf(const float* c) {
    return 0.2126f * c[0] + 0.7152f * c[1] + 0.0722f * c[2];
}

/// Falls smoothly to 0 at the radius, so that the area has no edge (the biweight of Beaton and
/// Tukey 1974).
float falloff(int x, int y, float radius) {
    const float rest = std::max(1.0f - float(x * x + y * y) / (radius * radius), 0.0f);
    return rest * rest;
}

/// Light that goes to the pixels of areas, on nodes some pixels apart between which it is linear:
/// so the time of an area does not depend on its size. The sum over the pixels is exact.
class Spread {
public:
    /// @param weights of the pixels, in proportion to which they get light
    Spread(const std::vector<float>& weights, int width, int height, int step)
        : _width(width), _height(height), _step(step), _columns((width - 1) / step + 2),
          _rows((height - 1) / step + 2), _weights(size_t(_columns) * size_t(_rows)),
          _light(3 * _weights.size()) {
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                corners(x, y, [&](size_t node, float part) {
                    _weights[node] += part * weights[size_t(y) * size_t(width) + size_t(x)];
                });
    }

    /// @param light three floats
    /// @returns false where no pixel of the area has a weight
    bool add(int x, int y, float radius, const float* light) {
        const int reach = int(radius);
        const int left = std::max(x - reach, 0) / _step, top = std::max(y - reach, 0) / _step;
        const int right = std::min((x + reach) / _step, _columns - 1);
        const int bottom = std::min((y + reach) / _step, _rows - 1);
        const auto each = [&](const auto& visit) {
            for (int j = top; j <= bottom; ++j)
                for (int i = left; i <= right; ++i)
                    visit(size_t(j) * size_t(_columns) + size_t(i),
                          falloff(i * _step - x, j * _step - y, radius));
        };
        double sum = 0.0;
        each([&](size_t node, float part) { sum += double(part) * _weights[node]; });
        if (!(sum > 0.0)) return false;
        each([&](size_t node, float part) {
            for (size_t c = 0; c < 3; ++c)
                _light[3 * node + c] += float(double(light[c]) * part / sum);
        });
        return true;
    }

    void show(const std::vector<float>& weights, std::vector<float>& color) const {
        parallelFor(0, _height, [&](int y) {
            for (int x = 0; x < _width; ++x) {
                const size_t pixel = size_t(y) * size_t(_width) + size_t(x);
                corners(x, y, [&](size_t node, float part) {
                    for (size_t c = 0; c < 3; ++c)
                        color[3 * pixel + c] += weights[pixel] * part * _light[3 * node + c];
                });
            }
        });
    }

private:
    /// The four nodes around a pixel, with their parts of it.
    template <class Visit> void corners(int x, int y, const Visit& visit) const {
        const float u = float(x % _step) / float(_step), v = float(y % _step) / float(_step);
        const size_t node = size_t(y / _step) * size_t(_columns) + size_t(x / _step);
        visit(node, (1.0f - u) * (1.0f - v));
        visit(node + 1, u * (1.0f - v));
        visit(node + size_t(_columns), (1.0f - u) * v);
        visit(node + size_t(_columns) + 1, u * v);
    }

    int _width, _height, _step, _columns, _rows;
    std::vector<float> _weights, _light;
};

struct Neighbours {
    int count = 0;
    float second = -std::numeric_limits<float>::max(); ///< luminance of the second brightest
    float mean[3] = {0, 0, 0};                         ///< colour of all but the brightest
    float variance = 0.0f; ///< of the mean luminance of one of these, on average
};

class Picture {
public:
    Picture(const Film& film, const std::vector<float>& color, const std::vector<char>& removed)
        : _film(film), _color(color), _removed(removed), _width(film.width()),
          _height(film.height()) {}

    float luminance(int x, int y) const { return luminanceOf(at(x, y)); }
    const float* at(int x, int y) const {
        return &_color[(size_t(y) * size_t(_width) + size_t(x)) * 3];
    }

    Neighbours around(int x, int y) const {
        struct One {
            int x, y;
            float luminance;
        };
        Neighbours result;
        int noisy = 0;
        const auto add = [&](const One& one) {
            result.second = std::max(result.second, one.luminance);
            for (int c = 0; c < 3; ++c)
                result.mean[c] += at(one.x, one.y)[c];
            if (isRemoved(one.x, one.y)) return;
            result.variance += _film.varianceOfMean(one.x, one.y);
            ++noisy;
        };
        One brightest{};
        for (int v = std::max(y - 1, 0); v <= std::min(y + 1, _height - 1); ++v)
            for (int u = std::max(x - 1, 0); u <= std::min(x + 1, _width - 1); ++u) {
                if ((u == x && v == y) || !_film.sampleCount(u, v)) continue;
                One one{u, v, luminance(u, v)};
                if (result.count++ == 0 || one.luminance > brightest.luminance)
                    std::swap(one, brightest);
                if (result.count > 1) add(one);
            }
        for (float& value : result.mean)
            value /= float(std::max(result.count - 1, 1));
        result.variance /= float(std::max(noisy, 1));
        return result;
    }

    bool isOutlier(int x, int y, const Neighbours& around) const {
        if (around.count < 3 || _film.sampleCount(x, y) < 2 || isRemoved(x, y)) return false;
        const float own = luminance(x, y), excess = own - luminanceOf(around.mean);
        return own > brighter * around.second &&
               excess > neighbourNoise * std::sqrt(around.variance) &&
               excess < ownNoise * std::sqrt(_film.varianceOfMean(x, y));
    }

private:
    bool isRemoved(int x, int y) const { return _removed[size_t(y) * size_t(_width) + size_t(x)]; }

    const Film& _film;
    const std::vector<float>& _color;
    const std::vector<char>& _removed;
    int _width, _height;
};

} // namespace

int spreadOutliers(const Film& film, std::vector<float>& color) {
    struct Outlier {
        int x, y;
        float mean[3], excess[3];
    };
    const int width = film.width(), height = film.height();
    std::vector<char> removed(size_t(width) * size_t(height), 0);
    const auto pixel = [&](int x, int y) {
        return &color[(size_t(y) * size_t(width) + size_t(x)) * 3];
    };
    std::vector<Outlier> outliers;
    for (int pass = 0; pass < passes; ++pass) {
        std::vector<std::vector<Outlier>> rows(static_cast<size_t>(height));
        const Picture picture(film, color, removed);
        parallelFor(0, height, [&](int y) {
            for (int x = 0; x < width; ++x) {
                const Neighbours around = picture.around(x, y);
                if (!picture.isOutlier(x, y, around)) continue;
                Outlier found{x, y, {}, {}};
                for (int c = 0; c < 3; ++c) {
                    found.mean[c] = around.mean[c];
                    found.excess[c] = picture.at(x, y)[c] - around.mean[c];
                }
                rows[size_t(y)].push_back(found);
            }
        });
        for (const auto& row : rows)
            for (const Outlier& found : row) {
                std::copy(found.mean, found.mean + 3, pixel(found.x, found.y));
                removed[size_t(found.y) * size_t(width) + size_t(found.x)] = 1;
                outliers.push_back(found);
            }
    }
    if (outliers.empty()) return 0;
    // In proportion to what is there without outliers, not to what others have added.
    std::vector<float> weights(size_t(width) * size_t(height));
    for (size_t i = 0; i < weights.size(); ++i)
        if (film.sampleCount(int(i) % width, int(i) / width))
            weights[i] = std::max(luminanceOf(&color[3 * i]), 0.0f);
    std::map<int, Spread> spreads; // by the step of their nodes
    for (const Outlier& found : outliers) {
        const float excess = luminanceOf(found.excess);
        const float around = std::max(luminanceOf(found.mean), 1e-4f);
        // The area's mean weight is a third of its middle's.
        const float radius = std::clamp(std::sqrt(3.0f / pi * excess / (share * around)), smallest,
                                        std::hypot(float(width), float(height)));
        int step = 1;
        while (radius > float(finest * step))
            step *= 2;
        auto place = spreads.find(step);
        if (place == spreads.end())
            place = spreads.emplace(step, Spread(weights, width, height, step)).first;
        if (!place->second.add(found.x, found.y, radius, found.excess)) // nothing could carry it
            for (int c = 0; c < 3; ++c)
                pixel(found.x, found.y)[c] += found.excess[c];
    }
    for (const auto& item : spreads)
        item.second.show(weights, color);
    return int(outliers.size());
}

} // namespace patina
