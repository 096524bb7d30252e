// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/graph/algebra.h"

#include "materialNetwork/network/value.h"

#include <algorithm>
#include <cmath>

namespace patina {

Operand noClosure(ValueType type) {
    Operand operand;
    operand.value.type = type;
    return operand;
}

bool isNone(const Operand& operand) {
    return operand.isConstant() && isClosureType(operand.value.type);
}

namespace {

Operand constantOf(ValueType type, float x) {
    Operand operand;
    operand.value.type = type;
    operand.value.numbers.assign(size_t(valueTypeComponents(type)), x);
    return operand;
}

ValueType typeOf(const Graph& graph, const Operand& operand) {
    return operand.isConstant()
               ? operand.value.type
               : graph.nodes[size_t(operand.node)].def->outputs[size_t(operand.output)].type;
}

/// An operand in the place of a node's output: a constant takes the type of that output.
bool take(const GraphNode& node, const Operand& operand, Operand& out) {
    out = operand;
    if (!out.isConstant()) return true;
    const ValueType type = node.def->outputs[0].type;
    const size_t n = size_t(valueTypeComponents(type));
    if (out.value.numbers.size() == 1)
        out.value.numbers.resize(n, out.value.numbers[0]);
    else if (out.value.numbers.size() > n)
        out.value.numbers.resize(n);
    out.value.type = type;
    return true;
}

bool same(const Operand& a, const Operand& b) {
    if (a.isConstant() != b.isConstant()) return false;
    if (!a.isConstant()) return a.node == b.node && a.output == b.output;
    return a.value.numbers == b.value.numbers && a.value.text == b.value.text;
}

bool choose(const GraphNode& node, bool condition, Operand& out) {
    return take(node, node.inputs[condition ? 2 : 3], out);
}

/// A scalar standing where a tuple is expected still fills its register, so it may be taken for it.
bool rewriteCondition(const GraphNode& node, Operand& out) {
    float a = 0.0f, b = 0.0f;
    if (same(node.inputs[2], node.inputs[3])) return take(node, node.inputs[2], out);
    if (!constantNumber(node.inputs[0], a) || !constantNumber(node.inputs[1], b)) return false;
    switch (node.def->algebra) {
    case Algebra::IfGreater: return choose(node, a > b, out);
    case Algebra::IfGreaterEq: return choose(node, a >= b, out);
    default: return choose(node, a == b, out);
    }
}

bool rewriteSwitch(const GraphNode& node, Operand& out) {
    float which = 0.0f;
    if (!constantNumber(node.inputs.back(), which)) return false;
    which = std::fmax(std::floor(which), 0.0f);
    if (which >= float(node.inputs.size() - 1)) {
        out = constantOf(node.def->outputs[0].type, 0.0f);
        return true;
    }
    return take(node, node.inputs[size_t(which)], out);
}

/// A map whose texel says "straight up" is the normal itself.
bool rewriteNormalMap(const GraphNode& node, Operand& out) {
    const Operand& in = node.inputs[0];
    if (!in.isConstant() || in.value.numbers.size() < 3) return false;
    const std::vector<float>& v = in.value.numbers;
    const bool black = v[0] == 0.0f && v[1] == 0.0f && v[2] == 0.0f;
    const bool up = v[0] == 0.5f && v[1] == 0.5f && v[2] > 0.5f;
    return (black || up) && take(node, node.inputs[2], out);
}

} // namespace

bool foldPattern(const GraphNode& node, std::vector<Value>& outputs) {
    const NodeDef& def = *node.def;
    constexpr size_t maxInputs = 24, maxOutputs = 8, rows = 4; // a matrix takes a register per row
    if (def.inputs.size() > maxInputs || def.outputs.size() > maxOutputs) return false;
    glm::vec4 registers[(maxInputs + maxOutputs) * rows];
    uint16_t inputs[maxInputs];
    size_t count = 0;
    for (size_t i = 0; i < node.inputs.size(); ++i) {
        if (isTextType(def.inputs[i].type)) continue;
        inputs[count] = uint16_t(count * rows);
        valueRows(node.inputs[i].value, registers + count * rows);
        ++count;
    }
    const size_t first = maxInputs * rows;
    PatternData data;
    data.size = std::max(
        1, valueTypeComponents(def.inputs.empty() ? ValueType::Float : def.inputs[0].type));
    const PatternContext context;
    def.pattern->function({registers, inputs, uint16_t(first), data, context});
    for (size_t k = 0; k < def.outputs.size(); ++k) {
        Value value;
        value.type = def.outputs[k].type;
        const int n = valueTypeComponents(value.type);
        if (n < 1) return false;
        const int columns = n == 9 ? 3 : std::min(n, 4);
        for (int c = 0; c < n; ++c)
            value.numbers.push_back(registers[first + k + size_t(c / columns)][c % columns]);
        outputs.push_back(std::move(value));
    }
    return true;
}

bool rewritePattern(const Graph&, const GraphNode& node, Operand& out) {
    const auto& in = node.inputs;
    const ValueType type =
        node.def->outputs.empty() ? ValueType::Unknown : node.def->outputs[0].type;
    switch (node.def->algebra) {
    case Algebra::None: return false;
    case Algebra::Alias:
        out = in[0];
        return !out.isConstant() || valueTypeComponents(type) == 0 ? true : take(node, in[0], out);
    case Algebra::Add:
        if (isConstantValue(in[0], 0.0f)) return take(node, in[1], out);
        return isConstantValue(in[1], 0.0f) && take(node, in[0], out);
    case Algebra::Subtract: return isConstantValue(in[1], 0.0f) && take(node, in[0], out);
    case Algebra::Multiply:
        if (isConstantValue(in[0], 0.0f) || isConstantValue(in[1], 0.0f)) {
            out = constantOf(type, 0.0f);
            return true;
        }
        if (isConstantValue(in[0], 1.0f)) return take(node, in[1], out);
        return isConstantValue(in[1], 1.0f) && take(node, in[0], out);
    case Algebra::Divide: return isConstantValue(in[1], 1.0f) && take(node, in[0], out);
    case Algebra::Mix:
        if (isConstantValue(in[2], 0.0f) || same(in[0], in[1])) return take(node, in[1], out);
        return isConstantValue(in[2], 1.0f) && take(node, in[0], out);
    case Algebra::IfGreater:
    case Algebra::IfGreaterEq:
    case Algebra::IfEqual: return rewriteCondition(node, out);
    case Algebra::Switch: return rewriteSwitch(node, out);
    case Algebra::Rotate: return isConstantValue(in[1], 0.0f) && take(node, in[0], out);
    case Algebra::NormalMap: return rewriteNormalMap(node, out);
    case Algebra::Disperse: {
        const auto none = [](const Operand& x) {
            float value;
            return constantNumber(x, value) && !(value > 0.0f);
        };
        return (none(in[1]) || none(in[2])) && take(node, in[0], out);
    }
    case Algebra::IsUniform: out = constantOf(type, in[0].isConstant() ? 1.0f : 0.0f); return true;
    }
    return false;
}

bool rewriteClosure(const Graph& graph, const GraphNode& node, Operand& out, std::string& reason) {
    const auto& in = node.inputs;
    const ValueType type = node.def->outputs[0].type;
    const auto cut = [&](const char* why) {
        out = noClosure(type);
        reason = std::string(node.def->category) + " left out, " + why;
        return true;
    };
    const auto keep = [&](const Operand& operand, const char* why) {
        out = operand;
        if (out.isConstant()) out = noClosure(type);
        reason = why;
        return true;
    };
    if (isLobe(node.def->closure) || node.def->closure == ClosureKind::Unsupported)
        return !in.empty() && node.def->inputs[0].name == "weight" &&
               isConstantValue(in[0], 0.0f) && cut("weight 0");
    switch (node.def->closure) {
    case ClosureKind::UniformEdf:
    case ClosureKind::ConicalEdf:
    case ClosureKind::MeasuredEdf: return isConstantValue(in[0], 0.0f) && cut("black");
    case ClosureKind::SchlickEdf: return isNone(in[3]) && keep(in[3], "");
    case ClosureKind::AbsorptionVdf: return isConstantValue(in[0], 0.0f) && cut("nothing absorbed");
    case ClosureKind::AnisotropicVdf:
        return isConstantValue(in[0], 0.0f) && isConstantValue(in[1], 0.0f) &&
               cut("nothing absorbed or scattered");
    case ClosureKind::Layer:
        if (isNone(in[0]) && typeOf(graph, in[1]) != ValueType::Vdf)
            return keep(in[1], isNone(in[1]) ? "" : "layer without a top");
        return isNone(in[1]) && keep(in[0], isNone(in[0]) ? "" : "layer without a base");
    case ClosureKind::Mix: {
        if (isNone(in[0]) && isNone(in[1])) return keep(in[0], "");
        if (isConstantValue(in[2], 0.0f))
            return keep(in[1], isNone(in[0]) ? "" : "mix 0: foreground left out");
        if (isConstantValue(in[2], 1.0f))
            return keep(in[0], isNone(in[1]) ? "" : "mix 1: background left out");
        return same(in[0], in[1]) && keep(in[0], "mix of equals");
    }
    case ClosureKind::Add:
        if (isNone(in[0])) return keep(in[1], "");
        return isNone(in[1]) && keep(in[0], "");
    case ClosureKind::ThinSlab: return isNone(in[0]) && keep(in[0], "");
    case ClosureKind::Multiply:
        if (isNone(in[0])) return keep(in[0], "");
        if (isConstantValue(in[1], 0.0f)) return cut("factor 0");
        return isConstantValue(in[1], 1.0f) && keep(in[0], "");
    default: return false;
    }
}

} // namespace patina
