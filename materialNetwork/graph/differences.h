// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/graph/graph.h"

namespace patina {

/// Replaces the nodes that read the neighbourhood of a point. The nodes of their input are copied;
/// the copies read texture coordinates and positions a little further along u and v. Primvars of
/// two components count as texture coordinates.
/// - heighttonormal becomes the slope of its height, from two copies.
/// - blur becomes the mean of 5 x 5 copies. Each lies at a random place (ShadingPoint::seed) in its
///   cell of a square, whose width is `size` in texture coordinates. The cells of `gaussian` are
///   those of a deviation of a fifth of `size`.
Graph insertDifferences(const Graph& graph, Diagnostics& diagnostics);

} // namespace patina
