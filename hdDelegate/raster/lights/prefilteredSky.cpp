// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/lights/prefilteredSky.h"

#include "base/maths.h"
#include "shaders/lights.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

using glm::vec2;
using glm::vec3;
constexpr int w = PrefilteredSky::width, h = PrefilteredSky::height;

vec3 directionAt(int x, int y, int columns, int rows) {
    return shLights::domeDirection(
        vec2((float(x) + 0.5f) / float(columns), (float(y) + 0.5f) / float(rows)));
}

} // namespace

float PrefilteredSky::alphaOf(int level) {
    const float alphas[levels] = {0.1f, 0.2f, 0.4f, 0.7f, 1.0f};
    return alphas[level];
}

float PrefilteredSky::levelOf(float alpha) {
    for (int i = 1; i < levels; ++i)
        if (alpha < alphaOf(i))
            return std::max(0.0f, float(i - 1) +
                                      (alpha - alphaOf(i - 1)) / (alphaOf(i) - alphaOf(i - 1)));
    return float(levels - 1);
}

PrefilteredSky::PrefilteredSky(const std::function<vec3(const vec3&)>& radiance) {
    // Means over the cells, so that no bright texel falls through.
    std::vector<vec3> sky(size_t(w) * h), directions(size_t(w) * h);
    std::vector<float> angles(size_t(h), 0.0f);
    const int fine = 8;
    for (int y = 0; y < h; ++y) {
        angles[size_t(y)] =
            (std::cos(float(y) / h * pi) - std::cos(float(y + 1) / h * pi)) * 2.0f * pi / w;
        for (int x = 0; x < w; ++x) {
            vec3 sum(0.0f);
            float weight = 0.0f;
            for (int k = 0; k < fine * fine; ++k) {
                const vec3 d =
                    directionAt(x * fine + k % fine, y * fine + k / fine, w * fine, h * fine);
                const float sine = std::sqrt(std::max(0.0f, 1.0f - d.y * d.y));
                const vec3 l = glm::max(radiance(d), vec3(0.0f));
                if (!std::isfinite(l.x + l.y + l.z)) continue;
                sum += l * sine;
                weight += sine;
            }
            const size_t i = size_t(y) * w + size_t(x);
            sky[i] = sum / std::max(weight, 1e-20f);
            directions[i] = directionAt(x, y, w, h);
        }
    }
    for (int level = 0; level < levels; ++level) {
        const float a2 = alphaOf(level) * alphaOf(level);
        // Rough levels are smooth: half of the grid, and the rest between.
        const int step = alphaOf(level) > 0.3f ? 2 : 1, cw = w / step, ch = h / step;
        std::vector<vec3> coarse(size_t(cw) * size_t(ch));
        for (int y = 0; y < ch; ++y)
            for (int x = 0; x < cw; ++x) {
                const vec3 r = directionAt(x, y, cw, ch);
                vec3 sum(0.0f);
                float weight = 0.0f;
                for (int v = 0; v < h; ++v)
                    for (int u = 0; u < w; ++u) {
                        const size_t i = size_t(v) * w + size_t(u);
                        const float cosine = glm::dot(directions[i], r);
                        if (cosine <= 0.0f) continue;
                        // cos^2 of the half vector's angle is (1 + cos) / 2.
                        const float m2 = 0.5f * (1.0f + cosine), d = m2 * (a2 - 1.0f) + 1.0f;
                        const float k = cosine * angles[size_t(v)] / (d * d);
                        sum += sky[i] * k;
                        weight += k;
                    }
                coarse[size_t(y) * size_t(cw) + size_t(x)] = sum / std::max(weight, 1e-20f);
            }
        const auto at = [&](int x, int y) {
            return coarse[size_t(std::clamp(y, 0, ch - 1)) * size_t(cw) + size_t((x + cw) % cw)];
        };
        std::vector<glm::vec4>& out = _levels[level];
        for (int y = 0; y < h; ++y)
            for (int x = 0; x < w; ++x) {
                const float fx = (float(x) + 0.5f) / float(step) - 0.5f;
                const float fy = (float(y) + 0.5f) / float(step) - 0.5f;
                const int x0 = int(std::floor(fx)), y0 = int(std::floor(fy));
                const float tx = fx - float(x0), ty = fy - float(y0);
                out.emplace_back(glm::mix(glm::mix(at(x0, y0), at(x0 + 1, y0), tx),
                                          glm::mix(at(x0, y0 + 1), at(x0 + 1, y0 + 1), tx), ty),
                                 1.0f);
            }
    }
}

vec3 PrefilteredSky::at(const vec3& d, int level) const {
    const vec2 q = shLights::domeTexel(d);
    const int x = std::clamp(int(q.x * w), 0, w - 1), y = std::clamp(int(q.y * h), 0, h - 1);
    return vec3(_levels[level][size_t(y) * w + size_t(x)]);
}

} // namespace patina
