// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/geometry/tessellate.h"

#include "hdDelegate/geometry/drawnFaces.h"
#include "hdDelegate/geometry/nurbs.h"
#include "hdDelegate/geometry/refineLevel.h"

namespace patina {

TriangleMesh tessellate(const Mesh& mesh, const TessellationOptions& options,
                        Diagnostics& diagnostics) {
    PointSteps points = resamplePoints(mesh.points, mesh.path, options, diagnostics);
    if (mesh.patch) return drawPatch(mesh, points, options, diagnostics);
    if (points.count() == 0)
        diagnostics.warn(mesh.path, "points", messages::meshWithoutPoints);
    else if (mesh.faceVertexCounts.empty())
        diagnostics.warn(mesh.path, "faceVertexCounts", messages::meshWithoutFaces);
    const CageFaces faces = cageFaces(mesh, points, diagnostics);
    if (mesh.scheme == SubdivisionScheme::None)
        return drawPolygons(mesh, std::move(points), faces, CageNormals::Authored, diagnostics);
    const int level = chooseRefineLevel(mesh, points, faces, options, diagnostics);
    if (level > 0) return drawSubdivided(mesh, std::move(points), faces, level, diagnostics);
    return drawPolygons(mesh, std::move(points), faces,
                        mesh.scheme == SubdivisionScheme::Bilinear ? CageNormals::Flat
                                                                   : CageNormals::Smooth,
                        diagnostics);
}

} // namespace patina
