// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/scene/geometry.h"
#include "base/diagnostics.h"

namespace patina {

/// UsdGeomTetMesh: what is drawn is its surface, as polygons. `faceVertexCounts` and
/// `faceVertexIndices` count for nothing.
struct TetMesh : Mesh {
    std::vector<int> tets;    ///< four points each
    std::vector<int> surface; ///< three points each; empty: the triangles that one tet alone has
};

/// The surface of a mesh of tetrahedra, facing outward as UsdGeomTetMesh says. Uniform primvars and
/// subsets count the triangles of the surface; uniform primvars with a value per tetrahedron give
/// each triangle that of its own. Tetrahedra with points that are not there are left out with a
/// warning.
std::shared_ptr<const Mesh> surfaceOf(const TetMesh& mesh, Diagnostics& diagnostics);

} // namespace patina
