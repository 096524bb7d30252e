// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/plan/dump.h"

#include "materialNetwork/network/value.h"

#include <algorithm>

namespace patina {

namespace {

std::string connectionText(const Connection& c) {
    return "<" + c.node + (c.output.empty() ? "" : "." + c.output) + ">";
}

std::string operandText(const Graph& graph, const Operand& operand) {
    if (operand.isConstant()) return valueText(operand.value);
    const NodeDef& def = *graph.nodes[size_t(operand.node)].def;
    std::string text = "%" + std::to_string(operand.node);
    if (def.outputs.size() > 1) text += "." + def.outputs[size_t(operand.output)].name;
    return text;
}

std::string nodeText(const Graph& graph, const GraphNode& node) {
    std::string text = node.def->id + "(";
    bool first = true;
    for (size_t i = 0; i < node.inputs.size(); ++i) {
        const InputDef& def = node.def->inputs[i];
        const Operand& operand = node.inputs[i];
        const bool standard =
            operand.isConstant()
                ? sameValue(operand.value, def.value) && def.geomprop.empty()
                : !def.geomprop.empty() &&
                      graph.nodes[size_t(operand.node)].path == "<" + def.geomprop + ">";
        if (standard) continue;
        text += (first ? "" : ", ") + def.name + ": " + operandText(graph, operand);
        first = false;
    }
    return text + ")";
}

class PlanText {
public:
    explicit PlanText(const Plan& plan)
        : _plan(plan), _lobe(plan.closures.size(), -1), _transmittance(plan.closures.size()) {}

    std::string run() {
        std::string text = "material " + _plan.graph.path + "\n";
        text += "presence " + operandText(_plan.graph, _plan.opacity) + "\n";
        if (_plan.thinWalled) text += "thin walled\n";
        for (size_t i = 0; i < _plan.graph.nodes.size(); ++i)
            if (_plan.graph.nodes[i].def->closure == ClosureKind::None)
                text += "pattern %" + std::to_string(i) + " = " +
                        nodeText(_plan.graph, _plan.graph.nodes[i]) + "\n";
        if (_plan.displacementNode >= 0)
            text += "displacement " +
                    nodeText(_plan.graph, _plan.graph.nodes[size_t(_plan.displacementNode)]) + "\n";
        int lobes = 0;
        for (size_t i = 0; i < _plan.closures.size(); ++i)
            if (_plan.closures[i].isLobe()) _lobe[i] = lobes++;
        text += section(_plan.bsdf, "lobe");
        text += section(_plan.edf, "emission");
        text += section(_plan.vdf, "interior");
        text += section(_plan.volumeEdf, "interior emission");
        if (_plan.volumeOnly) text += "no surface\n";
        for (const std::string& line : _plan.leftOut)
            text += "left out: " + line + "\n";
        for (const std::string& point : choicesThatMatter(_plan))
            text += choiceText(point, chosenMethod(_plan.methods, point));
        return text;
    }

private:
    static std::string choiceText(const std::string& point, const std::string& method) {
        for (const ChoicePoint& choice : choicePoints())
            if (choice.name == point)
                for (const Method& m : choice.methods)
                    if (m.name == method)
                        return "method " + point + " = " + method + ": " + m.description + "\n";
        return "";
    }

    /// Leaves below a root with their weights.
    std::string section(int root, const std::string& title) {
        if (root < 0) return "";
        std::vector<std::string> weights(_plan.closures.size());
        weights[size_t(root)] = "1";
        std::string text;
        std::vector<std::string> lines;
        for (int i = root; i >= 0; --i) {
            const std::string weight = weights[size_t(i)];
            if (weight.empty()) continue;
            const PlanClosure& c = _plan.closures[size_t(i)];
            if (c.a < 0 && c.b < 0)
                lines.push_back(leafText(i, title, weight));
            else
                distribute(c, weight, weights);
        }
        std::reverse(lines.begin(), lines.end());
        for (const std::string& line : lines)
            text += line;
        return text;
    }

    std::string leafText(int i, const std::string& title, const std::string& weight) const {
        const PlanClosure& c = _plan.closures[size_t(i)];
        const GraphNode& node = _plan.graph.nodes[size_t(c.node)];
        std::string text = title;
        if (_lobe[size_t(i)] >= 0) text += " " + std::to_string(_lobe[size_t(i)]);
        text += ": " + nodeText(_plan.graph, node) +
                (c.sharedInterface ? " shared interface" : "") +
                (c.thin && !_plan.thinWalled ? " thin walled" : "");
        return text + " * " + weight + "\n";
    }

