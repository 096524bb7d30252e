// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/plan/plan.h"

#include "materialNetwork/graph/tangentSets.h"
#include "materialNetwork/plan/layering.h"
#include "materialNetwork/nodes/nodeTable.h"

#include "shaders/shaders.h"

#include <map>
#include <tuple>

namespace patina {

namespace {

class Planner {
public:
    Planner(Plan& plan, Diagnostics& diagnostics) : _plan(plan), _diagnostics(diagnostics) {}

    void run() {
        const MethodSet methods(_plan.methods);
        _sharesInterfaces = methods.get<method::ReflectionOverTransmission>() ==
                            method::ReflectionOverTransmission::SharedInterface;
        _thinSlabs = methods.get<method::ThinWalled>() != method::ThinWalled::Solid;
        _plan.opacity.value = Value::makeFloat(1.0f);
        const auto surface = _plan.graph.terminals.find("surface");
        if (surface != _plan.graph.terminals.end()) planSurface(surface->second, "surface");
        const auto volume = _plan.graph.terminals.find("volume");
        if (volume != _plan.graph.terminals.end()) planVolume(volume->second);
        if (surface == _plan.graph.terminals.end() && (_plan.vdf >= 0 || _plan.volumeEdf >= 0)) {
            _plan.volumeOnly = true;
            _plan.opacity.value = Value::makeFloat(0.0f);
        }
        const auto displacement = _plan.graph.terminals.find("displacement");
        if (displacement != _plan.graph.terminals.end()) planDisplacement(displacement->second);
    }

private:
    const GraphNode& nodeOf(int node) const { return _plan.graph.nodes[size_t(node)]; }

    /// @param name of an input that all nodes of its kind of closure have
    const Operand& input(const GraphNode& node, const char* name) const {
        return node.inputs[size_t(node.def->findInput(name))];
    }

    /// The surface has been made one by mergeSurfaceShaders().
    void planSurface(const Operand& operand, const char* terminal) {
        if (operand.isConstant()) return;
        const GraphNode& node = nodeOf(operand.node);
        switch (node.def->closure) {
        case ClosureKind::Material:
            if (node.def->findInput("surfaceshader") < 0) break;
            return planSurface(input(node, "surfaceshader"), terminal);
        case ClosureKind::Surface: {
            const Operand bsdf = input(node, "bsdf"), edf = input(node, "edf");
            _plan.opacity = input(node, "opacity");
            float thin = 0.0f;
            constantNumber(input(node, "thin_walled"), thin);
            _plan.thinWalled = thin != 0.0f && _thinSlabs;
            buildBsdf(bsdf, thin != 0.0f);
            _plan.edf = build(edf);
            return;
        }
        default: break;
        }
        // A bare closure on the terminal is understood as a surface made of it.
        const ValueType type = node.def->outputs[size_t(operand.output)].type;
        if (type == ValueType::Bsdf)
            buildBsdf(operand, false);
        else if (type == ValueType::Edf)
            _plan.edf = build(operand);
        else
            _diagnostics.warn(node.path, terminal, messages::noSurface(node.def->category));
    }

    void buildBsdf(const Operand& operand, bool thin) {
        _plan.bsdf = build(operand, {false, thin});
        _plan.vdf = build(interior(operand));
    }

    /// The VDF beneath the layers of a BSDF. Where surfaces are mixed, their media are.
    Operand interior(const Operand& operand) {
        if (operand.isConstant()) return {};
        const auto known = _interiors.find(operand.node);
        if (known != _interiors.end()) return known->second;
        const Operand result = interiorOf(nodeOf(operand.node));
        _interiors[operand.node] = result;
        return result;
    }

    Operand interiorOf(const GraphNode node) {
        const auto either = [&](const Operand& a, const Operand& b) {
            if (!a.isConstant() && !b.isConstant() && a.node != b.node)
                leaveOut(node, "a second medium inside the same object is not modelled");
            return a.isConstant() ? b : a;
        };
        switch (node.def->closure) {
        case ClosureKind::Layer:
            if (node.def->inputs[1].type == ValueType::Vdf)
                return either(node.inputs[1], interior(node.inputs[0]));
            return either(interior(node.inputs[1]), interior(node.inputs[0]));
        case ClosureKind::Mix: {
            const Operand a = interior(node.inputs[0]), b = interior(node.inputs[1]);
            if (a.isConstant() || b.isConstant() || a.node == b.node) return either(a, b);
            return append("ND_mix_vdf", {a, b, node.inputs[2]}, node.path);
        }
        case ClosureKind::Add: return either(interior(node.inputs[0]), interior(node.inputs[1]));
        case ClosureKind::Multiply: return interior(node.inputs[0]);
        case ClosureKind::ThinSlab: return _thinSlabs ? Operand() : interior(node.inputs[0]);
        default: return {};
        }
    }

