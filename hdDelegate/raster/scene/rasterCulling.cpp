// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/scene/rasterCulling.h"

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

RasterBox RasterBox::around(const vec3& low, const vec3& high, const mat4& toWorld) {
    RasterBox box;
    const vec3 half = 0.5f * (high - low);
    box.center = vec3(toWorld * vec4(0.5f * (low + high), 1.0f));
    for (int i = 0; i < 3; ++i)
        box.half += glm::abs(vec3(toWorld[i])) * half[i];
    return box;
}

RasterFrustum::RasterFrustum(const mat4& m, bool clampsNear) {
    for (int axis = 0; axis < 3; ++axis)
        for (int side = 0; side < 2; ++side)
            for (int c = 0; c < 4; ++c)
                _planes[2 * axis + side][c] = m[c][3] + (side ? -m[c][axis] : m[c][axis]);
    if (clampsNear) _planes[4] = vec4(0.0f, 0.0f, 0.0f, 1.0f);
}

bool RasterFrustum::misses(const RasterBox& box) const {
    for (const vec4& plane : _planes) {
        const vec3 n(plane);
        const float reach = glm::dot(glm::abs(n), box.half);
        const float at = glm::dot(n, box.center);
        // The slack is far above what rounding in the vertex stage moves.
        const float slack =
            1e-4f * (reach + glm::dot(glm::abs(n), glm::abs(box.center)) + std::fabs(plane.w));
        if (at + plane.w + reach + slack < 0.0f) return true; // false of what is not a number
    }
    return false;
}

void visibleRuns(const RasterFrustum& frustum, const std::vector<RasterBox>& boxes, int first,
                 int count, int gap, std::vector<RasterRun>& out) {
    const size_t before = out.size();
    for (int i = first; i < first + count; ++i) {
        if (frustum.misses(boxes[size_t(i)])) continue;
        if (out.size() > before && i - (out.back().first + out.back().count) <= gap)
            out.back().count = i + 1 - out.back().first;
        else
            out.push_back({i, 1});
    }
}

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
