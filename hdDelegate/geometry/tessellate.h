// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/geometry/triangleMesh.h"
#include "base/diagnostics.h"

#include <cstdint>

namespace patina {

/// Segments around everything that is round by itself, at most.
inline constexpr int roundSegments = 128;

/// How finely, and when, shapes are drawn.
struct TessellationOptions {
    float shutterOpen = 0.0f, shutterClose = 0.0f; ///< time codes relative to the frame
    /// Points that move get three steps more behind those of the shutter: where they are a frame
    /// before, at the frame, and a frame after.
    bool withMoments = false;
    float targetEdge =
        0.0f; ///< object units: subdivide until no edge is longer; 0: refineLevel only
    float roundEdge = 0.0f; ///< object units: implicit prims take fewer segments, while none is
                            ///< longer; 0: all of them around
    size_t edgeBudget = SIZE_MAX;    ///< targetEdge alone refines to no more triangles than this
    int maxRefineLevel = 6;          ///< 0..6
    size_t triangleBudget = 1000000; ///< a prim is not refined to more triangles than this
};

/// Tessellates a mesh.
///
/// - *Polygons* (scheme `none`) are drawn as they are: concave ones are cut by ear clipping, quads
///   along their shorter diagonal. Authored normals are used; they do not follow when points move.
///   Without normals faces are flat, as UsdGeomMesh says of polygonal meshes.
/// - *Subdivision surfaces* take the smallest level that satisfies targetEdge, but at least
///   Mesh::refineLevel and at most maxRefineLevel and the triangle budget. From level 1 on vertices
///   lie on the limit surface and have its normals (bilinear: flat faces). Level 0 draws the
///   control cage with smooth normals. Authored normals are ignored, as UsdGeomMesh says.
/// - *A NURBS patch* has its vertices and normals on the surface. Each span of knots is cut by
///   itself, like a subdivision surface. Vertex primvars are rational like points. A segment
///   between two knots counts as a face: uniform primvars have a value for each, varying ones a
///   value at each of its corners. A missing primvar `st` is made, 0..1 over the drawn range.
/// - *Primvars*: vertex ones are subdivided like points, varying ones linearly, faceVarying ones by
///   faceVaryingLinearInterpolation, with seams where values differ. Uniform ones stay on their
///   face.
/// - *Bad input* is reported with prim and attribute, and left out: faces with indices out of
///   range, with points that are not finite or with fewer than three vertices; primvars with a
///   wrong number of elements; creases and corners that do not fit the mesh. A topology that
///   OpenSubdiv rejects is drawn as polygons.
TriangleMesh tessellate(const Mesh& mesh, const TessellationOptions& options,
                        Diagnostics& diagnostics);

/// Tessellates an implicit prim with exact normals, hard edges at caps, and an attribute `st`
/// (round sides: once around and from bottom to top; caps and faces of the cube: 0..1 across).
/// Primvars that are not constant, and subsets, count the faces of the coarse mesh that OpenUSD's
/// imaging makes of the prim (implicitFaces.h); the shape stays exact.
/// Sizes that are negative or not finite become 0 with a warning; a prim of size 0 is not drawn.
TriangleMesh tessellate(const Implicit& implicit, const TessellationOptions& options,
                        Diagnostics& diagnostics);

/// By how much fewer segments a round prim takes for TessellationOptions::roundEdge: 1, 2, 4 or 8.
int roundCoarseness(const Implicit& prim, float roundEdge);
/// A roundEdge that gives a prim of this radius so many times fewer segments.
float roundEdgeOf(float radius, int coarser);

/// Prepares curves. Phantom points of pinned curves and wrapped points of periodic ones are added.
/// Widths (diameters) may have any interpolation; without them they are 1, the fallback that
/// OpenUSD's own renderer uses. Curves with a vertex count that their basis cannot use are left out
/// with a warning.
CurveSet buildCurves(const Curves& curves, const TessellationOptions& options,
                     Diagnostics& diagnostics);

/// Prepares points. Widths as for curves. Points that are not finite are left out with a warning.
PointSet buildPoints(const Points& points, const TessellationOptions& options,
                     Diagnostics& diagnostics);

} // namespace patina
