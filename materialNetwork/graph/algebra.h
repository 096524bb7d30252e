// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/graph/graph.h"

#include <string>
#include <vector>

namespace patina {

/// The absence of a closure, as an input.
Operand noClosure(ValueType type);
bool isNone(const Operand& operand);

/// Runs a pattern whose inputs are all constants. @returns false when it has strings or matrices
bool foldPattern(const GraphNode& node, std::vector<Value>& outputs);

/// Replaces a pattern by one of its operands or a constant. Operands refer to nodes of graph.
bool rewritePattern(const Graph& graph, const GraphNode& node, Operand& out);

/// Replaces a closure by one of its operands or by no closure at all.
/// @param reason gets what was cut, for the reader of the plan; stays empty for plain renaming
bool rewriteClosure(const Graph& graph, const GraphNode& node, Operand& out, std::string& reason);

} // namespace patina
