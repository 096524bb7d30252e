// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/graph/tangentSets.h"

#include "materialNetwork/shadingPoint.h"
#include "materialNetwork/nodes/nodeTable.h"

#include <map>
#include <utility>

namespace patina {

namespace {

bool isTangent(const GraphNode& node) {
    return node.def->category == "tangent" || node.def->category == "bitangent";
}

int indexOf(const GraphNode& node) {
    const int input = node.def->findInput("index");
    float index = 0.0f;
    if (input >= 0) constantNumber(node.inputs[size_t(input)], index);
    return index > 0.0f ? int(index) : 0;
}

/// The set that a node reads off the surface itself, or nothing.
std::string readBy(const GraphNode& node) {
    if (texcoordType(node) == ValueType::Unknown) return {};
    if (node.def->category == "texcoord") return texcoordPrimvar(indexOf(node));
    for (const char* input : {"varname", "geomprop"}) {
        const int i = node.def->findInput(input);
        if (i >= 0 && node.inputs[size_t(i)].isConstant()) return node.inputs[size_t(i)].value.text;
    }
    return {};
}

class Assigner {
public:
    explicit Assigner(const Graph& graph) : _in(graph), _sets(graph.nodes.size()) {}

    Graph run() {
        findSets();
        Graph out = _in;
        out.tangentSet = mainSet();
        for (GraphNode& node : out.nodes) {
            const std::string set = setOfFrame(node);
            for (Operand& operand : node.inputs)
                replace(operand, set, out.tangentSet);
        }
        for (auto& terminal : out.terminals)
            replace(terminal.second, {}, out.tangentSet);
        const auto displacement = _in.terminals.find("displacement");
        out.displacementSet =
            displacement == _in.terminals.end() ? std::string() : setOf(displacement->second);
        if (out.displacementSet.empty()) out.displacementSet = out.tangentSet;
        return _made.empty() ? out : withFrames(std::move(out));
    }

private:
    const std::string& setOf(const Operand& operand) const {
        static const std::string none;
        return operand.isConstant() ? none : _sets[size_t(operand.node)];
    }

    static int texcoordInput(const GraphNode& node) {
        const int i = node.def->findInput("texcoord");
        return i >= 0 ? i : node.def->findInput("st");
    }

    void findSets() {
        for (size_t i = 0; i < _in.nodes.size(); ++i) {
            const GraphNode& node = _in.nodes[i];
            const int texcoord = texcoordInput(node);
            _sets[i] = readBy(node);
            if (texcoord >= 0 && !node.inputs[size_t(texcoord)].isConstant())
                _sets[i] = setOf(node.inputs[size_t(texcoord)]);
            else
                for (size_t k = 0; k < node.inputs.size() && _sets[i].empty(); ++k)
                    _sets[i] = setOf(node.inputs[k]);
        }
    }

    std::string mainSet() const {
        std::string first;
        for (const GraphNode& node : _in.nodes) {
            const int texcoord = texcoordInput(node);
            if (texcoord < 0) continue;
            const std::string& set = setOf(node.inputs[size_t(texcoord)]);
            if (set == texcoordPrimvar(0)) return set;
            if (first.empty()) first = set;
        }
        return first.empty() ? texcoordPrimvar(0) : first;
    }

    /// The set by which a node wants its tangents; nothing where any will do.
    std::string setOfFrame(const GraphNode& node) const {
        if (isClosure(node)) {
            const int normal = node.def->findInput("normal");
            return normal >= 0 ? setOf(node.inputs[size_t(normal)]) : std::string();
        }
        for (const Operand& operand : node.inputs)
            if (!setOf(operand).empty()) return setOf(operand);
        return {};
    }
    static bool isClosure(const GraphNode& node) { return !node.def->pattern; }

    /// Where an operand is a tangent of another set than the shading point's, reads it by a node.
    void replace(Operand& operand, const std::string& wanted, const std::string& main) {
        if (operand.isConstant() || !isTangent(_in.nodes[size_t(operand.node)])) return;
        const int index = indexOf(_in.nodes[size_t(operand.node)]);
        const std::string set = index > 0 ? texcoordPrimvar(index) : wanted;
        if (set.empty() || set == main) return;
        const std::pair<int, std::string> key(operand.node, set);
        const auto made = _made.emplace(key, int(_made.size()));
        operand.node = -2 - made.first->second; // until its place is known
    }

    /// Puts the new nodes first, which read no others.
    Graph withFrames(Graph graph) const {
        const int count = int(_made.size());
        std::vector<GraphNode> nodes(_made.size());
        for (const auto& [key, place] : _made) {
            const GraphNode& source = _in.nodes[size_t(key.first)];
            GraphNode& node = nodes[size_t(place)];
            node.def = NodeTable::get().find(
                source.def->category == "tangent" ? "PatinaSetTangent" : "PatinaSetBitangent");
            node.path = source.path;
            Operand set;
            set.value = Value::makeString(key.second);
            node.inputs = {source.inputs[size_t(source.def->findInput("space"))], set};
            node.authored = {true, true};
        }
        const auto moved = [&](Operand& operand) {
            if (operand.node <= -2)
                operand.node = -2 - operand.node;
            else if (operand.node >= 0)
                operand.node += count;
        };
        for (GraphNode& node : graph.nodes) {
            for (Operand& operand : node.inputs)
                moved(operand);
            nodes.push_back(std::move(node));
        }
        for (auto& terminal : graph.terminals)
            moved(terminal.second);
        graph.nodes = std::move(nodes);
        return graph;
    }

    const Graph& _in;
    std::vector<std::string> _sets;                   ///< by which a node is read, each
    std::map<std::pair<int, std::string>, int> _made; ///< by tangent node and set
};

} // namespace

Graph withTangentSets(const Graph& graph) {
    return Assigner(graph).run();
}

} // namespace patina
