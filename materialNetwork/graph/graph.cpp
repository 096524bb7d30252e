// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/graph/graph.h"

#include "materialNetwork/graph/differences.h"
#include "materialNetwork/network/geomprop.h"
#include "materialNetwork/nodes/nodeTable.h"
#include "materialNetwork/nodes/notDrawn.h"
#include "materialNetwork/network/value.h"
#include "base/limits.h"

#include <algorithm>
#include <vector>

namespace patina {

namespace {

// The builder follows connections by recursion.
int maxChain() {
    return int(limitOf(Limit::chain));
}
// What was built before makes a chain longer; conversions stand between its nodes.
int maxHeight() {
    return 3 * maxChain();
}

class GraphBuilder {
public:
    GraphBuilder(const Network& network, Diagnostics& diagnostics)
        : _network(network), _diagnostics(diagnostics) {
        for (const NetworkNode& node : network.nodes)
            _source.emplace(node.path, &node);
    }

    Graph run() {
        _graph.path = _network.path;
        for (const auto& [name, c] : _network.terminals) {
            if (c.node.empty()) continue;
            Operand operand;
            std::optional<Message> problem;
            if (follow(c, "the terminal is ignored", operand, problem))
                _graph.terminals[name] = operand;
            else
                _diagnostics.warn(_network.path, name, *problem);
        }
        return insertDifferences(_graph, _diagnostics);
    }

private:
    static constexpr int inProgress = -2;
    static constexpr int unusable = -3;

    /// Reports a problem of an input. The "dot" of a model's input is named "node.input".
    void warn(const std::string& path, const std::string& input, const Message& what) {
        const size_t slash = path.rfind('/');
        const size_t point = path.find('.', slash == std::string::npos ? 0 : slash);
        if (point != std::string::npos && input == "in")
            _diagnostics.warn(path.substr(0, point), path.substr(point + 1), what);
        else
            _diagnostics.warn(path, input, what);
    }

    /// @param used what is taken where there is a problem, in words
    bool follow(const Connection& c, const char* used, Operand& out,
                std::optional<Message>& problem) {
        const int node = build(c.node, used, problem);
        if (node < 0) return false;
        if (heightOf(node) > maxHeight()) {
            problem = messages::chainTooLong(limitText(Limit::chain), used);
            return false;
        }
        const NodeDef& def = *_graph.nodes[size_t(node)].def;
        const int output = def.findOutput(c.output);
        if (output < 0) {
            problem = messages::sourceWithoutOutput(c.node, def.category, c.output, used);
            return false;
        }
        out.node = node;
        out.output = output;
        return true;
    }

    int build(const std::string& path, const char* used, std::optional<Message>& problem) {
        const auto known = _built.find(path);
        if (known != _built.end()) {
            if (known->second == inProgress)
                problem = messages::sourceCycle(path, used);
            else if (known->second == unusable)
                problem = messages::sourceUnusable(path, used);
            return known->second;
        }
        const auto source = _source.find(path);
        if (source == _source.end()) {
            problem =
                path.empty() ? messages::sourceUnnamed(used) : messages::sourceMissing(path, used);
            return unusable;
        }
        const NetworkNode& node = *source->second;
        const NodeDef* def = NodeTable::get().find(node.id);
        if (!def) {
            const char* reason = whyNotDrawn(node.id);
            problem = reason ? messages::nodeNotDrawn(path, node.id, reason, used)
                             : messages::nodeTypeUnknown(path, node.id, used);
            _built[path] = unusable;
            return unusable;
        }
        if (_depth > maxChain()) {
            problem = messages::chainTooLong(limitText(Limit::chain), used);
            return unusable;
        }
        _built[path] = inProgress;
        ++_depth;
        const int index = addNode(node, *def);
        --_depth;
        _built[path] = index;
        return index;
    }

    /// The longest way from a node to one without connected inputs.
    int heightOf(int node) {
        for (size_t i = _heights.size(); i <= size_t(node); ++i) {
            int height = 0;
            for (const Operand& input : _graph.nodes[i].inputs)
                if (!input.isConstant())
                    height = std::max(height, 1 + _heights[size_t(input.node)]);
            _heights.push_back(height);
        }
        return _heights[size_t(node)];
    }

