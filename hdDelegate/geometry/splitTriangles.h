// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/geometry/triangleMesh.h"

namespace patina {

/// Cuts every triangle into four at the middles of its edges, again and again until no edge is
/// longer than the target. The surface does not change; values are interpolated linearly.
/// @param targetEdge object units; 0 or less: nothing is cut
/// @param budget of triangles that is not passed
void splitTriangles(TriangleMesh& mesh, float targetEdge, size_t budget);

} // namespace patina
