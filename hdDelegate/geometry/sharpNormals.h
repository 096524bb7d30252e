// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/geometry/drawnFaces.h"

#include <opensubdiv/far/topologyLevel.h>

namespace patina {

/// Whether the surface is sharp somewhere inside (not at its boundary), so that one normal per
/// vertex does not do. Semi-sharp edges whose fillet is narrower than a face count as sharp.
bool hasSharpFeatures(const OpenSubdiv::Far::TopologyLevel& level);

/// Normals of every triangle corner. Where the surface is smooth, it is the vertex normal. At a
/// crease it is the mean over the faces on the same side of the crease, weighted by angle. At a
/// sharp corner it is the face normal.
/// @param vertexNormals pointing out
/// @param flip the positions are those of a left-handed mesh
std::vector<vec3> sharpNormals(const OpenSubdiv::Far::TopologyLevel& level,
                               const DrawnTriangles& drawn, const std::vector<size_t>& firstCorner,
                               const std::vector<vec3>& positions,
                               const std::vector<vec3>& vertexNormals, bool flip);

} // namespace patina
