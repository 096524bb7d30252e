#include "materialNetwork/cpu/programBuilder.h"

#include "materialNetwork/cpu/lobeSetup.h"
#include "materialNetwork/layering.h"
#include "materialNetwork/value.h"

#include <algorithm>
#include <cmath>

namespace patina {

class ProgramBuilder::Setup : public PatternSetup {
public:
    Setup(ProgramBuilder& builder, int node) : _b(builder), _index(node) {}

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
        auto& list = _b._program->_primvars;
        for (size_t i = 0; i < list.size(); ++i)
            if (list[i].name == name) return int(i);
        list.push_back({name, type});
        return int(list.size()) - 1;
    }
    void warn(const char* input, const std::string& message) override {
        _b._diagnostics.warn(_b.nodeOf(_index).path, input, message);
    }

private:
    ProgramBuilder& _b;
    int _index;
};

void ProgramBuilder::prepareNode(int node) {
    if (_prepared[size_t(node)]) return;
    _prepared[size_t(node)] = true;
    const NodeDef& def = *nodeOf(node).def;
    PatternData& data = _data[size_t(node)];
    data.size = def.inputs.empty() ? 1 : std::max(1, valueTypeComponents(def.inputs[0].type));
    if (def.prepare) {
        Setup setup(*this, node);
        def.prepare(setup, data);
    }
    if (def.category == "texcoord" || _readsTexture[size_t(node)]) _program->_usesUv = true;
}

Register ProgramBuilder::allocate(int count) {
    if (_code->registerCount + count > 60000) {
        _overflow = true;
        return 0;
    }
    const int first = _code->registerCount;
    _code->registerCount += count;
    return Register(first);
}

/// Constants take the first registers, so all of them are made before the first instruction.
Register ProgramBuilder::constant(const Value& value) {
    std::vector<float> key = value.numbers;
    if (key.empty()) key.push_back(0.0f);
    if (key.size() == 1) key.resize(4, key[0]);
    if (key.size() < 4) key.resize(4, 0.0f);
    const auto known = _constants.find(key);
    if (known != _constants.end()) return known->second;
    if (_constants.size() >= 30000) {
        _overflow = true;
        return 0;
    }
    const Register r = Register(_code->constants.size());
    Value rows;
    rows.numbers = key;
    _code->constants.resize(size_t(r) + (key.size() + 3) / 4);
    valueRows(rows, &_code->constants[r]);
    _constants.emplace(std::move(key), r);
    return r;
}

Register ProgramBuilder::registerOf(const Operand& operand) {
    if (operand.isConstant()) return constant(operand.value);
    return Register(_register[size_t(operand.node)] + operand.output);
}

void ProgramBuilder::mark(const Operand& operand, std::vector<bool>& needed) const {
    if (!operand.isConstant()) needed[size_t(operand.node)] = true;
}

void ProgramBuilder::emit(const std::vector<bool>& roots, std::vector<Instruction>& code) {
    std::vector<bool> needed = roots;
    for (size_t i = needed.size(); i-- > 0;)
        if (needed[i])
            for (const Operand& operand : nodeOf(int(i)).inputs)
                mark(operand, needed);
    for (size_t i = 0; i < needed.size(); ++i) {
        const GraphNode& node = nodeOf(int(i));
        if (!needed[i] || !node.def->function) continue;
        prepareNode(int(i));
        Instruction instruction;
        instruction.function = node.def->function;
        instruction.output = Register(_register[i]);
        instruction.firstInput = uint32_t(_code->inputPool.size());
        instruction.data = _data[i];
        for (const Operand& operand : node.inputs)
            _code->inputPool.push_back(registerOf(operand));
        code.push_back(instruction);
    }
}

