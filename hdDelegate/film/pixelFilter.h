// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace patina {

/// Draws offsets from the pixel's centre with the density of the pixel filter (filter importance
/// sampling, Ernst et al. 2006): every sample counts fully, and for its own pixel only.
/// A radius up to 0.5 is a box of that radius; above it is a Gaussian cut off at the radius, with
/// a standard deviation of half the radius.
class PixelFilter {
public:
    static constexpr float largestRadius = 1000.0f; ///< pixels; larger ones count as this
    explicit PixelFilter(float radius)
        : _radius(std::min(std::max(0.0f, radius), largestRadius)), _box(radius <= 0.5f) {
        double sum = 0.0;
        for (int i = 0; i < fine; ++i) {
            const double x = ((i + 0.5) / fine * 2.0 - 1.0) * 2.0; // in standard deviations
            sum += std::exp(-0.5 * x * x);
        }
        double running = 0.0;
        int next = 0;
        for (int i = 0; i < fine; ++i) {
            const double x = ((i + 0.5) / fine * 2.0 - 1.0);
            const double step = std::exp(-2.0 * x * x) / sum;
            while (next <= size && double(next) / size <= running + step) {
                const double inside = (double(next) / size - running) / step;
                _inverse[next++] = float((i + inside) / fine * 2.0 - 1.0);
            }
            running += step;
        }
        while (next <= size)
            _inverse[next++] = 1.0f;
    }

    /// @param u in [0,1)^2. @returns an offset in pixels.
    glm::vec2 sample(glm::vec2 u) const {
        if (_box) return (u * 2.0f - 1.0f) * _radius;
        return glm::vec2(inverse(u.x), inverse(u.y)) * _radius;
    }

    /// How many pixels away, along an axis, a sample may count for others too: see shares().
    int reach() const {
        const int maximum = int(std::ceil(2.0f * std::min(_radius, 100.0f))) - 1;
        return maximum > largestReach ? 0 : std::max(0, maximum);
    }
    /// Shares of a sample along one axis, where all pixels have samples at the same offset. Offsets
    /// that differ by whole pixels are as likely as the filter is high there, so the sample goes to
    /// all of them by that: the mean is the filter's, with the samples of several pixels.
    /// @param offset from the pixel's centre, of sample()
    /// @returns by pixels from -reach() to reach() along the axis; their sum is 1
    std::vector<float> splatWeights(float offset) const {
        const int maximum = reach();
        std::vector<float> out(size_t(2 * maximum + 1), 0.0f);
        float sum = 0.0f;
        for (int i = -maximum; i <= maximum; ++i) {
            const float x = (offset - float(i)) / std::max(_radius, 1e-20f);
            const bool inside = i == 0 || std::fabs(x) < 1.0f;
            sum += out[size_t(i + maximum)] =
                inside ? (_box ? 1.0f : std::exp(-2.0f * x * x)) : 0.0f;
        }
        for (float& share : out)
            share /= sum;
        return out;
    }

    /// The filter's mass in cells of half a pixel, left to right, as many on either side of the
    /// pixel's centre; their sum is 1. A filter that is even within each cell is nearly the same.
    std::vector<float> halfPixelWeights() const {
        const int side = std::max(1, int(std::ceil(2.0f * _radius - 1e-3f)));
        const auto below = [&](double x) { // the integral, but for a factor
            const double t = std::clamp(x / _radius, -1.0, 1.0);
            return _box ? t : std::erf(std::sqrt(2.0) * t);
        };
        std::vector<float> cells(size_t(2 * side));
        for (int i = 0; i < 2 * side; ++i)
            cells[size_t(i)] = float((below(0.5 * (i + 1 - side)) - below(0.5 * (i - side))) /
                                     (2.0 * below(_radius)));
        return cells;
    }
    bool isBox() const { return _box; }

    /// The quarter of its pixel that a sample is in: left or right, plus 2 below the centre.
    static int quarterOf(const glm::vec2& offset) {
        return (offset.x < 0.0f ? 0 : 1) + (offset.y < 0.0f ? 0 : 2);
    }

    static constexpr int largestReach = 8; ///< pixels

private:
    static constexpr int size = 256, fine = 16384;

    float inverse(float u) const {
        const float x = u * size;
        const int i = std::min(int(x), size - 1);
        return _inverse[i] + (_inverse[i + 1] - _inverse[i]) * (x - float(i));
    }

    float _radius;
    bool _box;
    std::array<float, size + 1> _inverse{};
};

} // namespace patina
