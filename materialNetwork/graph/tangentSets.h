// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/graph/graph.h"

#include <string>

namespace patina {

/// Lets every tangent frame of a graph follow the uv set that it is used with.
/// - The frame of a node (a normal map, say) is that of the set which its other inputs are read
///   by, the frame of a lobe that of the set which its normal is read by. Transforms of texture
///   coordinates on the way turn no frame: MaterialX's Tworld is a property of the geometry.
/// - Graph::tangentSet is the set of all that reads none: "st" where textures read it, or nothing,
///   else the set that they read first.
/// - tangent and bitangent with an index above 0 are those of that set.
/// Frames of other sets than tangentSet become nodes that read a primvar, tangentPrimvar().
Graph withTangentSets(const Graph& graph);

} // namespace patina
