// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/graph/graph.h"

namespace patina {

/// A graph as a network of primitive nodes, "node0" and on, each before those that use it. Inputs
/// that equal their definition's defaults are left out. buildGraph() of the result gives the graph
/// back.
Network graphNetwork(const Graph& graph);

} // namespace patina
