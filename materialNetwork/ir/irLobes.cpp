// SPDX-License-Identifier: Apache-2.0
// Lobes of an IrBuilder: their kind, frame and the registers of their parameters.

#include "materialNetwork/ir/irBuilder.h"

#include "shaders/shaders.h"

namespace patina {

/// A default that comes from the geometry is the shading point's own.
bool IrBuilder::isShadingPoints(const Operand& operand, const char* standard) const {
    if (operand.isConstant()) return false;
    const GraphNode& source = nodeOf(operand.node);
    return source.def->id == standard && source.inputs[0].value.text == "world";
}

int IrBuilder::frame(const PlanClosure& closure, bool flips, std::vector<bool>& needed) {
    FrameTemplate f;
    f.flips = flips;
    // Sheen has a peak of its own, and takes light from its base by the direction of view.
    f.bends = !closure.has(lobe::Diffuse) || closure.has(lobe::Covers);
    const auto choose = [&](const char* input, const char* standard) {
        const GraphNode& node = nodeOf(closure.node);
        const int i = node.def->findInput(input);
        if (i < 0) return -1;
        const Operand& operand = node.inputs[size_t(i)];
        if (isShadingPoints(operand, standard)) return -1;
        mark(operand, needed);
        return int(registerOf(operand));
    };
    f.normal = choose("normal", "ND_normal_vector3");
    f.tangent =
        choose(closure.has(lobe::Fibre) ? "curve_direction" : "tangent", "ND_tangent_vector3");
    auto& frames = _ir.frames;
    for (size_t i = 0; i < frames.size(); ++i)
        if (frames[i].normal == f.normal && frames[i].tangent == f.tangent &&
            frames[i].flips == f.flips && frames[i].bends == f.bends)
            return int(i);
    if (int(frames.size()) >= MaterialIr::maxFrames) {
        _diagnostics.warn(nodeOf(closure.node).path, "normal", messages::normalsTooMany);
        return 0;
    }
    frames.push_back(f);
    return int(frames.size()) - 1;
}

void IrBuilder::lobe(const PlanClosure& closure, ClosureOp& op, bool hasInside,
                     std::vector<bool>& needed) {
    const GraphNode& node = nodeOf(closure.node);
    if (int(_ir.lobes.size()) >= MaterialIr::maxLobes) {
        _diagnostics.warn(node.path, "", messages::lobesTooMany(MaterialIr::maxLobes));
        return;
    }
    LobeTemplate t;
    t.kind = lobeKind(closure.kind);
    t.thin = closure.thin;
    t.diffuse = closure.has(lobe::Diffuse);
    const bool interface = closure.has(lobe::Interface);
    t.sharedInterface = closure.sharedInterface;
    const int flag = node.def->findInput(lobeFlag(t.kind));
    float on = 0.0f;
    t.flagA = flag >= 0 && constantNumber(node.inputs[size_t(flag)], on) && on != 0.0f;
    if (interface) t.mode = scatterMode(_plan, closure);
    t.variant = lobeVariant(_plan, closure);
    t.ndf = microfacetDistribution(_plan, closure);
    t.film = hasFilm(_plan, closure);
    // A film colours the reflectance, for which a dielectric has no room.
    t.filmDielectric = t.film && closure.kind == ClosureKind::Dielectric;
    if (t.filmDielectric) t.kind = LobeKind::Schlick;
    // Metals and diffuse lobes show the same face on both sides; an interface has an inside.
    const bool flips = !interface || !hasInside || closure.thin;
    t.frame = uint8_t(frame(closure, flips, needed));

    // A thin slab has no inside for light to go to. Where a method is forced that does not go there
    // either, textures of the walk are not opened.
    const bool flat = closure.kind == ClosureKind::Subsurface &&
                      !walksBeneath(closure, MethodSet(_plan.methods).get<method::Subsurface>());
    if (flat) t.kind = LobeKind::OrenNayar;
    const std::vector<std::string>& names =
        lobeParameters(flat ? LobeKind::OrenNayar : lobeKind(closure.kind));
    for (size_t i = 0; i < names.size(); ++i) {
        Operand operand;
        operand.value = Value::makeFloat(0.0f);
        const int input = node.def->findInput(names[i]);
        if (input >= 0) operand = node.inputs[size_t(input)];
        // Light goes straight through a thin slab; the layer above has taken what is reflected.
        if (closure.thin && closure.sharedInterface && t.mode == sh::SCATTER_T &&
            closure.kind == ClosureKind::Dielectric && names[i] == "ior") {
            operand = Operand();
            operand.value = Value::makeFloat(1.0f);
        }
        mark(operand, needed);
        t.parameters[i] = registerOf(operand);
    }
    t.passThrough = isPassThrough(closure);
    _ir.hasPassThrough |= t.passThrough;
    Operand weight;
    weight.value = Value::makeFloat(1.0f);
    if (node.def->findInput("weight") >= 0) weight = closureInput(_plan, closure, "weight");
    mark(weight, needed);
    op.factor = t.weight = registerOf(weight);
    op.lobe = int(_ir.lobes.size());
    _ir.lobes.push_back(t);
}

/// Without bending: what a shadow ray may cross.
bool IrBuilder::isPassThrough(const PlanClosure& closure) const {
    const bool dielectric = closure.kind == ClosureKind::Dielectric;
    if (!closure.has(lobe::Interface) || (scatterMode(_plan, closure) & sh::SCATTER_T) == 0 ||
        hasFilm(_plan, closure))
        return false;
    return closure.thin ||
           (dielectric && isConstantValue(closureInput(_plan, closure, "ior"), 1.0f));
}

} // namespace patina
