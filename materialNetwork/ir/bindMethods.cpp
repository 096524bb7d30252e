// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/ir/bindMethods.h"

#include "shaders/shaders.h"

#include <algorithm>

namespace patina {

// Lobes take the place of a method for the dialect's constant.
#define PATINA_LOBE_METHOD(Type, Id, name, constant, description)                                  \
    static_assert(int(method::Type::Id) == sh::constant, name);
#include "materialNetwork/plan/choicePoints.inc"

namespace {

int compensation(const MethodSet& methods) {
    switch (methods.get<method::EnergyCompensation>()) {
    case method::EnergyCompensation::None: return sh::COMPENSATE_NONE;
    case method::EnergyCompensation::KullaConty: return sh::COMPENSATE_ADD;
    case method::EnergyCompensation::Turquin:
    case method::EnergyCompensation::RandomWalk: break;
    }
    return sh::COMPENSATE_SCALE;
}

class MethodBinder {
public:
    MethodBinder(MaterialIr& ir, const MethodSet& methods) : _ir(ir), _methods(methods) {}

    void run() {
        _ir.layerTransmittance = _methods.get<method::LayerTransmittance>();
        _ir.slabsHaveTwoFaces = _methods.get<method::ThinWalled>() != method::ThinWalled::Sheet;
        bool changed = false;
        for (LobeTemplate& t : _ir.lobes)
            changed |= bindLobe(t);
        if (changed) leaveOutUnread();
        const method::Layering layering = _methods.get<method::Layering>();
        if (layering != method::Layering::AlbedoScaling && !_ir.tooManyReturns) markReturning();
        if (layering == method::Layering::PositionFree) markWalked();
        setFacts();
    }

private:
    /// @returns whether it reads less
    bool bindLobe(LobeTemplate& t) {
        t.methods = _methods;
        t.compensate = compensation(_methods);
        t.walks =
            _methods.get<method::EnergyCompensation>() == method::EnergyCompensation::RandomWalk;
        const bool flat = t.kind == LobeKind::Subsurface &&
                          _methods.get<method::Subsurface>() == method::Subsurface::Diffuse;
        if (flat) makeDiffuse(t);
        const std::vector<std::string>& names =
            lobeParameters(t.filmDielectric ? LobeKind::Dielectric : t.kind);
        t.constant = std::all_of(t.parameters, t.parameters + names.size(),
                                 [&](Register r) { return size_t(r) < _ir.constants.size(); });
        return flat;
    }

    /// Inputs of the same name, 0 for others.
    void makeDiffuse(LobeTemplate& t) const {
        const LobeTemplate before = t;
        const auto &had = lobeParameters(t.kind), &has = lobeParameters(LobeKind::OrenNayar);
        t.kind = LobeKind::OrenNayar;
        std::fill(std::begin(t.parameters), std::end(t.parameters), _ir.zero);
        for (size_t i = 0; i < has.size(); ++i) {
            const auto found = std::find(had.begin(), had.end(), has[i]);
            if (found != had.end()) t.parameters[i] = before.parameters[found - had.begin()];
        }
    }

    /// Instructions of the surface that nothing reads. An instruction writes the registers from its
    /// output to that of the next one.
    void leaveOutUnread() {
        std::vector<Register> outputs;
        for (const Instruction& i : _ir.surfaceCode)
            outputs.push_back(i.output);
        std::sort(outputs.begin(), outputs.end());
        std::vector<bool> read(size_t(_ir.registerCount), false);
        const auto mark = [&](int r) {
            if (r < int(_ir.constants.size())) return;
            const auto next = std::upper_bound(outputs.begin(), outputs.end(), Register(r));
            if (next != outputs.begin()) read[*(next - 1)] = true;
        };
        for (const LobeTemplate& t : _ir.lobes) {
            mark(t.weight);
            for (size_t i = 0; i < LobeTemplate::maxParameters; ++i)
                mark(t.parameters[i]);
        }
        for (const FrameTemplate& f : _ir.frames) {
            mark(f.normal);
            mark(f.tangent);
        }
        for (const ClosureOp& op : _ir.bsdf)
            mark(op.factor);
        std::vector<Instruction> kept;
        for (size_t i = _ir.surfaceCode.size(); i-- > 0;) {
            const Instruction& instruction = _ir.surfaceCode[i];
            if (!read[instruction.output]) continue;
            for (uint32_t k = 0; k < instruction.inputCount; ++k)
                mark(_ir.inputPool[instruction.firstInput + k]);
            kept.push_back(instruction);
        }
        _ir.surfaceCode.assign(kept.rbegin(), kept.rend());
    }

