// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/geometry/pointSteps.h"

namespace patina {

/// The faces of a mesh that can be drawn. Corner k of face f stands at firstCorner[f] + k in
/// Mesh::faceVertexIndices and in faceVarying primvars.
struct CageFaces {
    std::vector<int> counts;
    std::vector<size_t> firstCorner;
    std::vector<int> authored; ///< index of the authored face
    std::vector<uint8_t> hole; ///< per face; empty when there are none
    size_t authoredFaces = 0;
    size_t authoredCorners = 0; ///< length of faceVertexIndices

    size_t size() const { return counts.size(); }
    bool isHole(size_t face) const { return !hole.empty() && hole[face]; }
};

/// Sorts out the faces of a mesh. Each kind of fault is one warning with the number of faces and
/// the first of them.
CageFaces cageFaces(const Mesh& mesh, const PointSteps& points, Diagnostics& diagnostics);

} // namespace patina
