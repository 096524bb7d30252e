// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/geometry/primvarExpand.h"

#include <array>

namespace patina {

/// A face of the coarse mesh that OpenUSD's imaging makes of an implicit prim. Its place (u, v) is
/// 0..1 across; at the tip of a triangle two of the four corners are the same.
struct ShapeFace {
    std::array<int, 4> corners; ///< at (0, 0), (1, 0), (1, 1) and (0, 1): number among all corners
    std::array<int, 4> points;  ///< the same: number of the point
};

/// The faces by which OpenUSD counts an implicit prim's primvars (pxr/imaging/geomUtil): UsdGeom
/// itself gives such prims none.
struct ShapeFaces {
    std::vector<ShapeFace> faces;
    ElementCounts counts;
};

constexpr int shapeFacesAround = 10;
constexpr int sphereFaceRows = 10, capFaceRows = 4; ///< from pole to pole; of half a capsule's end

ShapeFaces facesOf(const Implicit& prim);

/// Whether anything of a prim counts its faces, corners or points: subsets and primvars.
bool countsFaces(const Implicit& prim);

/// Where a corner of a triangle is on the faces.
struct FacePlace {
    int face = 0;
    vec2 at{0.0f};
};

/// Expands a primvar onto triangles that were cut from the faces. Between points values are
/// interpolated linearly along u and v.
/// @param places three per triangle of the mesh
/// @returns false when the primvar cannot be used, after a warning
bool expandOnFaces(const Primvar& primvar, const ShapeFaces& shape, const TriangleMesh& mesh,
                   const std::vector<FacePlace>& places, const std::string& prim,
                   Diagnostics& diagnostics, MeshAttribute& out);

} // namespace patina
