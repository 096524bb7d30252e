#pragma once

#include "materialNetwork/graph.h"

namespace patina {

/// Replaces every heighttonormal node whose height varies by the slope of that height: the nodes
/// that make it are copied twice, reading texture coordinates and positions a little further along
/// u and v, and so are those of its texture coordinates. Primvars of two components are taken for texture coordinates.
Graph insertDifferences(const Graph& graph);

} // namespace patina
