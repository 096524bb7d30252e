#pragma once

#include "materialNetwork/graph.h"

namespace patina {

/// Replaces the nodes that look at the neighbourhood of a point. What makes their input is copied,
/// reading texture coordinates and positions a little further along u and v; primvars of two
/// components are taken for texture coordinates.
/// - heighttonormal becomes the slope of its height, from two copies;
/// - blur becomes the mean of 5 x 5 copies over a square whose width is `size` in texture
///   coordinates; `gaussian` weights them by a deviation of a fifth of `size`.
Graph insertDifferences(const Graph& graph, Diagnostics& diagnostics);

} // namespace patina
