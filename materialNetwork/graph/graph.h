// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/diagnostics.h"
#include "materialNetwork/nodes/nodeDef.h"

#include <map>
#include <string>
#include <vector>

namespace patina {

/// The source of a graph node's input: the output of an earlier node, or a constant.
struct Operand {
    int node = -1;
    int output = 0;
    Value value; ///< when node is negative; a closure type means "no closure"

    bool isConstant() const { return node < 0; }
};

struct GraphNode {
    const NodeDef* def = nullptr;
    std::string path;            ///< where it comes from, for messages
    std::vector<Operand> inputs; ///< in the order of the definition
    std::vector<bool> authored;  ///< whether each input was given by the network
};

/// A network of primitive nodes, typed and without cycles. Nodes come before the nodes that use
/// them.
struct Graph {
    std::string path; ///< of the material
    std::vector<GraphNode> nodes;
    std::map<std::string, Operand> terminals;
    /// The uv sets that tangents follow, of shading and of displacement; see withTangentSets().
    std::string tangentSet, displacementSet;
};

/// Builds the graph of an expanded network. Unknown nodes, unknown inputs and outputs, type
/// mismatches, missing connections and cycles are reported by prim and input; each such input takes
/// its authored value, or else its default.
Graph buildGraph(const Network& network, Diagnostics& diagnostics);

/// The type of the texture coordinates that a node reads off the surface. Primvars of two
/// components count as such. Unknown for other nodes.
ValueType texcoordType(const GraphNode& node);

/// The constant number of an operand, component i. @returns false when it is not constant
bool constantNumber(const Operand& operand, float& out, int i = 0);

/// Whether all components of a constant operand equal x.
bool isConstantValue(const Operand& operand, float x);

} // namespace patina