    Operand append(const char* id, std::vector<Operand> inputs, const std::string& path) {
        GraphNode node;
        node.def = NodeTable::get().find(id);
        node.path = path;
        node.authored.assign(inputs.size(), true);
        node.inputs = std::move(inputs);
        _plan.graph.nodes.push_back(std::move(node));
        return {int(_plan.graph.nodes.size()) - 1, 0, {}};
    }

    void planVolume(const Operand& operand) {
        if (operand.isConstant()) return;
        const GraphNode& node = nodeOf(operand.node);
        if (node.def->closure == ClosureKind::Material &&
            node.def->findInput("volumeshader") >= 0) {
            planVolume(input(node, "volumeshader"));
        } else if (node.def->closure == ClosureKind::Volume) {
            const Operand vdf = input(node, "vdf"), edf = input(node, "edf");
            _plan.vdf = build(vdf);
            _plan.volumeEdf = build(edf);
        } else if (node.def->outputs[size_t(operand.output)].type == ValueType::Vdf) {
            _plan.vdf = build(operand);
        } else {
            _diagnostics.warn(node.path, "volume", messages::noVolume(node.def->category));
        }
    }

    void planDisplacement(const Operand& operand) {
        if (operand.isConstant()) return;
        const GraphNode& node = nodeOf(operand.node);
        if (node.def->closure == ClosureKind::Material &&
            node.def->findInput("displacementshader") >= 0)
            planDisplacement(input(node, "displacementshader"));
        else if (node.def->closure != ClosureKind::Displacement)
            _diagnostics.warn(node.path, "displacement",
                              messages::noDisplacement(node.def->category));
        else if (!isConstantValue(input(node, "displacement"), 0.0f) &&
                 !isConstantValue(input(node, "scale"), 0.0f))
            _plan.displacementNode = operand.node;
    }

    void leaveOut(const GraphNode& node, const std::string& what) {
        _plan.leftOut.push_back(node.path + ": " + what);
    }

    /// Where a closure stands.
    struct Place {
        bool underReflection; ///< a reflection lobe is above
        bool thin;            ///< in a thin slab
    };

    /// @returns index in Plan::closures, -1 for no closure
    int build(const Operand& operand, Place place = {false, false}) {
        if (operand.isConstant()) return -1;
        const auto key = std::make_tuple(operand.node, place.underReflection, place.thin);
        const auto known = _built.find(key);
        if (known != _built.end()) return known->second;
        const int index = buildNode(operand.node, place);
        _built[key] = index;
        return index;
    }

    int buildNode(int index, Place place) {
        PlanClosure closure;
        const GraphNode node = nodeOf(index);
        closure.kind = node.def->closure;
        closure.node = index;
        closure.thin = place.thin && _thinSlabs;
        closure.inThinSlab = place.thin;
        closure.underReflection = place.underReflection;
        switch (closure.kind) {
        case ClosureKind::Layer: {
            const Operand& top = node.inputs[0];
            if (!top.isConstant() && nodeOf(top.node).def->closure == ClosureKind::ThinFilm) {
                const GraphNode film = nodeOf(top.node);
                std::map<int, Operand> coated;
                return build(coat(node.inputs[1], film, coated), place);
            }
            closure.a = build(node.inputs[0], place);
            if (node.def->inputs[1].type == ValueType::Vdf) return closure.a;
            closure.b =
                build(node.inputs[1], {place.underReflection || reflects(closure.a), place.thin});
            if (closure.a < 0) return closure.b;
            if (closure.b < 0) return closure.a;
            break;
        }
        case ClosureKind::Mix:
        case ClosureKind::Add:
            closure.a = build(node.inputs[0], place);
            closure.b = build(node.inputs[1], place);
            if (closure.a < 0 && closure.b < 0) return -1;
            break;
        case ClosureKind::ThinSlab: return build(node.inputs[0], {place.underReflection, true});
        case ClosureKind::Multiply:
            closure.a = build(node.inputs[0], place);
            if (closure.a < 0) return -1;
            break;
        case ClosureKind::SchlickEdf:
            closure.a = build(node.inputs[3], place);
            if (closure.a < 0) return -1;
            break;
        case ClosureKind::ThinFilm:
            _diagnostics.warn(node.path, "", messages::thinFilmOutOfPlace);
            return -1;
        case ClosureKind::Unsupported:
            leaveOut(node, node.def->category + " is not modelled");
            return -1;
        case ClosureKind::UniformEdf:
        case ClosureKind::ConicalEdf:
        case ClosureKind::MeasuredEdf:
        case ClosureKind::AbsorptionVdf:
        case ClosureKind::AnisotropicVdf: break;
        default:
            if (closure.isLobe()) {
                planLobe(node, place, closure);
                break;
            }
            _diagnostics.warn(node.path, "", messages::nodeOutOfPlace(node.def->category));
            return -1;
        }
        closure.reflects |= reflects(closure.a) || reflects(closure.b);
        _plan.closures.push_back(closure);
        return int(_plan.closures.size()) - 1;
    }