    static std::string product(const std::string& a, const std::string& b) {
        if (a == "1") return b;
        return b == "1" ? a : a + " * " + b;
    }

    static void accumulate(std::string& sum, const std::string& term) {
        sum = sum.empty() ? term : "(" + sum + " + " + term + ")";
        // Shared closures can multiply without end.
        if (sum.size() > 1000) sum = "...";
    }

    void distribute(const PlanClosure& c, const std::string& weight,
                    std::vector<std::string>& weights) const {
        const GraphNode& node = _plan.graph.nodes[size_t(c.node)];
        const auto give = [&](int child, const std::string& factor) {
            if (child >= 0) accumulate(weights[size_t(child)], product(weight, factor));
        };
        switch (c.kind) {
        case ClosureKind::Layer:
            give(c.a, "1");
            give(c.b, transmittance(c.a));
            break;
        case ClosureKind::Mix: {
            const std::string m = operandText(_plan.graph, node.inputs[2]);
            give(c.a, m);
            give(c.b, "(1 - " + m + ")");
            break;
        }
        case ClosureKind::Multiply: give(c.a, operandText(_plan.graph, node.inputs[1])); break;
        default: give(c.a, "1"); give(c.b, "1");
        }
    }

    /// Transmittance of a layer's top.
    std::string transmittance(int i) const {
        if (i < 0) return "1";
        std::string& text = _transmittance[size_t(i)];
        if (text.empty()) text = transmittanceText(i);
        if (text.size() > 300) text = "...";
        return text;
    }

    std::string transmittanceText(int i) const {
        const PlanClosure& c = _plan.closures[size_t(i)];
        const GraphNode& node = _plan.graph.nodes[size_t(c.node)];
        if (c.isLobe()) {
            const std::string weight = node.def->inputs[0].name == "weight"
                                           ? operandText(_plan.graph, node.inputs[0])
                                           : "1";
            const std::string e = "E" + std::to_string(_lobe[size_t(i)]);
            return "(1 - " + (c.has(lobe::Covers) ? product(weight, e) : weight) + ")";
        }
        switch (c.kind) {
        case ClosureKind::Layer: return product(transmittance(c.a), transmittance(c.b));
        case ClosureKind::Mix:
            return "mix(" + transmittance(c.a) + ", " + transmittance(c.b) + ", " +
                   operandText(_plan.graph, node.inputs[2]) + ")";
        case ClosureKind::Multiply:
            return "(1 - " + operandText(_plan.graph, node.inputs[1]) + " * (1 - " +
                   transmittance(c.a) + "))";
        default: return "(" + transmittance(c.a) + " + " + transmittance(c.b) + " - 1)";
        }
    }

    const Plan& _plan;
    std::vector<int> _lobe;
    mutable std::vector<std::string> _transmittance; ///< per closure; empty until asked for
};

} // namespace

std::string dumpNetwork(const Network& network) {
    std::string text = "network " + network.path + "\n";
    for (const auto& [name, c] : network.terminals)
        text += name + " = " + connectionText(c) + "\n";
    std::vector<const NetworkNode*> nodes;
    for (const NetworkNode& node : network.nodes)
        nodes.push_back(&node);
    std::sort(nodes.begin(), nodes.end(),
              [](const NetworkNode* a, const NetworkNode* b) { return a->path < b->path; });
    for (const NetworkNode* node : nodes) {
        text += node->path + " " + node->id + "\n";
        for (const auto& [name, value] : node->inputs)
            text += "    " + std::string(valueTypeName(value.type)) + " " + name + " = " +
                    valueText(value) +
                    (value.colorSpace.empty() || value.numbers.empty()
                         ? ""
                         : " [" + value.colorSpace + "]") +
                    "\n";
        for (const auto& [name, c] : node->connections)
            text += "    " + name + " = " + connectionText(c) + "\n";
    }
    return text;
}

std::string dumpGraph(const Graph& graph) {
    std::string text = "graph " + graph.path + "\n";
    for (size_t i = 0; i < graph.nodes.size(); ++i)
        text += "%" + std::to_string(i) + " = " + nodeText(graph, graph.nodes[i]) + "\n";
    for (const auto& [name, operand] : graph.terminals)
        text += name + " = " + operandText(graph, operand) + "\n";
    return text;
}

std::string dumpPlan(const Plan& plan) {
    return PlanText(plan).run();
}

} // namespace patina
