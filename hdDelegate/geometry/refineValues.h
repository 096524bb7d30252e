// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opensubdiv/far/topologyRefiner.h>

#include <vector>

namespace patina {

/// How values follow the subdivision.
enum class RefineMode { Vertex, Varying, FaceVarying };

/// Values at the last level of a uniform refinement.
/// @param base values of the cage, `components` floats each
/// @param channel of face-varying values
/// @returns values of the last level; vertex and face-varying ones on the limit surface
std::vector<float> refineValues(const OpenSubdiv::Far::TopologyRefiner& refiner,
                                std::vector<float> base, int components, RefineMode mode,
                                int channel = 0);

/// Limit positions and two limit tangents, whose cross product points out of the face.
struct LimitPoints {
    std::vector<float> positions, tangents1, tangents2; ///< three floats each
};
LimitPoints refinePoints(const OpenSubdiv::Far::TopologyRefiner& refiner, std::vector<float> base);

} // namespace patina