std::vector<ClosureOp> ProgramBuilder::linearOps(int root, std::vector<bool>& needed) {
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

std::shared_ptr<const EmissionProfile> ProgramBuilder::profile(const PlanClosure& closure) {
    const std::string& prim = nodeOf(closure.node).path;
    const Operand& file = closureInput(_plan, closure, "file");
    if (!file.isConstant() || file.value.text.empty()) {
        _diagnostics.warn(prim, "file", "names no IES file; it emits the same everywhere");
        return nullptr;
    }
    TextureRequest request;
    request.file = file.value.text;
    request.prim = prim;
    request.input = "file";
    return _textures.openProfile(request);
}

void ProgramBuilder::markTops(std::vector<ClosureOp>& ops) const {
    for (size_t i = ops.size(); i-- > 0;) {
        ClosureOp& op = ops[i];
        if (op.kind == ClosureKind::Layer && op.a >= 0) ops[size_t(op.a)].needsPassed = true;
        if (op.needsPassed) {
            if (op.a >= 0) ops[size_t(op.a)].needsPassed = true;
            if (op.b >= 0) ops[size_t(op.b)].needsPassed = true;
        }
    }
}

void ProgramBuilder::bsdfOps(std::vector<bool>& needed) {
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
        _code->bsdf.push_back(op);
    }
    markTops(_code->bsdf);
    markLobes(_code->bsdf);
    if (chosenMethod(_plan.methods, "layering") == "positionFree") markWalked(_code->bsdf);
}

void ProgramBuilder::markLobes(std::vector<ClosureOp>& ops) const {
    for (ClosureOp& op : ops) {
        if (op.lobe >= 0) op.lobes = 1u << op.lobe;
        for (const int part : {op.a, op.b})
            if (part >= 0) op.lobes |= ops[size_t(part)].lobes;
    }
}

/// A walked layer takes a place among the lobes.
void ProgramBuilder::markWalked(std::vector<ClosureOp>& ops) const {
    const std::vector<LayerWalkability> layers = layerWalkability(_plan);
    for (size_t i = 0; i < ops.size(); ++i) {
        ClosureOp& op = ops[i];
        op.walked = op.kind == ClosureKind::Layer && layers[i].walks &&
                    ops[size_t(op.a)].lobe >= 0 &&
                    int(_code->lobes.size()) + _code->walkedLayers < Bsdf::maxLobes;
        _code->walkedLayers += op.walked;
    }
}

/// A default that comes from the geometry is the shading point's own.
bool ProgramBuilder::isShadingPoints(const Operand& operand, const char* standard) const {
    if (operand.isConstant()) return false;
    const GraphNode& source = nodeOf(operand.node);
    return source.def->id == standard && source.inputs[0].value.text == "world";
}

int ProgramBuilder::frame(const PlanClosure& closure, bool flips, std::vector<bool>& needed) {
    FrameTemplate f;
    f.flips = flips;
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
    f.tangent = choose(closure.kind == ClosureKind::ChiangHair ? "curve_direction" : "tangent",
                       "ND_tangent_vector3");
    auto& frames = _code->frames;
    for (size_t i = 0; i < frames.size(); ++i)
        if (frames[i].normal == f.normal && frames[i].tangent == f.tangent &&
            frames[i].flips == f.flips)
            return int(i);
    if (int(frames.size()) >= Bsdf::maxFrames) {
        _diagnostics.warn(nodeOf(closure.node).path, "normal",
                          "the material has too many different normals; the first is used");
        return 0;
    }
    frames.push_back(f);
    return int(frames.size()) - 1;
}

