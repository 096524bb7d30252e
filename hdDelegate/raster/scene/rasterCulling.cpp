// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/scene/rasterCulling.h"

#include <algorithm>
#include <cmath>

namespace patina {

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

} // namespace patina