    void planLobe(const GraphNode& node, Place place, PlanClosure& closure) {
        if (closure.has(lobe::Interface)) {
            const int mode = scatterMode(_plan, closure);
            closure.sharedInterface =
                _sharesInterfaces && place.underReflection && mode == sh::SCATTER_T;
            closure.reflects = (mode & sh::SCATTER_R) != 0;
        }
        for (size_t i = 0; i < node.inputs.size(); ++i)
            checkWord(node, i);
        if (closure.kind == ClosureKind::Subsurface && closure.thin)
            leaveOut(node, "a thin slab has no inside; subsurface scattering is diffuse");
    }

    /// The same closures with the film on every interface that reflects, as MaterialX 1.39 reads
    /// the older thin_film_bsdf. The graph keeps what it had; coated copies are appended.
    /// @param done by node: what is shared is coated once
    Operand coat(const Operand& operand, const GraphNode& film, std::map<int, Operand>& done) {
        if (operand.isConstant()) return operand;
        const auto known = done.find(operand.node);
        if (known != done.end()) return known->second;
        return done[operand.node] = coatNode(operand, film, done);
    }

    Operand coatNode(const Operand& operand, const GraphNode& film, std::map<int, Operand>& done) {
        GraphNode node = nodeOf(operand.node);
        const int thickness = node.def->findInput("thinfilm_thickness");
        if (thickness >= 0) {
            const int mode = node.def->findInput("scatter_mode");
            if (mode >= 0 && node.inputs[size_t(mode)].value.text == "T") return operand;
            node.inputs[size_t(thickness)] = input(film, "thickness");
            node.inputs[size_t(node.def->findInput("thinfilm_ior"))] = input(film, "ior");
        } else {
            bool changed = false;
            for (size_t i = 0; i < node.inputs.size(); ++i) {
                if (node.def->inputs[i].type != ValueType::Bsdf) continue;
                const Operand coated = coat(node.inputs[i], film, done);
                changed |= coated.node != node.inputs[i].node;
                node.inputs[i] = coated;
            }
            if (!changed) return operand;
        }
        _plan.graph.nodes.push_back(std::move(node));
        return {int(_plan.graph.nodes.size()) - 1, operand.output, {}};
    }

    bool reflects(int index) const { return index >= 0 && _plan.closures[size_t(index)].reflects; }

    /// Warns about a string that is none of its input's words.
    void checkWord(const GraphNode& node, size_t i) {
        const InputDef& input = node.def->inputs[i];
        const std::string& text = node.inputs[i].value.text;
        if (input.words.empty() || text == input.words[size_t(wordIndex(input, text))]) return;
        _diagnostics.warn(node.path, input.name, messages::wordUnknown(text, input.words[0]));
    }

    Plan& _plan;
    Diagnostics& _diagnostics;
    bool _sharesInterfaces = true, _thinSlabs = true; ///< methods
    std::map<std::tuple<int, bool, bool>, int> _built;
    std::map<int, Operand> _interiors; ///< by node
};

} // namespace

Plan makePlan(const Graph& graph, std::vector<std::string> cuts, Diagnostics& diagnostics,
              const MethodChoices& methods) {
    Plan plan;
    plan.graph = withTangentSets(graph);
    plan.leftOut = std::move(cuts);
    for (const ChoicePoint& point : choicePoints())
        plan.methods[point.name] = chosenMethod(methods, point.name);
    Planner(plan, diagnostics).run();
    if (MethodSet(plan.methods).get<method::Layering>() == method::Layering::PositionFree) {
        const std::vector<LayerWalkability> layers =
            layerWalkability(plan, MethodSet(plan.methods).get<method::Subsurface>());
        for (size_t i = 0; i < layers.size(); ++i)
            if (!layers[i].reason.empty())
                plan.leftOut.push_back(plan.graph.nodes[size_t(plan.closures[i].node)].path +
                                       ": layering is returned here, for " + layers[i].reason);
    }
    return plan;
}

} // namespace patina