    void markReturning() {
        std::vector<ClosureOp>& ops = _ir.bsdf;
        for (ClosureOp& op : ops) {
            if (op.kind != ClosureKind::Layer || op.darkensItself) continue;
            for (size_t lobe = 0; lobe < _ir.lobes.size(); ++lobe)
                op.returns |=
                    (ops[size_t(op.a)].lobes >> lobe & 1u) != 0 && isReturning(_ir.lobes[lobe]);
            _ir.returnsLight |= op.returns;
        }
        for (size_t i = ops.size(); i-- > 0;) {
            const ClosureOp& op = ops[i];
            if (op.kind == ClosureKind::Layer) ops[size_t(op.b)].beneath = true;
            if (!op.beneath) continue;
            for (const int part : {op.a, op.b})
                if (part >= 0) ops[size_t(part)].beneath = true;
        }
    }

    /// A walked layer takes a place among the lobes.
    void markWalked() {
        const bool flat = _methods.get<method::Subsurface>() == method::Subsurface::Diffuse;
        for (ClosureOp& op : _ir.bsdf) {
            op.walked = op.kind == ClosureKind::Layer && (flat ? op.walkableFlat : op.walkable) &&
                        _ir.bsdf[size_t(op.a)].lobe >= 0 &&
                        int(_ir.lobes.size()) + _ir.walkedLayers < MaterialIr::maxLobes;
            _ir.walkedLayers += op.walked;
        }
    }

    void setFacts() {
        MaterialFacts& f = _ir.facts;
        f.constant = _ir.surfaceCode.empty();
        f.hasEmission = !_ir.edf.empty();
        f.isOpaque = !_ir.hasPassThrough && _ir.opacityIsOne;
        f.passThroughEnters = f.isVolumeOnly;
        for (const LobeTemplate& t : _ir.lobes) {
            f.hasTransmission |= lobeHas(t.kind, lobe::Transmits) ||
                                 (!t.passThrough && (t.mode & sh::SCATTER_T) != 0);
            f.isFibre |= lobeHas(t.kind, lobe::Fibre);
            f.hasSubsurface |= t.kind == LobeKind::Subsurface;
            f.passThroughEnters |= t.passThrough && !t.thin;
        }
        f.disperses = _methods.get<method::Dispersion>() != method::Dispersion::None &&
                      f.hasTransmission &&
                      std::any_of(_ir.surfaceCode.begin(), _ir.surfaceCode.end(),
                                  [](const Instruction& i) { return i.pattern->spectral(); });
        f.heroWavelengths = _methods.get<method::Dispersion>() == method::Dispersion::Hero;
        f.hasInterior = (!_ir.vdf.empty() || !_ir.volumeEdf.empty()) && !f.isThinWalled &&
                        (f.hasTransmission || f.passThroughEnters);
    }

    MaterialIr& _ir;
    const MethodSet& _methods;
};

} // namespace

MaterialIr bindMethods(MaterialIr unbound, const MethodSet& methods) {
    MethodBinder(unbound, methods).run();
    return unbound;
}

bool isReturning(const LobeTemplate& t) {
    return lobeHas(t.kind, lobe::Interface) && t.mode == sh::SCATTER_R;
}

} // namespace patina
