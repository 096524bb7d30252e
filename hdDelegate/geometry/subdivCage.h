// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/geometry/cageFaces.h"

#include <memory>
#include <opensubdiv/far/topologyRefiner.h>

namespace patina {

/// The control cage of a subdivision surface in the form that OpenSubdiv takes: only faces that it
/// can use, only points that those faces use.
struct SubdivCage {
    std::vector<int> counts;
    std::vector<int> vertices;        ///< per corner, into points
    std::vector<size_t> corners;      ///< authored corner of each corner
    std::vector<int> authoredFace;    ///< per face
    std::vector<int> points;          ///< authored point of each vertex
    std::vector<int> holes;           ///< faces
    std::vector<int> creaseEdges;     ///< pairs of vertices
    std::vector<float> creaseWeights; ///< per pair
    std::vector<int> cornerVertices;
    std::vector<float> cornerWeights;
    bool allTriangles = true;
};

/// A face-varying primvar: values, and which of them each corner of the cage has. Corners that meet
/// in a point share a value when theirs are equal, which is where the primvar has no seam.
struct FaceVaryingChannel {
    std::vector<int> indices;
    std::vector<float> values;
    int components = 1;
};

/// Collects the cage, its creases and corners. Input that OpenSubdiv cannot use is reported and
/// left out: faces that use a point twice or have more than 65535 corners, creases and corners
/// whose arrays do not fit each other or name missing points.
SubdivCage makeSubdivCage(const Mesh& mesh, const CageFaces& faces, size_t pointCount,
                          Diagnostics& diagnostics);

/// Merges the values of corners at each point: those of one index (UsdGeomPrimvar: indices define
/// seams), without indices equal ones.
/// @param values one per authored corner
/// @param indices likewise, or none
FaceVaryingChannel mergeCornerValues(const SubdivCage& cage, const std::vector<float>& values,
                                     int components, const std::vector<int>& indices);

/// Refines the cage uniformly, with full topology in the last level.
/// @returns null, after a warning, when OpenSubdiv rejects the topology
std::unique_ptr<OpenSubdiv::Far::TopologyRefiner>
refineTopology(const Mesh& mesh, const SubdivCage& cage,
               const std::vector<FaceVaryingChannel>& channels, int level,
               Diagnostics& diagnostics);

} // namespace patina