    int addNode(const NetworkNode& node, const NodeDef& def) {
        GraphNode result;
        result.def = &def;
        result.path = node.path;
        for (const InputDef& input : def.inputs) {
            bool authored = false;
            result.inputs.push_back(buildInput(node, input, authored));
            result.authored.push_back(authored);
        }
        const auto check = [&](const std::string& input) {
            if (def.findInput(input) < 0) warn(node.path, input, messages::inputMissing(def.id));
        };
        for (const auto& [input, value] : node.inputs)
            check(input);
        for (const auto& [input, c] : node.connections)
            if (!node.inputs.count(input)) check(input);
        _graph.nodes.push_back(std::move(result));
        return int(_graph.nodes.size()) - 1;
    }

    Operand buildInput(const NetworkNode& node, const InputDef& input, bool& authored) {
        Operand operand;
        const auto c = node.connections.find(input.name);
        if (c != node.connections.end()) {
            // The dot of a model's input carries the model's default as its value.
            const char* used = node.inputs.count(input.name) > 0
                                   ? "its own value or default is used"
                                   : "the default is used";
            std::optional<Message> problem;
            if (follow(c->second, used, operand, problem)) {
                if (convert(operand, input.type, node.path)) {
                    authored = true;
                    return operand;
                }
                problem = messages::sourceTypeDiffers(outputTypeName(operand),
                                                      valueTypeName(input.type), used);
            }
            warn(node.path, input.name, *problem);
        }
        operand = Operand();
        const auto v = node.inputs.find(input.name);
        if (v != node.inputs.end()) {
            std::optional<Message> problem;
            authored = coerceValue(v->second, input, operand.value, problem);
            if (problem) warn(node.path, input.name, *problem);
            if (authored) return operand;
        }
        if (!input.geomprop.empty()) return geomprop(input);
        operand.value = input.value;
        return operand;
    }

    const char* outputTypeName(const Operand& operand) const {
        return valueTypeName(
            _graph.nodes[size_t(operand.node)].def->outputs[size_t(operand.output)].type);
    }

    /// Inserts a conversion where the register cannot be read as it is.
    bool convert(Operand& operand, ValueType to, const std::string& path) {
        const ValueType from =
            _graph.nodes[size_t(operand.node)].def->outputs[size_t(operand.output)].type;
        const Coercion c = coercion(from, to);
        if (c == Coercion::None) return false;
        if (c == Coercion::Free) return true;
        GraphNode node;
        node.def = NodeTable::get().find(c == Coercion::AppendOne ? "ND_convert_vector3_vector4"
                                                                  : "ND_convert_vector2_vector3");
        node.path = path;
        node.inputs = {operand};
        node.authored = {true};
        _graph.nodes.push_back(std::move(node));
        operand = {int(_graph.nodes.size()) - 1, 0, {}};
        return true;
    }

    /// A default that comes from the geometry is the output of a node.
    Operand geomprop(const InputDef& input) {
        Operand operand;
        operand.value = input.value;
        const NetworkNode node = geompropNode(input.geomprop);
        if (node.id.empty()) return operand;
        const auto known = _built.find(node.path);
        const int index =
            known != _built.end() ? known->second : addNode(node, *NodeTable::get().find(node.id));
        _built[node.path] = index;
        return {index, 0, {}};
    }

    const Network& _network;
    Diagnostics& _diagnostics;
    std::map<std::string, const NetworkNode*> _source;
    std::map<std::string, int> _built;
    int _depth = 0;
    std::vector<int> _heights; ///< of the first nodes of the graph
    Graph _graph;
};

} // namespace

Graph buildGraph(const Network& network, Diagnostics& diagnostics) {
    return GraphBuilder(network, diagnostics).run();
}

ValueType texcoordType(const GraphNode& node) {
    const std::string& category = node.def->category;
    const ValueType out =
        node.def->outputs.empty() ? ValueType::Unknown : node.def->outputs[0].type;
    const bool texcoord = category == "texcoord";
    const bool reads = texcoord || category == "geompropvalue" || category == "UsdPrimvarReader";
    return reads && (out == ValueType::Vec2 || (texcoord && out == ValueType::Vec3))
               ? out
               : ValueType::Unknown;
}

bool constantNumber(const Operand& operand, float& out, int i) {
    if (!operand.isConstant() || int(operand.value.numbers.size()) <= i) return false;
    out = operand.value.numbers[size_t(i)];
    return true;
}

bool isConstantValue(const Operand& operand, float x) {
    if (!operand.isConstant() || operand.value.numbers.empty()) return false;
    for (const float n : operand.value.numbers)
        if (n != x) return false;
    return true;
}

} // namespace patina
