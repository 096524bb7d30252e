#pragma once

#include "materialNetwork/cpu/materialProgram.h"
#include "materialNetwork/cpu/programCode.h"

#include <map>

namespace patina {

/// Turns a Plan into a MaterialProgram.
class ProgramBuilder {
public:
    ProgramBuilder(const Plan& plan, TextureSource& textures, Diagnostics& diagnostics)
        : _plan(plan), _textures(textures), _diagnostics(diagnostics) {}

    std::shared_ptr<const MaterialProgram> build();

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
    void markLobes(std::vector<ClosureOp>& ops) const;
    void markReturning(std::vector<ClosureOp>& ops) const;
    void markWalked(std::vector<ClosureOp>& ops) const;
    bool isPassThrough(const PlanClosure& closure) const;
    void setFlags();

    const GraphNode& nodeOf(int node) const { return _plan.graph.nodes[size_t(node)]; }

    const Plan& _plan;
    TextureSource& _textures;
    Diagnostics& _diagnostics;
    std::shared_ptr<MaterialProgram> _program;
    ProgramCode* _code = nullptr;
    std::vector<PatternData> _data;  ///< per graph node
    std::vector<bool> _prepared;     ///< per graph node
    std::vector<bool> _readsTexture; ///< per graph node
    std::vector<int> _register;      ///< of the first output, per graph node; -1 when none
    std::map<std::vector<float>, Register> _constants;
    bool _overflow = false;
};

} // namespace patina
