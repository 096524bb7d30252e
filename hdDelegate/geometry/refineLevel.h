// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/geometry/cageFaces.h"

namespace patina {

/// How often to subdivide a mesh: until no edge is longer than the target, at least
/// Mesh::refineLevel, within the level and triangle limits. A refineLevel that the limits cut is
/// reported. Bilinear surfaces of planar faces do not change when subdivided and stay at their
/// refineLevel.
int chooseRefineLevel(const Mesh& mesh, const PointSteps& points, const CageFaces& faces,
                      const TessellationOptions& options, Diagnostics& diagnostics);

} // namespace patina
