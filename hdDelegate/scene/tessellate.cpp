#include "hdDelegate/scene/tessellate.h"

#include "hdDelegate/scene/drawnFaces.h"

namespace patina {

TriangleMesh tessellate(const Mesh &mesh, const TessellationOptions &options,
                        Diagnostics &diagnostics) {
    PointSteps points = resamplePoints(mesh.points, mesh.path, options, diagnostics);
    if (points.count() == 0)
        diagnostics.warn(mesh.path, "points", "the mesh has none and is not drawn");
    const CageFaces faces = cageFaces(mesh, points, diagnostics);
    return drawPolygons(mesh, std::move(points), faces, false, diagnostics);
}

} // namespace patina
