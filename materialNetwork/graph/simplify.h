// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/graph/graph.h"

#include <string>
#include <vector>

namespace patina {

/// Rewrites a graph without changing what it means: constants are folded by running the pattern
/// functions, neutral operations and choices between constants are removed, closures of weight 0
/// and layers or mixes with nothing left in one half collapse, equal nodes are merged, and what no
/// terminal reaches is dropped.
/// @param cuts gets one line for each closure or choice that was removed
Graph simplify(const Graph& graph, std::vector<std::string>& cuts);

} // namespace patina
