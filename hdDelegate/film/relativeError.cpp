#include "hdDelegate/film/relativeError.h"

#include <algorithm>
#include <cmath>

namespace patina {

double relativeError(const Film& film, int x0, int y0, int x1, int y1) {
    constexpr double meanOfHalfNormal = 0.79788456080286536; // sqrt(2 / pi)
    // The variance of a pixel is known badly after few samples: the pixels share theirs.
    double variance = 0.0, luminance = 0.0, relative = 0.0;
    int pixels = 0;
    for (int y = y0; y < y1; ++y)
        for (int x = x0; x < x1; ++x) {
            const double v = film.varianceOfMean(x, y), l = film.luminance(x, y);
            variance += v;
            luminance += l;
            relative += std::sqrt(v) / (l + 0.01);
            ++pixels;
        }
    if (pixels == 0) return 0.0;
    const double pooled = std::sqrt(variance / pixels) / (luminance / pixels + 0.01);
    return meanOfHalfNormal * std::max(pooled * 0.5, relative / pixels);
}

int nextErrorStep(int samples, int most) {
    const int next = samples == 0 ? 1 : samples < 16 ? samples * 2 : (samples / 16 + 1) * 16;
    return std::min(next, most);
}

bool isErrorStep(int samples) {
    const bool powerOfTwo = samples > 0 && (samples & (samples - 1)) == 0;
    return samples <= 16 ? powerOfTwo : samples % 16 == 0;
}

} // namespace patina
