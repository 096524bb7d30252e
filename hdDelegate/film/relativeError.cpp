// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/film/relativeError.h"
#include "hdDelegate/film/pixelSplat.h"
#include "hdDelegate/film/spans.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

constexpr double meanOfHalfNormal = 0.79788456080286536; // sqrt(2 / pi)
constexpr double minLuminance = 0.01;                    // black pixels do not decide
// Derived in docs/measurements/tolerance.md, "Thresholds".
constexpr double fewFinds = 5.0;   // samples of a pixel that find light: halves tell too little
constexpr double manyAround = 0.2; // of nine pixels: two or more
constexpr double margin = 2.0;     // standard errors

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

/// Pixels whose samples count for others too err less, and alike: changes of pixels around that
/// differ in sign cancel out, as errors will. Pixels beyond the rectangle are not asked, since
/// others may change them.
/// @param changes of the means of the pixels' own samples, over luminance
/// @param ofRare the part of the error that is of light which few samples find: nearly all pixels
/// lack it alike, so that they do not cancel
void shareNoise(const Grid& changes, float radius, double ofRare, ErrorSums& sums) {
    const PixelSplat::Noise noise(radius);
    const int reach = int(noise.weights.size() / 2);
    double own = 0.0, shared = 0.0;
    for (int y = 0; y < changes.height; ++y)
        for (int x = 0; x < changes.width; ++x) {
            if (std::isnan(changes.at(x, y))) continue;
            double sum = 0.0, weights = 0.0;
            for (int v = std::max(y - reach, 0); v <= std::min(y + reach, changes.height - 1); ++v)
                for (int u = std::max(x - reach, 0); u <= std::min(x + reach, changes.width - 1);
                     ++u) {
                    if (std::isnan(changes.at(u, v))) continue;
                    const double w =
                        noise.weights[size_t(u - x + reach)] * noise.weights[size_t(v - y + reach)];
                    sum += w * changes.at(u, v);
                    weights += w;
                }
            own += std::abs(double(changes.at(x, y)));
            shared += std::abs(sum / weights);
        }
    if (!(own > 0.0)) return;
    const double less = std::min(1.0, noise.finer * shared / own);
    sums.error = ofRare + less * (sums.error - ofRare);
    sums.own *= less;
    sums.before *= less;
    sums.ownSquares *= less * less * noise.together;
}

} // namespace

ErrorSums& ErrorSums::operator+=(const ErrorSums& other) {
    pixels += other.pixels;
    error += other.error;
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
    const int width = x1 - x0, height = y1 - y0;
    Grid luminance(width, height), scale(width, height), squares(width, height),
        rare(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            luminance.at(x, y) = std::abs(film.luminance(x0 + x, y0 + y));
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const double l = luminance.at(x, y), variance = film.varianceOfMean(x0 + x, y0 + y);
            // A pixel that has found too much light must not count less for that: within its noise
            // the luminance is that of the pixels around. Bright ones beside it hide no noise.
            const double below = 2.0 * std::sqrt(variance);
            const double above = 2.0 * double(film.deviationOfMean(x0 + x, y0 + y));
            const double known =
                std::clamp(luminance.meanAround(x, y), std::max(l - below, 0.0), l + above);
            scale.at(x, y) = float(known + minLuminance);
            squares.at(x, y) =
                float(std::min(variance / ((known + minLuminance) * (known + minLuminance)), 1e30));
            // The root of k equal finds is how many standard errors k finds lie above none.
            rare.at(x, y) = l * l <= fewFinds * variance ? 1.0f : 0.0f;
        }
    double ofRare = 0.0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const uint32_t n = film.sampleCount(x0 + x, y0 + y);
            if (!n) continue;
            uint32_t part = 1;
            while (part < n - part)
                part *= 2;
            const double s = scale.at(x, y);
            const double plain = meanOfHalfNormal * std::sqrt(double(squares.at(x, y)));
            double own = double(film.deviationOfMean(x0 + x, y0 + y)) / s;
            // Two halves with as much of it agree by chance.
            if (rare.at(x, y) > 0.0f) own = std::max(own, plain);
            // Light that few samples find is noise of the pixels around, too, that have found none
            // of it. It errs up and down unlike, which halves do not show.
            const bool isRare = rare.meanAround(x, y) > manyAround;
            const double error =
                isRare ? meanOfHalfNormal * std::sqrt(squares.meanAround(x, y)) : own;
            sums.error += error;
            if (isRare) ofRare += error;
            sums.pixels += 1.0;
            sums.own += own;
            sums.ownSquares += own * own;
            sums.before += double(film.deviationBefore(x0 + x, y0 + y)) / s;
            sums.growth += double(n) / part;
            sums.plain += plain;
        }
    if (film.aovIndex("quarterShares") < 0) return sums;
    Grid changes(width, height); // NaN where there are no samples, as around a crop
    float radius = 0.0f;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const float own = film.splatRadius(x0 + x, y0 + y);
            changes.at(x, y) =
                own > 0.0f ? film.changeOfMean(x0 + x, y0 + y) / scale.at(x, y) : NAN;
            radius = std::max(radius, own);
        }
    if (radius > 0.0f) shareNoise(changes, radius, ofRare, sums);
    return sums;
}

