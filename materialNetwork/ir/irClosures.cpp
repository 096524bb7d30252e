// SPDX-License-Identifier: Apache-2.0
// Trees of closures of an IrBuilder: which operation reads which, and what each has to know.

#include "materialNetwork/ir/irBuilder.h"

#include "materialNetwork/plan/layering.h"

#include <algorithm>

namespace patina {

std::vector<ClosureOp> IrBuilder::linearOps(int root, std::vector<bool>& needed) {
    std::vector<ClosureOp> ops;
    for (int i = 0; root >= 0 && i <= root; ++i) {
        const PlanClosure& c = _plan.closures[size_t(i)];
        ClosureOp op;
        op.kind = c.kind;
        op.a = c.a;
        op.b = c.b;
        // Parts of other trees stand in the same list; they get no value and are never read.
        const char* name =
            c.kind == ClosureKind::Mix        ? "mix"
            : c.kind == ClosureKind::Multiply ? "in2"
            : c.kind == ClosureKind::UniformEdf || c.kind == ClosureKind::ConicalEdf ||
                    c.kind == ClosureKind::MeasuredEdf
                ? "color"
            : c.kind == ClosureKind::SchlickEdf ? "color0"
            : c.kind == ClosureKind::AbsorptionVdf || c.kind == ClosureKind::AnisotropicVdf
                ? "absorption"
                : nullptr;
        if (name) {
            const Operand& operand = closureInput(_plan, c, name);
            mark(operand, needed);
            op.factor = registerOf(operand);
            if (c.kind == ClosureKind::AnisotropicVdf) {
                const Operand& scattering = closureInput(_plan, c, "scattering");
                const Operand& anisotropy = closureInput(_plan, c, "anisotropy");
                mark(scattering, needed);
                mark(anisotropy, needed);
                op.scattering = registerOf(scattering);
                op.anisotropy = registerOf(anisotropy);
            }
            const auto extra = [&](const char* input) {
                const Operand& o = closureInput(_plan, c, input);
                mark(o, needed);
                return registerOf(o);
            };
            const bool measured = c.kind == ClosureKind::MeasuredEdf;
            if (measured) op.profile = profile(c);
            if ((measured || c.kind == ClosureKind::ConicalEdf) &&
                !isShadingPoints(closureInput(_plan, c, "normal"), "ND_normal_vector3"))
                op.normal = int(extra("normal"));
            if (c.kind == ClosureKind::ConicalEdf) {
                op.first = extra("inner_angle");
                op.second = extra("outer_angle");
            } else if (c.kind == ClosureKind::SchlickEdf) {
                op.first = extra("color90");
                op.second = extra("exponent");
            }
        } else if (c.kind != ClosureKind::Add) {
            op.factor = constant(Value::makeFloat(0.0f));
        }
        ops.push_back(op);
    }
    return ops;
}

std::shared_ptr<const EmissionProfile> IrBuilder::profile(const PlanClosure& closure) {
    const std::string& prim = nodeOf(closure.node).path;
    const Operand& file = closureInput(_plan, closure, "file");
    if (!file.isConstant() || file.value.text.empty()) {
        _diagnostics.warn(prim, "file", messages::noIesFile);
        return nullptr;
    }
    TextureRequest request;
    request.file = file.value.text;
    request.prim = prim;
    request.input = "file";
    return _textures.openProfile(request);
}

void IrBuilder::markTops(std::vector<ClosureOp>& ops) const {
    for (size_t i = ops.size(); i-- > 0;) {
        ClosureOp& op = ops[i];
        if (op.kind == ClosureKind::Layer && op.a >= 0) ops[size_t(op.a)].needsTransmittance = true;
        if (op.needsTransmittance) {
            if (op.a >= 0) ops[size_t(op.a)].needsTransmittance = true;
            if (op.b >= 0) ops[size_t(op.b)].needsTransmittance = true;
        }
    }
}

void IrBuilder::bsdfOps(std::vector<bool>& needed) {
    bool hasInside = false;
    for (int i = 0; i <= _plan.bsdf; ++i)
        hasInside |= !_plan.closures[size_t(i)].thin && refracts(_plan, _plan.closures[size_t(i)]);
    std::vector<bool> reached(_plan.closures.size(), false);
    if (_plan.bsdf >= 0) reached[size_t(_plan.bsdf)] = true;
    for (int i = _plan.bsdf; i >= 0; --i)
        if (reached[size_t(i)])
            for (const int child : {_plan.closures[size_t(i)].a, _plan.closures[size_t(i)].b})
                if (child >= 0) reached[size_t(child)] = true;
    for (int i = 0; i <= _plan.bsdf; ++i) {
        const PlanClosure& c = _plan.closures[size_t(i)];
        ClosureOp op;
        op.kind = c.kind;
        op.a = c.a;
        op.b = c.b;
        if (reached[size_t(i)]) {
            if (c.isLobe()) {
                lobe(c, op, hasInside, needed);
            } else if (c.kind == ClosureKind::Mix || c.kind == ClosureKind::Multiply) {
                const Operand& operand =
                    closureInput(_plan, c, c.kind == ClosureKind::Mix ? "mix" : "in2");
                mark(operand, needed);
                op.factor = registerOf(operand);
            }
        } else {
            op = ClosureOp();
        }
        _ir.bsdf.push_back(op);
    }
    markTops(_ir.bsdf);
    markLobes(_ir.bsdf);
    markLayers(_ir.bsdf);
    markVastTops(_ir.bsdf);
}

/// Light that returns beneath a top is found along every way through the top, and a closure that is
/// shared lies on many: on 2^n of n sums that each add the one before to itself.
void IrBuilder::markVastTops(const std::vector<ClosureOp>& ops) {
    constexpr uint32_t mostWays = 4096;
    std::vector<uint32_t> ways(ops.size(), 1);
    for (size_t i = 0; i < ops.size(); ++i) {
        for (const int part : {ops[i].a, ops[i].b})
            if (part >= 0) ways[i] += ways[size_t(part)];
        ways[i] = std::min(ways[i], mostWays);
        _ir.tooManyReturns |= ops[i].kind == ClosureKind::Layer && ways[i] == mostWays;
    }
    if (_ir.tooManyReturns && chosenMethod(_plan.methods, "layering") != "albedoScaling")
        _diagnostics.warn(_plan.graph.path, "", messages::layersTooMany);
}

void IrBuilder::markLobes(std::vector<ClosureOp>& ops) const {
    for (ClosureOp& op : ops) {
        if (op.lobe >= 0) op.lobes = 1u << op.lobe;
        for (const int part : {op.a, op.b})
            if (part >= 0) op.lobes |= ops[size_t(part)].lobes;
    }
}

void IrBuilder::markLayers(std::vector<ClosureOp>& ops) const {
    const auto walking = layerWalkability(_plan, method::Subsurface::RandomWalk);
    const auto flat = layerWalkability(_plan, method::Subsurface::Diffuse);
    for (size_t i = 0; i < ops.size(); ++i) {
        ClosureOp& op = ops[i];
        if (op.kind != ClosureKind::Layer) continue;
        op.darkensItself = patina::darkensItself(_plan, _plan.closures[i]);
        op.walkable = walking[i].walks;
        op.walkableFlat = flat[i].walks;
    }
}

} // namespace patina
