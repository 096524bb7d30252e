// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/graph/graph.h"

#include <string>
#include <vector>

namespace patina {

/// Rewrites a graph without changing its meaning:
/// - Constants are folded by running the pattern functions.
/// - Neutral operations, and choices between constants, are removed.
/// - Closures of weight 0 collapse, and so do layers and mixes with one empty half.
/// - Equal nodes are merged.
/// - Nodes that no terminal reaches are dropped.
///
/// @param cuts gets one line for each closure or choice that was removed
Graph simplify(const Graph& graph, std::vector<std::string>& cuts);

} // namespace patina