void ProgramBuilder::lobe(const PlanClosure& closure, ClosureOp& op, bool hasInside,
                          std::vector<bool>& needed) {
    const GraphNode& node = nodeOf(closure.node);
    if (int(_code->lobes.size()) >= Bsdf::maxLobes) {
        _diagnostics.warn(node.path, "",
                          "the material has more than " + std::to_string(Bsdf::maxLobes) +
                              " lobes; this one is left out");
        return;
    }
    LobeTemplate t;
    t.prebuilt.kind = lobeKind(closure.kind);
    t.thin = closure.thin;
    t.prebuilt.diffuse =
        closure.kind == ClosureKind::OrenNayar || closure.kind == ClosureKind::Burley ||
        closure.kind == ClosureKind::Subsurface || closure.kind == ClosureKind::Translucent ||
        closure.kind == ClosureKind::Sheen;
    const bool interface =
        closure.kind == ClosureKind::Dielectric || closure.kind == ClosureKind::Schlick;
    t.fused = closure.fused;
    const std::string compensation = chosenMethod(_plan.methods, "energyCompensation");
    t.compensate = compensation == "none"         ? sh::COMPENSATE_NONE
                   : compensation == "kullaConty" ? sh::COMPENSATE_ADD
                                                  : sh::COMPENSATE_SCALE;
    t.walks = compensation == "randomWalk";
    t.albedo = chosenIndex(_plan.methods, "directionalAlbedo");
    t.sampling = chosenIndex(_plan.methods, "sampling");
    t.fresnel = chosenIndex(_plan.methods, "fresnel");
    t.filmMethod = chosenIndex(_plan.methods, "thinFilm");
    t.sheenAlbedo = chosenIndex(_plan.methods, "sheen");
    t.diffuse = DiffuseModel(chosenIndex(_plan.methods, "diffuse"));
    const auto flag = [&](const char* input) {
        float x = 0.0f;
        return node.def->findInput(input) >= 0 &&
               constantNumber(closureInput(_plan, closure, input), x) && x != 0.0f;
    };
    t.flagA =
        flag(closure.kind == ClosureKind::OrenNayar ? "energy_compensation" : "retroreflective");
    if (interface) t.mode = scatterMode(_plan, closure);
    t.variant = lobeVariant(_plan, closure);
    t.facets = facetDistribution(_plan, closure);
    t.film = hasFilm(_plan, closure);
    // A film colours the reflectance, for which a dielectric has no room.
    t.filmDielectric = t.film && closure.kind == ClosureKind::Dielectric;
    if (t.filmDielectric) t.prebuilt.kind = LobeKind::Schlick;
    // Metals and diffuse lobes show the same face on both sides; an interface has an inside.
    const bool flips = !interface || !hasInside || closure.thin;
    t.prebuilt.frame = uint8_t(frame(closure, flips, needed));
    t.prebuilt.weight = t.prebuilt.albedo = glm::vec3(0.0f);
    t.prebuilt.probability = 0.0f;

    t.constant = true;
    const bool flat = closure.kind == ClosureKind::Subsurface && !walksBeneath(_plan, closure);
    if (flat) t.prebuilt.kind = LobeKind::OrenNayar;
    const char* const* names = lobeParameters(flat ? ClosureKind::OrenNayar : closure.kind);
    for (int i = 0; names[i]; ++i) {
        Operand operand;
        operand.value = Value::makeFloat(0.0f);
        if (node.def->findInput(names[i]) >= 0) operand = closureInput(_plan, closure, names[i]);
        // Light goes straight through a thin wall; the layer above has taken what is reflected.
        if (closure.thin && closure.fused && t.mode == sh::SCATTER_T &&
            closure.kind == ClosureKind::Dielectric && std::string(names[i]) == "ior") {
            operand = Operand();
            operand.value = Value::makeFloat(1.0f);
        }
        mark(operand, needed);
        t.constant &= operand.isConstant();
        t.parameters[i] = registerOf(operand);
    }
    t.straight = isStraight(closure);
    _code->hasStraight |= t.straight;
    if (t.constant) {
        setupLobe(t, _code->constants.data(), t.prebuilt);
        t.energy.measure(t.prebuilt);
    }
    Operand weight;
    weight.value = Value::makeFloat(1.0f);
    if (node.def->findInput("weight") >= 0) weight = closureInput(_plan, closure, "weight");
    mark(weight, needed);
    op.factor = t.weight = registerOf(weight);
    op.lobe = int(_code->lobes.size());
    _code->lobes.push_back(t);
}

/// Without bending: what a shadow ray may cross.
bool ProgramBuilder::isStraight(const PlanClosure& closure) const {
    const bool dielectric = closure.kind == ClosureKind::Dielectric;
    if ((!dielectric && closure.kind != ClosureKind::Schlick) ||
        (scatterMode(_plan, closure) & sh::SCATTER_T) == 0 || hasFilm(_plan, closure))
        return false;
    return closure.thin ||
           (dielectric && isConstantValue(closureInput(_plan, closure, "ior"), 1.0f));
}

