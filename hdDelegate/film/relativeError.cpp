// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/film/relativeError.h"
#include "hdDelegate/film/spans.h"

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

ErrorSums& ErrorSums::operator+=(const ErrorSums& other) {
    pixels += other.pixels;
    around += other.around;
    own += other.own;
    ownSquares += other.ownSquares;
    before += other.before;
    growth += other.growth;
    plain += other.plain;
    return *this;
}

ErrorSums errorSums(const Film& film, int x0, int y0, int x1, int y1) {
    ErrorSums sums;
    if (x1 <= x0 || y1 <= y0) return sums;
    Grid luminance(x1 - x0, y1 - y0), squares(x1 - x0, y1 - y0);
    for (int y = y0; y < y1; ++y)
        for (int x = x0; x < x1; ++x)
            luminance.at(x - x0, y - y0) = std::abs(film.luminance(x, y));
    for (int y = y0; y < y1; ++y)
        for (int x = x0; x < x1; ++x) {
            if (!film.sampleCount(x, y)) continue;
            // A pixel that has found too much light must not count less for that.
            const double l = luminance.at(x - x0, y - y0);
            const double scale = std::min(l, luminance.meanAround(x - x0, y - y0)) + minLuminance;
            const double deviation = double(film.deviationOfMean(x, y)) / scale;
            squares.at(x - x0, y - y0) = float(std::min(deviation * deviation, 1e30));
            const int n = int(film.sampleCount(x, y));
            int part = 1;
            while (part < n - part)
                part *= 2;
            sums.before += double(film.deviationBefore(x, y)) / scale;
            sums.growth += double(n) / part;
            sums.plain += std::sqrt(double(film.varianceOfMean(x, y))) / scale;
        }
    // Light that few samples find is noise of the pixels around, too, that have found none of it.
    for (int y = 0; y < squares.height; ++y)
        for (int x = 0; x < squares.width; ++x) {
            if (!film.sampleCount(x0 + x, y0 + y)) continue;
            sums.pixels += 1.0;
            sums.around += std::sqrt(squares.meanAround(x, y));
            sums.own += std::sqrt(double(squares.at(x, y)));
            sums.ownSquares += double(squares.at(x, y));
        }
    return sums;
}

/// The true error over the estimate by changes between means, where errors fall faster than with
/// the root of the number of samples. With the error e(n) ~ n^-a a mean changes from p samples to n
/// by e(p)^2 - e(n)^2 = e(n)^2 ((n/p)^2a - 1). Film::deviationOfMean() has 2a = 1, in the change
/// and in what remains of the estimates before, e(p)^2 p / n.
static double spreadCorrection(const ErrorSums& sums) {
    constexpr double steepest = 1.3; // of 2a that is believed
    const double growth = sums.growth / sums.pixels;
    if (!(sums.before > 0.0) || !(sums.own > 0.0) || !(growth > 1.0)) return 1.0;
    const double ratio = (sums.own * sums.own) / (sums.before * sums.before);
    // Less what chance may have made of it, at two standard errors of each mean.
    const double slope = (-std::log(ratio) - 2.0 / std::sqrt(sums.pixels)) / std::log(growth);
    const double power = std::clamp(slope, 1.0, steepest);
    const double octave = std::pow(2.0, -power); // of e^2
    const double before = (2.0 * octave - 0.5) / (1.0 - octave);
    const double remains = sums.before * sums.before / growth;
    const double change = std::max(2.0 * sums.own * sums.own - remains, 0.0);
    const double corrected = change * (growth - 1.0) / (std::pow(growth, power) - 1.0) +
                             remains * std::pow(growth, 1.0 - power) * before;
    return std::sqrt(std::min(corrected / (2.0 * sums.own * sums.own), 1.0));
}

double relativeError(const ErrorSums& sums, PixelNoise noise) {
    if (!(sums.pixels > 0.0)) return 0.0;
    // One standard error more, since a few pixels may have most of the noise, and each knows its
    // own badly: of the pixels themselves, for means around are no more numbers than these.
    const double pixels = sums.pixels, ownMean = sums.own / pixels;
    const double spread =
        pixels > 1.0 ? std::max(sums.ownSquares / pixels - ownMean * ownMean, 0.0) / (pixels - 1.0)
                     : sums.ownSquares;
    double error = spreadCorrection(sums) * (sums.around / pixels) + std::sqrt(spread);
    // Pixels that are wrong together may agree by chance: then half of the plain error is the
    // least.
    if (noise == PixelNoise::Shared) error = std::max(error, 0.5 * sums.plain / pixels);
    return meanOfHalfNormal * error;
}

double relativeError(const Film& film, int x0, int y0, int x1, int y1, PixelNoise noise) {
    return relativeError(errorSums(film, x0, y0, x1, y1), noise);
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

bool isImageErrorStep(int samples) {
    return samples > 0 && isSpanEnd(uint32_t(samples));
}

} // namespace patina
