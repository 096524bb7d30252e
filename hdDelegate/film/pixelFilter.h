#pragma once

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace patina {

/// Draws offsets from the pixel's centre with the density of the pixel filter (filter importance
/// sampling, Ernst et al. 2006): every sample counts fully, and for its own pixel only.
/// A radius up to 0.5 is a box of that radius; above it is a Gaussian cut off at the radius, with
/// a standard deviation of half the radius.
class PixelFilter {
public:
    explicit PixelFilter(float radius) : _radius(std::max(0.0f, radius)), _box(radius <= 0.5f) {
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
