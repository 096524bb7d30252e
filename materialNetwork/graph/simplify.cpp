// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/graph/simplify.h"

#include "materialNetwork/graph/algebra.h"
#include "materialNetwork/network/value.h"

#include <cmath>
#include <map>

namespace patina {

namespace {

class Simplifier {
public:
    Simplifier(const Graph& graph, std::vector<std::string>& cuts) : _in(graph), _cuts(cuts) {}

    Graph run() {
        _out.path = _in.path;
        _map.resize(_in.nodes.size());
        _reasons.resize(_in.nodes.size());
        for (size_t i = 0; i < _in.nodes.size(); ++i)
            visit(i);
        tellCuts();
        for (const auto& [name, operand] : _in.terminals)
            _out.terminals[name] = mapped(operand);
        return prune();
    }

private:
    Operand mapped(const Operand& operand) const {
        return operand.isConstant() ? operand : _map[size_t(operand.node)][size_t(operand.output)];
    }

    void visit(size_t index) {
        GraphNode node = _in.nodes[index];
        for (Operand& operand : node.inputs)
            operand = mapped(operand);
        std::vector<Operand>& results = _map[index];
        if (fold(node, results)) return;
        Operand replacement;
        std::string reason;
        const bool replaced = node.def->closure == ClosureKind::None
                                  ? rewritePattern(_out, node, replacement)
                                  : rewriteClosure(_out, node, replacement, reason);
        if (replaced) {
            results = {replacement};
            _reasons[index] = std::move(reason);
            return;
        }
        const int merged = add(node);
        for (size_t k = 0; k < node.def->outputs.size(); ++k)
            results.push_back({merged, int(k), {}});
    }

    /// Of a branch that is left out, what is left out in it is not told.
    void tellCuts() {
        std::vector<bool> met(_in.nodes.size(), false);
        const auto meet = [&](const Operand& operand) {
            if (!operand.isConstant()) met[size_t(operand.node)] = true;
        };
        for (const auto& [name, operand] : _in.terminals)
            meet(operand);
        for (size_t i = _in.nodes.size(); i-- > 0;) {
            const GraphNode& node = _in.nodes[i];
            const bool mixes = node.def->closure == ClosureKind::Mix;
            for (size_t k = 0; met[i] && k < node.inputs.size(); ++k)
                if (!mixes || k > 1 || !isConstantValue(mapped(node.inputs[2]), float(k)))
                    meet(node.inputs[k]);
        }
        for (size_t i = 0; i < met.size(); ++i)
            if (met[i] && !_reasons[i].empty())
                _cuts.push_back(_in.nodes[i].path + ": " + _reasons[i]);
    }

    /// Runs the pattern function when all inputs are constants.
    bool fold(const GraphNode& node, std::vector<Operand>& results) const {
        const NodeDef& def = *node.def;
        if (!def.pattern || def.varying || def.algebra == Algebra::IsUniform) return false;
        for (const Operand& operand : node.inputs)
            if (!operand.isConstant()) return false;
        std::vector<Value> values;
        if (!foldPattern(node, values)) return false;
        for (Value& value : values) {
            Operand operand;
            operand.value = std::move(value);
            results.push_back(std::move(operand));
        }
        return true;
    }

    /// Adds a node unless an equal one is there.
    int add(const GraphNode& node) {
        std::string key = node.def->id;
        for (const Operand& operand : node.inputs)
            key += operand.isConstant()
                       ? "|" + exactText(operand.value)
                       : "|#" + std::to_string(operand.node) + "." + std::to_string(operand.output);
        // Authored defaults decide between a fallback and the sign of a missing texture.
        for (const bool a : node.authored)
            key += a ? '1' : '0';
        const auto [it, added] = _known.emplace(std::move(key), int(_out.nodes.size()));
        if (added) _out.nodes.push_back(node);
        return it->second;
    }

    static std::string exactText(const Value& value) {
        std::string text =
            std::to_string(int(value.type)) + ":" + value.text + ":" + value.colorSpace;
        for (const float x : value.numbers) {
            char number[40];
            std::snprintf(number, sizeof number, ",%a", double(x));
            text += number;
        }
        return text;
    }

    Graph prune() const {
        std::vector<bool> used(_out.nodes.size(), false);
        for (const auto& [name, operand] : _out.terminals)
            if (!operand.isConstant()) used[size_t(operand.node)] = true;
        for (size_t i = _out.nodes.size(); i-- > 0;)
            if (used[i])
                for (const Operand& operand : _out.nodes[i].inputs)
                    if (!operand.isConstant()) used[size_t(operand.node)] = true;
        Graph result;
        result.path = _out.path;
        std::vector<int> renumbered(_out.nodes.size(), -1);
        const auto renumber = [&](Operand operand) {
            if (!operand.isConstant()) operand.node = renumbered[size_t(operand.node)];
            return operand;
        };
        for (size_t i = 0; i < _out.nodes.size(); ++i) {
            if (!used[i]) continue;
            GraphNode node = _out.nodes[i];
            for (Operand& operand : node.inputs)
                operand = renumber(operand);
            renumbered[i] = int(result.nodes.size());
            result.nodes.push_back(std::move(node));
        }
        for (const auto& [name, operand] : _out.terminals)
            result.terminals[name] = renumber(operand);
        return result;
    }

    const Graph& _in;
    std::vector<std::string>& _cuts;
    Graph _out;
    std::vector<std::vector<Operand>> _map; ///< per input node and output
    std::vector<std::string> _reasons;      ///< why an input node is left out, or a part of it
    std::map<std::string, int> _known;
};

} // namespace

Graph simplify(const Graph& graph, std::vector<std::string>& cuts) {
    return Simplifier(graph, cuts).run();
}

} // namespace patina
