#pragma once

#include "hdDelegate/scene/tessellate.h"

namespace patina {

/// Any shape as triangles: curves become tubes or ribbons, points spheres or discs.
TriangleMesh rasterTriangles(const Geometry& prim, const TessellationOptions& options,
                             Diagnostics& diagnostics);

} // namespace patina
