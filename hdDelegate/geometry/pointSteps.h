// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/geometry/tessellate.h"

namespace patina {

/// Points of a prim at the steps of the shutter.
struct PointSteps {
    std::vector<std::vector<vec3>> steps; ///< at least one; all equally long and finite
    std::vector<uint8_t> bad; ///< per point: it was not finite at some step and is now the origin;
                              ///< empty when none was

    size_t count() const { return steps.front().size(); }
    bool isBad(size_t point) const { return !bad.empty() && bad[point]; }
};

/// Evaluates points linearly at uniform steps over the shutter, and at the moments. Samples whose
/// number of points differs from that of the sample nearest to time 0 are left out with a warning,
/// since the topology holds there.
PointSteps resamplePoints(const Sampled<std::vector<vec3>>& points, const std::string& prim,
                          const TessellationOptions& options, Diagnostics& diagnostics);

} // namespace patina
