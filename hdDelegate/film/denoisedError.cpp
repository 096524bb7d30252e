// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/film/denoiser.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

constexpr double meanOfHalfNormal = 0.79788456080286536; // sqrt(2 / pi)
constexpr double minLuminance = 0.01;                    // as in relativeError()
constexpr double margin = 2.0;                           // standard errors
constexpr size_t strata = 4;
constexpr int radius = 3; // of the squares whose means sort pixels

/// An AOV's means over both halves of the samples.
struct Halves {
    std::vector<float> first, second;

    Halves(const Film& film, const std::string& all, const std::string& half)
        : first(film.resolve(half)), second(film.resolve(all)) {
        for (size_t i = 0; i < second.size(); ++i) {
            const size_t pixel = i / 3, width = size_t(film.width());
            const double n = film.sampleCount(int(pixel % width), int(pixel / width));
            const double before = std::ceil(n / 2.0);
            second[i] =
                n < 2.0 ? first[i]
                        : float((n * double(second[i]) - before * double(first[i])) / (n - before));
        }
    }
};

/// Rec.709.
double luminance(const std::vector<float>& pixels, size_t i) {
    return 0.2126 * double(pixels[3 * i]) + 0.7152 * double(pixels[3 * i + 1]) +
           0.0722 * double(pixels[3 * i + 2]);
}

/// Means over squares around each number, as far as they lie in the image.
std::vector<double> blurred(std::vector<double> values, int width, int height) {
    std::vector<double> out(values.size());
    for (int pass = 0; pass < 2; ++pass) { // along rows, then along columns
        const int length = pass ? height : width, lines = pass ? width : height;
        const int step = pass ? width : 1, stride = pass ? 1 : width;
        for (int line = 0; line < lines; ++line)
            for (int i = 0; i < length; ++i) {
                const int begin = std::max(i - radius, 0), end = std::min(i + radius + 1, length);
                double sum = 0.0;
                for (int k = begin; k < end; ++k)
                    sum += values[size_t(line * stride + k * step)];
                out[size_t(line * stride + i * step)] = sum / (end - begin);
            }
        values.swap(out);
    }
    return values;
}

/// What a pixel tells: of its squared relative error, and for sorting.
struct Told {
    double squared, likely;
};

/// The mean of |errors|, at most, from their squares: that of numbers with a normal distribution of
/// any mixture of deviations is sqrt(2 / pi) of the root of their mean square or less (Jensen), and
/// the closer to it the less their deviations differ. So pixels of like errors are taken together.
double meanError(std::vector<Told> pixels) {
    std::sort(pixels.begin(), pixels.end(),
              [](const Told& a, const Told& b) { return a.likely < b.likely; });
    double sum = 0.0;
    for (size_t k = 0; k < strata; ++k) {
        const size_t begin = k * pixels.size() / strata, end = (k + 1) * pixels.size() / strata;
        if (begin == end) continue;
        const double n = double(end - begin);
        double mean = 0.0, squares = 0.0;
        for (size_t i = begin; i < end; ++i)
            mean += pixels[i].squared / n;
        for (size_t i = begin; i < end; ++i)
            squares += (pixels[i].squared - mean) * (pixels[i].squared - mean) / n;
        sum += n * std::sqrt(std::max(mean + margin * std::sqrt(squares / n), 0.0));
    }
    return meanOfHalfNormal * sum / double(pixels.size());
}

} // namespace

bool hasHalves(const Film& film) {
    const auto has = [&](const char* aov) { return film.aovIndex(aov) >= 0; };
    return !film.source() && has(denoisingAlbedoAov) && has(denoisingNormalAov) &&
           has(denoisingHalfColorAov) && has(denoisingHalfAlbedoAov) && has(denoisingHalfNormalAov);
}

double denoisedError(const Film& film, int threads) {
    if (!hasHalves(film)) return -1.0;
    const int width = film.width(), height = film.height();
    const Halves color(film, film.denoised() ? "color.noisy" : "color", denoisingHalfColorAov);
    const Halves albedo(film, denoisingAlbedoAov, denoisingHalfAlbedoAov);
    const Halves normal(film, denoisingNormalAov, denoisingHalfNormalAov);
    std::vector<size_t> known;
    double samples = 0.0;
    for (size_t i = 0; i < color.first.size() / 3; ++i) {
        const uint32_t n = film.sampleCount(int(i % size_t(width)), int(i / size_t(width)));
        if (n < 2) continue;
        known.push_back(i);
        samples += 0.5 * n;
    }
    if (known.empty()) return -1.0;
    samples /= double(known.size());
    const auto clean =
        denoised({{width, height, color.first, albedo.first, normal.first, samples},
                  {width, height, color.second, albedo.second, normal.second, samples}},
                 threads);

    std::vector<double> changes(color.first.size() / 3), scales(changes.size());
    for (const size_t i : known) {
        const double a = luminance(clean[0], i), b = luminance(clean[1], i);
        scales[i] = std::abs(0.5 * (a + b)) + minLuminance;
        changes[i] = (a - b) * (a - b) / (scales[i] * scales[i]);
    }
    const std::vector<double> likely = blurred(changes, width, height);
    std::vector<Told> told;
    told.reserve(known.size());
    for (const size_t i : known) {
        const double a = luminance(color.first, i), b = luminance(color.second, i);
        const double cleanA = luminance(clean[0], i), cleanB = luminance(clean[1], i);
        const auto square = [](double x) { return x * x; };
        // Of the mean of both clean halves: their own noise is independent, what is blurred is not.
        const double error = 0.5 * (square(cleanA - b) + square(cleanB - a) - square(a - b)) -
                             0.25 * square(cleanA - cleanB);
        told.push_back({error / square(scales[i]), likely[i]});
    }
    return meanError(std::move(told));
}

} // namespace patina
