// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/ir/materialIr.h"
#include "materialNetwork/plan/plan.h"
#include "materialNetwork/textureSource.h"

#include <map>

namespace patina {

/// Compiles a plan. Never fails: what cannot be compiled is reported and left out. No method of the
/// plan counts but those that decide what the graph means (reflectionOverTransmission, thinWalled).
/// @param textures must outlive the IR
MaterialIr compileIr(const Plan& plan, TextureSource& textures, Diagnostics& diagnostics);

/// Turns a Plan into a MaterialIr.
class IrBuilder {
public:
    IrBuilder(const Plan& plan, TextureSource& textures, Diagnostics& diagnostics)
        : _plan(plan), _textures(textures), _diagnostics(diagnostics) {}

    MaterialIr build();

private:
    class Setup;

    void prepareNode(int node);
    void mark(const Operand& operand, std::vector<bool>& needed) const;
    void emit(const std::vector<bool>& needed, std::vector<Instruction>& code);
    Register registerOf(const Operand& operand);
    Register constant(const Value& value);
    Register allocate(int count);
    std::vector<ClosureOp> linearOps(int root, std::vector<bool>& needed);
    std::shared_ptr<const EmissionProfile> profile(const PlanClosure& closure);
    void bsdfOps(std::vector<bool>& needed);
    void lobe(const PlanClosure& closure, ClosureOp& op, bool hasInside, std::vector<bool>& needed);
    bool isShadingPoints(const Operand& operand, const char* standard) const;
    int frame(const PlanClosure& closure, bool flips, std::vector<bool>& needed);
    void markTops(std::vector<ClosureOp>& ops) const;
    void markVastTops(const std::vector<ClosureOp>& ops);
    void markLobes(std::vector<ClosureOp>& ops) const;
    void markLayers(std::vector<ClosureOp>& ops) const;
    bool isPassThrough(const PlanClosure& closure) const;

    const GraphNode& nodeOf(int node) const { return _plan.graph.nodes[size_t(node)]; }

    const Plan& _plan;
    TextureSource& _textures;
    Diagnostics& _diagnostics;
    MaterialIr _ir;
    std::vector<PatternData> _data;  ///< per graph node
    std::vector<bool> _prepared;     ///< per graph node
    std::vector<bool> _readsTexture; ///< per graph node
    std::vector<int> _register;      ///< of the first output, per graph node; -1 when none
    /// A NaN is neither less nor more than a number, and would pass for any of them.
    struct NanLast {
        bool operator()(const std::vector<float>& a, const std::vector<float>& b) const;
    };
    std::map<std::vector<float>, Register, NanLast> _constants;
    bool _overflow = false;
};

} // namespace patina