/// The true error over the estimate by changes between means, where errors fall faster than with
/// the root of the number of samples. With the error e(n) ~ n^-a a mean changes from p samples to n
/// by e(p)^2 - e(n)^2 = e(n)^2 ((n/p)^2a - 1). Film::deviationOfMean() has 2a = 1, in the change
/// and in what remains of the estimates before. At powers of two it so is C e(n), with
/// C = k / (2 - 2^(a - 1/2)) of k = (2^2a - 1)^1/2.
static double spreadCorrection(const ErrorSums& sums) {
    constexpr double steepest = 1.3; // of 2a that is believed
    const double growth = sums.growth / sums.pixels;
    if (!(sums.before > 0.0) || !(sums.own > 0.0) || !(growth > 1.0)) return 1.0;
    const double ratio = (sums.own * sums.own) / (sums.before * sums.before);
    // Less what chance may have made of it.
    const double slope =
        (-std::log(ratio) - margin / std::sqrt(sums.pixels)) / std::log(2.0 * growth);
    const double power = std::clamp(slope, 1.0, steepest);
    const double atPower =
        std::sqrt(std::pow(2.0, power) - 1.0) / (2.0 - std::pow(2.0, 0.5 * (power - 1.0)));
    const double latest = std::sqrt((std::pow(growth, power) - 1.0) / (growth - 1.0));
    const double weight = 0.5 * (growth - 1.0); // as in the deviation
    return 1.0 /
           (weight * latest + (1.0 - weight) * atPower * std::pow(growth, 0.5 * (power - 1.0)));
}

double relativeError(const ErrorSums& sums, PixelNoise noise) {
    if (!(sums.pixels > 0.0)) return 0.0;
    // A margin for what chance makes of the difference between estimate and error.
    // How much of a pixel's square that is follows for normal noise: of |n| it is 1 - 2 / pi, and a
    // third of that of a mean of halves that count 1/2, 1/4, 1/8...
    constexpr double ofError = 1.0 - meanOfHalfNormal * meanOfHalfNormal, ofHalves = ofError / 3.0;
    constexpr double chance = (ofError + ofHalves) / (1.0 - ofError + ofHalves);
    const double error =
        (spreadCorrection(sums) * sums.error + margin * std::sqrt(chance * sums.ownSquares)) /
        sums.pixels;
    // Pixels that are wrong together may agree by chance: then half of the plain error is the
    // least.
    return noise == PixelNoise::Shared ? std::max(error, 0.5 * sums.plain / sums.pixels) : error;
}

double relativeError(const Film& film, int x0, int y0, int x1, int y1, PixelNoise noise) {
    return relativeError(errorSums(film, x0, y0, x1, y1), noise);
}

int nextStep(int samples, int maximum) {
    int step = 2;
    while (step < 256 && samples / step >= (step < 16 ? 16 : 32))
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
