// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/scene/types.h"

#include <vector>

namespace patina {

/// A box, world space.
struct RasterBox {
    vec3 center{0.0f}, half{0.0f};
    /// The box around a transformed box.
    static RasterBox around(const vec3& low, const vec3& high, const mat4& toWorld);
};

/// The region that a view can show.
class RasterFrustum {
public:
    /// @param clampsNear nothing is outside of the near plane
    explicit RasterFrustum(const mat4& worldToClip, bool clampsNear = false);
    /// True only when nothing in the box can be seen.
    bool misses(const RasterBox& box) const;

private:
    vec4 _planes[6];
};

/// Instances that are drawn in one go.
struct RasterRun {
    int first = 0, count = 0;
};

/// Appends the runs of those of `count` boxes from `first` on that a view may show. Gaps of at most
/// `gap` boxes are drawn, too.
void visibleRuns(const RasterFrustum& frustum, const std::vector<RasterBox>& boxes, int first,
                 int count, int gap, std::vector<RasterRun>& out);

} // namespace patina
