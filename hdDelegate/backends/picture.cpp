// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/backends/picture.h"

#include "hdDelegate/parallel.h"

#include <algorithm>
#include <cmath>

namespace patina {

using glm::vec4;

namespace {

constexpr int blockSize = 16;

template <class Function> vec4 colorwise(Function f, vec4 v) {
    return {f(v.x), f(v.y), f(v.z), v.w};
}

} // namespace

Picture pictureOf(const Film& film) {
    Picture picture{film.width(), film.height(), {}};
    picture.pixels.resize(size_t(film.width()) * size_t(film.height()));
    if (film.splats()) {
        const std::vector<float> color = film.resolve("color"), alpha = film.resolve("alpha");
        for (size_t i = 0; i < alpha.size(); ++i)
            picture.pixels[i] = vec4(color[3 * i], color[3 * i + 1], color[3 * i + 2], alpha[i]);
        return picture;
    }
    parallelFor(0, film.height(), [&](int y) {
        vec4* row = &picture.pixels[size_t(y) * size_t(film.width())];
        for (int x = 0; x < film.width(); ++x)
            row[x] = vec4(film.color(x, y), film.alpha(x, y));
    });
    return picture;
}

void writePicture(const Picture& picture, Film& film) {
    film.forgetQuarters();
    parallelFor(0, film.height(), [&](int y) {
        const vec4* row = &picture.pixels[size_t(y) * size_t(film.width())];
        for (int x = 0; x < film.width(); ++x)
            film.setMean(x, y, glm::vec3(row[x]), row[x].w);
    });
}

Picture boxBlur(const Picture& picture, int radius) {
    const int w = picture.width, h = picture.height;
    Picture across = picture, result = picture;
    // Sums in double: a running float sum of very bright pixels would leave a trace behind them.
    parallelFor(0, h, [&](int y) {
        const vec4* from = &picture.pixels[size_t(y) * size_t(w)];
        vec4* to = &across.pixels[size_t(y) * size_t(w)];
        glm::dvec4 sum(0.0);
        for (int x = 0; x < std::min(radius, w); ++x)
            sum += glm::dvec4(from[x]);
        for (int x = 0; x < w; ++x) {
            if (x + radius < w) sum += glm::dvec4(from[x + radius]);
            if (x - radius - 1 >= 0) sum -= glm::dvec4(from[x - radius - 1]);
            const int count = std::min(x + radius, w - 1) - std::max(x - radius, 0) + 1;
            to[x] = vec4(sum / double(count));
        }
    });
    // Columns in strips, so that memory is read along the rows.
    constexpr int strip = 64;
    parallelFor(0, (w + strip - 1) / strip, [&](int s) {
        const int x0 = s * strip, x1 = std::min(w, x0 + strip);
        std::vector<glm::dvec4> sums(size_t(x1 - x0), glm::dvec4(0.0));
        const auto add = [&](int y, double sign) {
            for (int x = x0; x < x1; ++x)
                sums[size_t(x - x0)] +=
                    sign * glm::dvec4(across.pixels[size_t(y) * size_t(w) + size_t(x)]);
        };
        for (int y = 0; y < std::min(radius, h); ++y)
            add(y, 1.0);
        for (int y = 0; y < h; ++y) {
            if (y + radius < h) add(y + radius, 1.0);
            if (y - radius - 1 >= 0) add(y - radius - 1, -1.0);
            const int count = std::min(y + radius, h - 1) - std::max(y - radius, 0) + 1;
            for (int x = x0; x < x1; ++x)
                result.pixels[size_t(y) * size_t(w) + size_t(x)] =
                    vec4(sums[size_t(x - x0)] / double(count));
        }
    });
    return result;
}

float toEye(float linear) {
    if (!(linear > 0.0f)) return 0.0f;
    return linear <= 1.0f ? std::sqrt(linear) : 1.5f - 0.5f / linear;
}

float fromEye(float seen) {
    if (!(seen > 0.0f)) return 0.0f;
    return seen <= 1.0f ? seen * seen : 0.5f / std::max(1.5f - seen, 1e-6f);
}

float largestStep(const Picture& a, const Picture& b) {
    const int w = a.width, h = a.height, rows = (h + blockSize - 1) / blockSize;
    std::vector<float> worst(size_t(rows), 0.0f);
    parallelFor(0, rows, [&](int row) {
        for (int x0 = 0; x0 < w; x0 += blockSize) {
            const int x1 = std::min(w, x0 + blockSize), y1 = std::min(h, (row + 1) * blockSize);
            glm::dvec4 sum(0.0);
            for (int y = row * blockSize; y < y1; ++y)
                for (int x = x0; x < x1; ++x) {
                    const size_t i = size_t(y) * size_t(w) + size_t(x);
                    sum +=
                        glm::dvec4(colorwise(toEye, b.pixels[i]) - colorwise(toEye, a.pixels[i]));
                }
            const double count = double(x1 - x0) * (y1 - row * blockSize);
            for (int k = 0; k < 4; ++k)
                worst[size_t(row)] = std::max(worst[size_t(row)], float(std::abs(sum[k]) / count));
        }
    });
    return worst.empty() ? 0.0f : *std::max_element(worst.begin(), worst.end());
}

bool approach(Picture& shown, const Picture& target, float bound, float maxFraction) {
    const float step = largestStep(shown, target);
    if (step <= bound && maxFraction >= 1.0f) {
        shown = target;
        return true;
    }
    // Along toEye() the means of all blocks move by this share of their way.
    const float share = std::min(maxFraction, 0.999f * bound / std::max(step, 1e-6f));
    parallelFor(0, shown.height, [&](int y) {
        for (size_t i = size_t(y) * size_t(shown.width), n = i + size_t(shown.width); i < n; ++i) {
            const vec4 from = colorwise(toEye, shown.pixels[i]);
            const vec4 to = colorwise(toEye, target.pixels[i]);
            shown.pixels[i] = colorwise(fromEye, from + share * (to - from));
        }
    });
    return false;
}

} // namespace patina
