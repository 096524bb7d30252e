// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/graph/graphNetwork.h"

#include "materialNetwork/network/value.h"

namespace patina {

namespace {

std::string nodeName(int node) {
    return "/node" + std::to_string(node);
}

Connection connectionTo(const Graph& graph, const Operand& operand) {
    const NodeDef& def = *graph.nodes[size_t(operand.node)].def;
    const bool named = def.outputs.size() > 1;
    return {nodeName(operand.node), named ? def.outputs[size_t(operand.output)].name : ""};
}

} // namespace

Network graphNetwork(const Graph& graph) {
    Network network;
    network.path = graph.path;
    for (size_t i = 0; i < graph.nodes.size(); ++i) {
        const GraphNode& from = graph.nodes[i];
        NetworkNode node;
        node.path = nodeName(int(i));
        node.id = from.def->id;
        for (size_t k = 0; k < from.inputs.size(); ++k) {
            const InputDef& input = from.def->inputs[k];
            const Operand& operand = from.inputs[k];
            if (!operand.isConstant())
                node.connections[input.name] = connectionTo(graph, operand);
            else if (!isClosureType(input.type) &&
                     (!input.geomprop.empty() || !sameValue(operand.value, input.value)))
                node.inputs[input.name] = operand.value;
        }
        network.nodes.push_back(node);
    }
    for (const auto& terminal : graph.terminals)
        if (!terminal.second.isConstant())
            network.terminals[terminal.first] = connectionTo(graph, terminal.second);
    return network;
}

} // namespace patina
