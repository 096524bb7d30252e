// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/ir/irBuilder.h"

#include "materialNetwork/compileCounts.h"
#include "materialNetwork/network/value.h"

#include <algorithm>
#include <cmath>

namespace patina {

class IrBuilder::Setup : public PatternSetup {
public:
    Setup(IrBuilder& builder, int node) : _b(builder), _index(node) {}

    const Value* constant(const char* input) const override {
        const GraphNode& node = _b.nodeOf(_index);
        const int i = node.def->findInput(input);
        if (i < 0 || !node.inputs[size_t(i)].isConstant()) return nullptr;
        return &node.inputs[size_t(i)].value;
    }
    bool authored(const char* input) const override {
        const GraphNode& node = _b.nodeOf(_index);
        const int i = node.def->findInput(input);
        return i >= 0 && node.authored[size_t(i)];
    }
    int openTexture(const TextureRequest& request) override {
        TextureRequest named = request;
        named.prim = _b.nodeOf(_index).path;
        _b._readsTexture[size_t(_index)] = true;
        return _b._textures.open(named);
    }
    bool textureValid(int handle) const override { return _b._textures.valid(handle); }
    int primvarSlot(const std::string& name, ValueType type) override {
        auto& list = _b._ir.facts.primvars;
        for (size_t i = 0; i < list.size(); ++i)
            if (list[i].name == name) return int(i);
        list.push_back({name, type});
        return int(list.size()) - 1;
    }
    void warn(const char* input, const Message& what) override {
        _b._diagnostics.warn(_b.nodeOf(_index).path, input, what);
    }

private:
    IrBuilder& _b;
    int _index;
};

void IrBuilder::prepareNode(int node) {
    if (_prepared[size_t(node)]) return;
    _prepared[size_t(node)] = true;
    const NodeDef& def = *nodeOf(node).def;
    PatternData& data = _data[size_t(node)];
    data.size = def.inputs.empty() ? 1 : std::max(1, valueTypeComponents(def.inputs[0].type));
    if (def.prepare) {
        Setup setup(*this, node);
        def.prepare(setup, data);
    }
    if (def.category == "move_texcoord" || def.category == "move_position")
        _ir.facts.jitters = true;
    if (def.category == "texcoord" || _readsTexture[size_t(node)]) _ir.facts.usesUv = true;
}

Register IrBuilder::allocate(int count) {
    if (_ir.registerCount + count > 60000) {
        _overflow = true;
        return 0;
    }
    const int first = _ir.registerCount;
    _ir.registerCount += count;
    return Register(first);
}

bool IrBuilder::NanLast::operator()(const std::vector<float>& a,
                                    const std::vector<float>& b) const {
    return std::lexicographical_compare(
        a.begin(), a.end(), b.begin(), b.end(),
        [](float x, float y) { return x < y || (std::isnan(y) && !std::isnan(x)); });
}

/// Constants take the first registers, so all of them are made before the first instruction.
Register IrBuilder::constant(const Value& value) {
    std::vector<float> key = value.numbers;
    if (key.empty()) key.push_back(0.0f);
    if (key.size() == 1) key.resize(4, key[0]);
    if (key.size() < 4) key.resize(4, 0.0f);
    const auto known = _constants.find(key);
    if (known != _constants.end()) return known->second;
    const size_t first = _ir.constants.size(), count = (key.size() + 3) / 4;
    if (first + count > 30000) {
        _overflow = true;
        return 0;
    }
    const Register r = Register(first);
    Value rows;
    rows.numbers = key;
    _ir.constants.resize(first + count);
    valueRows(rows, &_ir.constants[r]);
    _constants.emplace(std::move(key), r);
    return r;
}

Register IrBuilder::registerOf(const Operand& operand) {
    if (operand.isConstant()) return constant(operand.value);
    return Register(_register[size_t(operand.node)] + operand.output);
}

void IrBuilder::mark(const Operand& operand, std::vector<bool>& needed) const {
    if (!operand.isConstant()) needed[size_t(operand.node)] = true;
}

void IrBuilder::emit(const std::vector<bool>& roots, std::vector<Instruction>& code) {
    std::vector<bool> needed = roots;
    for (size_t i = needed.size(); i-- > 0;)
        if (needed[i])
            for (const Operand& operand : nodeOf(int(i)).inputs)
                mark(operand, needed);
    for (size_t i = 0; i < needed.size(); ++i) {
        const GraphNode& node = nodeOf(int(i));
        if (!needed[i] || !node.def->pattern) continue;
        prepareNode(int(i));
        Instruction instruction;
        instruction.pattern = node.def->pattern;
        instruction.function = node.def->pattern->function;
        instruction.output = Register(_register[i]);
        instruction.firstInput = uint32_t(_ir.inputPool.size());
        instruction.data = _data[i];
        for (size_t k = 0; k < node.inputs.size(); ++k)
            if (!isTextType(node.def->inputs[k].type))
                _ir.inputPool.push_back(registerOf(node.inputs[k]));
        instruction.inputCount = uint16_t(_ir.inputPool.size() - instruction.firstInput);
        code.push_back(instruction);
    }
}

MaterialIr compileIr(const Plan& plan, TextureSource& textures, Diagnostics& diagnostics) {
    ++compileCounts().irs;
    return IrBuilder(plan, textures, diagnostics).build();
}

MaterialIr IrBuilder::build() {
    const size_t n = _plan.graph.nodes.size();
    _ir.textures = &_textures;
    _data.resize(n);
    _prepared.resize(n, false);
    _readsTexture.resize(n, false);
    _register.resize(n, 0);

    // Constants stand first. How many there will be is not known yet, so every constant of the
    // graph gets its register now.
    for (size_t i = 0; i < n; ++i)
        for (const Operand& operand : nodeOf(int(i)).inputs)
            if (operand.isConstant()) constant(operand.value);
    constant(_plan.opacity.value);
    _ir.zero = constant(Value::makeFloat(0.0f));
    constant(Value::makeFloat(1.0f));
    _ir.registerCount = int(_ir.constants.size());
    for (size_t i = 0; i < n; ++i)
        if (nodeOf(int(i)).def->pattern) {
            int count = 0;
            for (const OutputDef& output : nodeOf(int(i)).def->outputs)
                count += registerCount(output.type);
            _register[i] = allocate(count);
        }
    if (_overflow) {
        _diagnostics.warn(_plan.graph.path, "", messages::materialTooLarge);
        Plan empty;
        empty.opacity.value = Value::makeFloat(1.0f);
        return IrBuilder(empty, _textures, _diagnostics).build();
    }

    std::vector<bool> surface(n, false), emission(n, false), interior(n, false), opacity(n, false);
    bsdfOps(surface);
    _ir.edf = linearOps(_plan.edf, emission);
    _ir.vdf = linearOps(_plan.vdf, interior);
    _ir.volumeEdf = linearOps(_plan.volumeEdf, interior);
    mark(_plan.opacity, opacity);
    _ir.opacity = registerOf(_plan.opacity);
    emit(surface, _ir.surfaceCode);
    emit(emission, _ir.emissionCode);
    emit(interior, _ir.interiorCode);
    emit(opacity, _ir.opacityCode);

    if (_plan.displacementNode >= 0) {
        const GraphNode& node = nodeOf(_plan.displacementNode);
        std::vector<bool> needed(n, false);
        const auto read = [&](const char* name) {
            const Operand& operand = node.inputs[size_t(node.def->findInput(name))];
            mark(operand, needed);
            return registerOf(operand);
        };
        _ir.displacement = read("displacement");
        _ir.displacementScale = read("scale");
        _ir.displacementIsVector =
            node.def->inputs[size_t(node.def->findInput("displacement"))].type == ValueType::Vec3;
        emit(needed, _ir.displacementCode);
        _ir.facts.hasDisplacement = true;
    }

    _ir.opacityFromPrimvars = !_ir.opacityCode.empty();
    for (const Instruction& instruction : _ir.opacityCode)
        for (size_t i = 0; i < n; ++i)
            if (nodeOf(int(i)).def->pattern && nodeOf(int(i)).def->varying &&
                instruction.output == _register[i])
                _ir.opacityFromPrimvars &=
                    _data[i].slot >= 0 || nodeOf(int(i)).def->category == "UsdPrimvarReader";
    _ir.opacityIsOne = _plan.opacity.isConstant() && !_plan.opacity.value.numbers.empty() &&
                       _plan.opacity.value.numbers[0] >= 1.0f;
    _ir.facts.tangentSet = _plan.graph.tangentSet;
    _ir.facts.displacementSet = _plan.graph.displacementSet;
    _ir.facts.isThinWalled = _plan.thinWalled;
    _ir.facts.isVolumeOnly = _plan.volumeOnly;
    return std::move(_ir);
}

} // namespace patina
