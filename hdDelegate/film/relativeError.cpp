// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/film/relativeError.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

constexpr double meanOfHalfNormal = 0.79788456080286536; // sqrt(2 / pi)
constexpr double minLuminance = 0.01;                    // black pixels do not decide

/// A rectangle of numbers.
struct Grid {
    int width, height;
    std::vector<float> values;

    Grid(int width, int height)
        : width(width), height(height), values(size_t(width) * size_t(height)) {}
    float& at(int x, int y) { return values[size_t(y) * size_t(width) + size_t(x)]; }
    float at(int x, int y) const { return values[size_t(y) * size_t(width) + size_t(x)]; }

    /// Mean of a number and those of its up to eight neighbours.
    double meanAround(int x, int y) const {
        const int left = std::max(x - 1, 0), right = std::min(x + 1, width - 1);
        const int top = std::max(y - 1, 0), bottom = std::min(y + 1, height - 1);
        double sum = 0.0;
        for (int v = top; v <= bottom; ++v)
            for (int u = left; u <= right; ++u)
                sum += at(u, v);
        return sum / ((right - left + 1) * (bottom - top + 1));
    }
};

} // namespace

double relativeError(const Film& film, int x0, int y0, int x1, int y1, PixelNoise noise) {
    if (x1 <= x0 || y1 <= y0) return 0.0;
    Grid luminance(x1 - x0, y1 - y0), squares(x1 - x0, y1 - y0);
    for (int y = y0; y < y1; ++y)
        for (int x = x0; x < x1; ++x)
            luminance.at(x - x0, y - y0) = std::abs(film.luminance(x, y));
    double plain = 0.0; // by the variance of samples that would be independent
    for (int y = y0; y < y1; ++y)
        for (int x = x0; x < x1; ++x) {
            // A pixel that has found too much light must not count less for that.
            const double l = luminance.at(x - x0, y - y0);
            const double scale = std::min(l, luminance.meanAround(x - x0, y - y0)) + minLuminance;
            const double deviation = double(film.deviationOfMean(x, y)) / scale;
            squares.at(x - x0, y - y0) = float(std::min(deviation * deviation, 1e30));
            plain += std::sqrt(double(film.varianceOfMean(x, y))) / scale;
        }
    // Light that few samples find is noise of the pixels around, too, that have found none of it.
    double sum = 0.0, own = 0.0, ownSquares = 0.0;
    for (int y = 0; y < squares.height; ++y)
        for (int x = 0; x < squares.width; ++x) {
            sum += std::sqrt(squares.meanAround(x, y));
            own += std::sqrt(double(squares.at(x, y)));
            ownSquares += double(squares.at(x, y));
        }
    // One standard error more, since a few pixels may have most of the noise, and each knows its
    // own badly: of the pixels themselves, for means around are no more numbers than these.
    const double pixels = double(squares.values.size()), ownMean = own / pixels;
    const double spread =
        pixels > 1.0 ? std::max(ownSquares / pixels - ownMean * ownMean, 0.0) / (pixels - 1.0)
                     : ownSquares;
    double error = sum / pixels + std::sqrt(spread);
    // Pixels that are wrong together may agree by chance: then half of the plain error is the
    // least.
    if (noise == PixelNoise::Shared) error = std::max(error, 0.5 * plain / pixels);
    return meanOfHalfNormal * error;
}

int nextStep(int samples, int maximum) {
    int step = 16;
    while (step < 256 && samples / step >= 32)
        step *= 2;
    const int next = samples == 0 ? 1 : samples < 16 ? samples * 2 : (samples / step + 1) * step;
    return std::min(next, maximum);
}

bool isErrorStep(int samples) {
    const auto powerOfTwo = [](int n) { return n > 0 && (n & (n - 1)) == 0; };
    return powerOfTwo(samples) || (samples > 32 && samples % 3 == 0 && powerOfTwo(samples / 3));
}

} // namespace patina
