// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/geometry/triangleMesh.h"
#include "materialNetwork/cpu/materialProgram.h"

#include <memory>
#include <vector>

namespace patina {

/// Moves the vertices of a mesh by the displacement of its materials, and gives it new normals.
/// - Vertices at the same place move together, by the mean over the corners that meet there. So
///   neither seams of texture coordinates, nor material borders, nor hard edges tear open.
/// - The new normal of a corner is the mean over the faces around its vertex that had the same
///   normal before, weighted by angle. Smooth stays smooth, hard edges stay hard.
/// - When the mesh moves, every time step is displaced by the amounts of the first.
/// - Distances are object units. Patterns see object space as object space, and `objectToWorld`
///   times it as world space.
/// @param materials [0] the prim's, [i + 1] that of subset i; null ones displace nothing
void displace(TriangleMesh& mesh,
              const std::vector<std::shared_ptr<const MaterialProgram>>& materials,
              const mat4& objectToWorld);

} // namespace patina
