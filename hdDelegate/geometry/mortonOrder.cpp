// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/geometry/mortonOrder.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace patina {

namespace {

/// The lowest 10 bits with two zeros before each.
uint32_t spread(uint32_t x) {
    x = (x | (x << 16)) & 0x030000ffu;
    x = (x | (x << 8)) & 0x0300f00fu;
    x = (x | (x << 4)) & 0x030c30c3u;
    return (x | (x << 2)) & 0x09249249u;
}

} // namespace

std::vector<uint32_t> mortonOrder(const std::vector<vec3>& points) {
    vec3 low(INFINITY), high(-INFINITY);
    for (const vec3& p : points) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const vec3 scale = 1023.0f / glm::max(high - low, vec3(1e-30f));
    std::vector<uint32_t> codes, order(points.size());
    for (const vec3& p : points) {
        uint32_t code = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const float x = (p[axis] - low[axis]) * scale[axis];
            code |= spread(x > 0.0f ? uint32_t(std::min(x, 1023.0f)) : 0u) << axis;
        }
        codes.push_back(code);
    }
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(),
                     [&](uint32_t a, uint32_t b) { return codes[a] < codes[b]; });
    return order;
}

} // namespace patina
