// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/geometry/cageFaces.h"
#include "hdDelegate/geometry/primvarExpand.h"

namespace patina {

/// Triangles of a mesh with the face corners that they were cut from.
struct DrawnTriangles {
    std::vector<uvec3> triangles;
    std::vector<size_t> corners; ///< three per triangle: index of the face corner; or none
    std::vector<int> faces;      ///< authored face of each triangle
};

/// Cuts the faces, without holes, into triangles.
/// @param vertices point index of each corner
/// @param flip turns the winding (left-handed prims)
/// @param withCorners whether anybody asks for these: they take twice the memory of the triangles
DrawnTriangles drawFaces(const CageFaces& faces, const std::vector<int>& vertices,
                         const std::vector<vec3>& positions, bool flip, bool withCorners = true);

/// Normals at the points: mean of the normals of the triangles around, weighted by their angle
/// (Thürmer and Wüthrich 1998). Points without a triangle get +z.
std::vector<vec3> smoothNormals(const std::vector<vec3>& positions,
                                const std::vector<uvec3>& triangles);

/// Rearranges values at face corners into values at triangle corners.
/// @param valueIndices value of each face corner; empty when corner i has value i
std::vector<float> gatherCorners(const DrawnTriangles& drawn, const std::vector<float>& values,
                                 const std::vector<int>& valueIndices, int components);

/// Fills triangleSubset and the bounds, which both ways of drawing a mesh share.
void finishMesh(const Mesh& mesh, Diagnostics& diagnostics, TriangleMesh& out);

/// Makes the bounds those of the vertices of all triangles; leaves them where there are none.
void growBounds(TriangleMesh& out);

/// Which subset each element (face, curve or point) is in: 0 none, else i + 1. Empty when the prim
/// has no subsets. Indices out of range are reported; of several subsets the first counts.
std::vector<uint16_t> subsetOfElements(const Geometry& prim, size_t elements,
                                       Diagnostics& diagnostics);

/// Which normals a mesh gets whose polygons are drawn as they are.
enum class CageNormals {
    Authored, ///< polygons: the primvar normals, flat without it
    Smooth,   ///< control cage of a smooth subdivision surface; authored normals are ignored
    Flat      ///< control cage of a bilinear surface; authored normals are ignored
};

/// A mesh whose polygons are drawn as they are.
TriangleMesh drawPolygons(const Mesh& mesh, PointSteps points, const CageFaces& faces,
                          CageNormals normals, Diagnostics& diagnostics);

/// A subdivision surface, refined uniformly and moved to its limit.
/// @param level 1..6
TriangleMesh drawSubdivided(const Mesh& mesh, PointSteps points, const CageFaces& faces, int level,
                            Diagnostics& diagnostics);

} // namespace patina
