// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/measure/skyTexture.h"

#include "base/maths.h"
#include "shaders/lights.h"

#include <algorithm>
#include <cmath>

namespace patina::measure {

namespace {

using glm::vec2;
using glm::vec3;

} // namespace

SkyTexture::SkyTexture(int width, int height, std::vector<vec3> texels) {
    _levels.push_back({width, height, std::move(texels)});
    while (_levels.back().width > 1 || _levels.back().height > 1) {
        const Level& fine = _levels.back();
        Level l{std::max(fine.width / 2, 1), std::max(fine.height / 2, 1), {}};
        for (int y = 0; y < l.height; ++y)
            for (int x = 0; x < l.width; ++x) {
                vec3 sum(0.0f);
                for (int k = 0; k < 4; ++k) {
                    const int i = std::min(2 * x + k % 2, fine.width - 1);
                    const int j = std::min(2 * y + k / 2, fine.height - 1);
                    sum += fine.texels[size_t(j) * size_t(fine.width) + size_t(i)];
                }
                l.texels.push_back(0.25f * sum);
            }
        _levels.push_back(std::move(l));
    }
}

vec2 SkyTexture::place(const vec3& d) {
    return shLights::domeTexel(d);
}

vec3 SkyTexture::direction(int x, int y, int width, int height) {
    return shLights::domeDirection(
        vec2((float(x) + 0.5f) / float(width), (float(y) + 0.5f) / float(height)));
}

vec3 SkyTexture::at(vec2 uv, int level) const {
    const Level& l = _levels[size_t(level)];
    const float x = uv.x * float(l.width) - 0.5f, y = uv.y * float(l.height) - 0.5f;
    const float left = std::floor(x), top = std::floor(y);
    const auto texel = [&](int i, int k) {
        return l.texels[size_t(std::clamp(k, 0, l.height - 1)) * size_t(l.width) +
                        size_t((i + l.width) % l.width)];
    };
    const int i = int(left), k = int(top);
    return glm::mix(glm::mix(texel(i, k), texel(i + 1, k), x - left),
                    glm::mix(texel(i, k + 1), texel(i + 1, k + 1), x - left), y - top);
}

vec3 SkyTexture::at(const vec3& direction, float lod) const {
    const vec2 uv = place(direction);
    const float l = std::clamp(lod, 0.0f, float(levels() - 1));
    const int low = int(l);
    const vec3 sharp = at(uv, low);
    return float(low) == l ? sharp : glm::mix(sharp, at(uv, low + 1), l - float(low));
}

} // namespace patina::measure