void ProgramBuilder::setFlags() {
    MaterialProgram& p = *_program;
    p._planned = _plan.planned;
    p._constant = _code->surfaceCode.empty();
    p._isThinWalled = _plan.thinWalled;
    p._hasEmission = !_code->edf.empty();
    p._isOpaque = !_code->hasStraight && _plan.opacity.isConstant() &&
                  !_plan.opacity.value.numbers.empty() && _plan.opacity.value.numbers[0] >= 1.0f;
    for (const LobeTemplate& t : _code->lobes)
        p._hasTransmission |= t.prebuilt.kind == LobeKind::Translucent ||
                              t.prebuilt.kind == LobeKind::ChiangHair ||
                              (!t.straight && (t.mode & sh::SCATTER_T) != 0);
    p._isVolumeOnly = _plan.volumeOnly;
    for (const LobeTemplate& t : _code->lobes)
        p._isFibre |= t.prebuilt.kind == LobeKind::ChiangHair;
    for (const LobeTemplate& t : _code->lobes)
        p._hasSubsurface |= t.prebuilt.kind == LobeKind::Subsurface;
    p._passingEnters = _plan.volumeOnly;
    for (const LobeTemplate& t : _code->lobes)
        p._passingEnters |= t.straight && !t.thin;
    p._hasInterior = (!_code->vdf.empty() || !_code->volumeEdf.empty()) && !_plan.thinWalled &&
                     (p._hasTransmission || p._passingEnters);
}

std::shared_ptr<const MaterialProgram> ProgramBuilder::build() {
    const size_t n = _plan.graph.nodes.size();
    _program = std::shared_ptr<MaterialProgram>(new MaterialProgram());
    _program->_code = std::make_unique<ProgramCode>();
    _code = _program->_code.get();
    _code->textures = &_textures;
    const auto chosen = [&](const char* point, const char* method) {
        return chosenMethod(_plan.methods, point) == method;
    };
    _code->layerTransmittance =
        chosen("layerTransmittance", "average")  ? LayerTransmittance::Average
        : chosen("layerTransmittance", "tinted") ? LayerTransmittance::Tinted
                                                 : LayerTransmittance::Largest;
    _code->wallsHaveTwoFaces = !chosen("thinWalled", "sheet");
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
    constant(Value::makeFloat(0.0f));
    constant(Value::makeFloat(1.0f));
    _code->registerCount = int(_code->constants.size());
    for (size_t i = 0; i < n; ++i)
        if (nodeOf(int(i)).def->function) {
            int count = 0;
            for (const OutputDef& output : nodeOf(int(i)).def->outputs)
                count += registerCount(output.type);
            _register[i] = allocate(count);
        }
    if (_overflow) {
        _diagnostics.warn(_plan.graph.path, "", "the material is too large; black is shown");
        Plan empty;
        empty.opacity.value = Value::makeFloat(1.0f);
        return ProgramBuilder(empty, _textures, _diagnostics).build();
    }

    std::vector<bool> surface(n, false), emission(n, false), interior(n, false), opacity(n, false);
    bsdfOps(surface);
    _code->edf = linearOps(_plan.edf, emission);
    _code->vdf = linearOps(_plan.vdf, interior);
    _code->volumeEdf = linearOps(_plan.volumeEdf, interior);
    mark(_plan.opacity, opacity);
    _code->opacity = registerOf(_plan.opacity);
    emit(surface, _code->surfaceCode);
    emit(emission, _code->emissionCode);
    emit(interior, _code->interiorCode);
    emit(opacity, _code->opacityCode);

    if (_plan.displacementNode >= 0) {
        const GraphNode& node = nodeOf(_plan.displacementNode);
        std::vector<bool> needed(n, false);
        const auto read = [&](const char* name) {
            const Operand& operand = node.inputs[size_t(node.def->findInput(name))];
            mark(operand, needed);
            return registerOf(operand);
        };
        _code->displacement = read("displacement");
        _code->displacementScale = read("scale");
        _code->displacementIsVector =
            node.def->inputs[size_t(node.def->findInput("displacement"))].type == ValueType::Vec3;
        emit(needed, _code->displacementCode);
        _program->_hasDisplacement = true;
    }

    _code->opacityFromPrimvars = !_code->opacityCode.empty();
    for (const Instruction& instruction : _code->opacityCode)
        for (size_t i = 0; i < n; ++i)
            if (nodeOf(int(i)).def->function == instruction.function &&
                nodeOf(int(i)).def->varying && instruction.output == _register[i])
                _code->opacityFromPrimvars &=
                    _data[i].slot >= 0 || nodeOf(int(i)).def->category == "UsdPrimvarReader";
    setFlags();
    return _program;
}

} // namespace patina
