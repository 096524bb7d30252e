// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/graph/mergeSurfaceShaders.h"

#include "materialNetwork/graph/algebra.h"
#include "materialNetwork/nodes/nodeTable.h"

#include <map>

namespace patina {

namespace {

Operand numberOf(float x) {
    Operand operand;
    operand.value = Value::makeFloat(x);
    return operand;
}

bool equal(const Operand& a, const Operand& b) {
    if (a.isConstant() != b.isConstant()) return false;
    return a.isConstant() ? a.value.numbers == b.value.numbers
                          : a.node == b.node && a.output == b.output;
}

/// A surface taken apart.
struct Surface {
    Operand bsdf = noClosure(ValueType::Bsdf), edf = noClosure(ValueType::Edf);
    Operand opacity = numberOf(1.0f), thin = numberOf(0.0f);
    bool changed = false; ///< not as a `surface` of the graph says it
};

struct Displacement {
    Operand amount = numberOf(0.0f);
    bool vector = false;
};

struct Volume {
    Operand vdf = noClosure(ValueType::Vdf), edf = noClosure(ValueType::Edf);
};

class Merger {
public:
    Merger(Graph& graph, Diagnostics& diagnostics) : _graph(graph), _diagnostics(diagnostics) {}

    bool run() {
        bool changed = spreadMaterial();
        const auto terminal = [&](const char* name) -> Operand* {
            const auto found = _graph.terminals.find(name);
            return found == _graph.terminals.end() || found->second.isConstant() ? nullptr
                                                                                 : &found->second;
        };
        if (Operand* surface = terminal("surface")) changed |= mergeSurface(*surface);
        if (Operand* displacement = terminal("displacement"))
            if (kindOf(*displacement) == ClosureKind::Mix) {
                const Displacement d = displacementOf(*displacement);
                *displacement =
                    append(d.vector ? "ND_displacement_vector3" : "ND_displacement_float",
                           {d.amount, numberOf(1.0f)}, pathOf(*displacement));
                changed = true;
            }
        if (Operand* volume = terminal("volume"))
            if (kindOf(*volume) == ClosureKind::Mix && typeOf(*volume) == ValueType::VolumeShader) {
                const Volume v = volumeOf(*volume);
                *volume = append("ND_volume", {v.vdf, v.edf}, pathOf(*volume));
                changed = true;
            }
        return changed;
    }

private:
    const GraphNode& nodeOf(const Operand& operand) const {
        return _graph.nodes[size_t(operand.node)];
    }
    std::string pathOf(const Operand& operand) const { return nodeOf(operand).path; }
    ValueType typeOf(const Operand& operand) const {
        return operand.isConstant() ? operand.value.type
                                    : nodeOf(operand).def->outputs[size_t(operand.output)].type;
    }
    ClosureKind kindOf(const Operand& operand) const {
        return operand.isConstant() ? ClosureKind::None : nodeOf(operand).def->closure;
    }
    Operand input(const Operand& operand, const char* name) const {
        const GraphNode& node = nodeOf(operand);
        const int i = node.def->findInput(name);
        return i < 0 ? Operand() : node.inputs[size_t(i)];
    }

    Operand append(const char* id, std::vector<Operand> inputs, const std::string& path) {
        GraphNode node;
        node.def = NodeTable::get().find(id);
        node.path = path;
        node.inputs = std::move(inputs);
        for (size_t i = node.inputs.size(); i < node.def->inputs.size(); ++i) {
            node.inputs.emplace_back();
            node.inputs.back().value = node.def->inputs[i].value;
        }
        node.authored.assign(node.inputs.size(), true);
        _graph.nodes.push_back(std::move(node));
        return {int(_graph.nodes.size()) - 1, 0, {}};
    }

    /// Terminals may lead to a material as a whole.
    bool spreadMaterial() {
        const auto found = _graph.terminals.find("surface");
        if (found == _graph.terminals.end() || kindOf(found->second) != ClosureKind::Material)
            return false;
        bool changed = false;
        for (const char* name : {"displacement", "volume"}) {
            const Operand shader = input(found->second, (std::string(name) + "shader").c_str());
            if (shader.isConstant() || _graph.terminals.count(name)) continue;
            _graph.terminals[name] = shader;
            changed = true;
        }
        // A volumematerial has no surface.
        if (nodeOf(found->second).def->findInput("surfaceshader") < 0) {
            _graph.terminals.erase("surface");
            changed = true;
        }
        return changed;
    }

    bool mergeSurface(Operand& terminal) {
        const std::string path = pathOf(terminal);
        const Surface s = surfaceOf(terminal);
        if (!s.changed) return false;
        terminal = append("ND_surface", {s.bsdf, s.edf, s.opacity, s.thin}, path);
        return true;
    }

    /// @param made by node, to which what is made now is added
    template <class Part, class Make>
    static Part once(std::map<int, Part>& made, const Operand& operand, const Make& make) {
        if (operand.isConstant()) return {};
        const int node = operand.node; // making appends nodes, which may move the operand
        const auto known = made.find(node);
        if (known != made.end()) return known->second;
        const Part part = make();
        return made[node] = part;
    }

    Surface surfaceOf(const Operand& operand) {
        return once(_surfaces, operand, [&] { return surfaceOfNode(operand); });
    }

    Surface surfaceOfNode(const Operand operand) {
        Surface s;
        switch (kindOf(operand)) {
        case ClosureKind::Material: return materialOf(operand);
        case ClosureKind::SurfaceUnlit: return unlitOf(operand);
        case ClosureKind::Surface:
            s.bsdf = input(operand, "bsdf");
            s.edf = input(operand, "edf");
            s.opacity = input(operand, "opacity");
            s.thin = input(operand, "thin_walled");
            if (!s.thin.isConstant()) wrapThin(s, pathOf(operand));
            return s;
        case ClosureKind::Mix:
            if (typeOf(operand) == ValueType::SurfaceShader) {
                const Operand fg = input(operand, "fg"), bg = input(operand, "bg");
                const Operand mix = input(operand, "mix");
                const std::string path = pathOf(operand);
                const Surface a = surfaceOf(fg);
                return mixed(a, surfaceOf(bg), mix, false, path);
            }
            break;
        default: break;
        }
        const ValueType type = typeOf(operand);
        if (type == ValueType::Bsdf)
            s.bsdf = operand;
        else if (type == ValueType::Edf)
            s.edf = operand;
        else {
            s.changed = true; // to a black one; nobody complains twice
            _diagnostics.warn(pathOf(operand), "surface",
                              messages::noSurface(nodeOf(operand).def->category));
        }
        return s;
    }

    Surface materialOf(const Operand& material) {
        const Operand front = input(material, "surfaceshader");
        const Operand back = input(material, "backsurfaceshader");
        const std::string path = pathOf(material);
        if (back.isConstant()) return surfaceOf(front);
        const Surface b = surfaceOf(back);
        if (isNone(b.bsdf) && isNone(b.edf) && !front.isConstant()) return surfaceOf(front);
        Surface f;
        f.opacity = numberOf(0.0f);
        if (!front.isConstant()) f = surfaceOf(front);
        return mixed(b, f, append("PatinaBackSide", {}, path), true, path);
    }

    /// Emits, and passes light straight on as if nothing were there but a colour.
    Surface unlitOf(const Operand& unlit) {
        const std::string path = pathOf(unlit);
        const auto product = [&](const char* color, const char* factor) {
            const Operand c = input(unlit, color), f = input(unlit, factor);
            return append("ND_multiply_color3FA", {c, f}, path);
        };
        Surface s;
        s.changed = true;
        s.opacity = input(unlit, "opacity");
        s.edf = append("ND_uniform_edf", {product("emission_color", "emission")}, path);
        float transmission = 1.0f;
        if (constantNumber(input(unlit, "transmission"), transmission) && transmission == 0.0f)
            return s;
        GraphNode node;
        node.def = NodeTable::get().find("ND_dielectric_btdf");
        node.path = path;
        const Operand tint = product("transmission_color", "transmission");
        for (const InputDef& def : node.def->inputs) {
            Operand operand;
            operand.value = def.value;
            if (def.name == "ior") operand = numberOf(1.0f);
            if (def.name == "tint") operand = tint;
            if (def.geomprop == "Nworld" || def.geomprop == "Tworld")
                operand =
                    append(def.geomprop == "Nworld" ? "ND_normal_vector3" : "ND_tangent_vector3",
                           {worldSpace()}, "<" + def.geomprop + ">");
            node.inputs.push_back(operand);
            node.authored.push_back(false);
        }
        _graph.nodes.push_back(std::move(node));
        s.bsdf = {int(_graph.nodes.size()) - 1, 0, {}};
        return s;
    }

    static Operand worldSpace() {
        Operand operand;
        operand.value = Value::makeString("world");
        return operand;
    }

    /// Moves thin_walled from the surface to its closures.
    void wrapThin(Surface& s, const std::string& path) {
        const bool solid = s.thin.isConstant() && isNumber(s.thin, 0.0f);
        if (!solid && !isNone(s.bsdf)) {
            const Operand slab = append("PatinaThinSlab", {s.bsdf}, path);
            s.bsdf =
                s.thin.isConstant() ? slab : append("ND_mix_bsdf", {slab, s.bsdf, s.thin}, path);
        }
        s.thin = numberOf(0.0f);
        s.changed = true;
    }

    static bool isNumber(const Operand& operand, float x) {
        float value = 0.0f;
        return constantNumber(operand, value) && value == x;
    }

    /// @param choice mix is 0 or 1
    Surface mixed(Surface a, Surface b, const Operand& mix, bool choice, const std::string& path) {
        Surface s;
        s.changed = true;
        Operand share = mix;
        if (equal(a.opacity, b.opacity)) {
            s.opacity = a.opacity;
        } else {
            const auto clamped = [&](const Operand& x) {
                return append("ND_clamp_float", {x, numberOf(0.0f), numberOf(1.0f)}, path);
            };
            const Operand there = clamped(a.opacity);
            s.opacity = append("ND_mix_float", {there, clamped(b.opacity), mix}, path);
            if (!choice)
                share = append("ND_divide_float",
                               {append("ND_multiply_float", {there, mix}, path), s.opacity}, path);
        }
        if (!equal(a.thin, b.thin)) {
            wrapThin(a, path);
            wrapThin(b, path);
        }
        s.thin = a.thin;
        s.bsdf = append("ND_mix_bsdf", {a.bsdf, b.bsdf, share}, path);
        s.edf = append("ND_mix_edf", {a.edf, b.edf, share}, path);
        return s;
    }

    Displacement displacementOf(const Operand& operand) {
        return once(_displacements, operand, [&] { return displacementOfNode(operand); });
    }

    Displacement displacementOfNode(const Operand operand) {
        Displacement d;
        switch (kindOf(operand)) {
        case ClosureKind::Material: return displacementOf(input(operand, "displacementshader"));
        case ClosureKind::Displacement: {
            const Operand amount = input(operand, "displacement"), scale = input(operand, "scale");
            const std::string path = pathOf(operand);
            d.vector = nodeOf(operand).def->inputs[0].type == ValueType::Vec3;
            d.amount = append(d.vector ? "ND_multiply_vector3FA" : "ND_multiply_float",
                              {amount, scale}, path);
            return d;
        }
        case ClosureKind::Mix: {
            const Operand fg = input(operand, "fg"), bg = input(operand, "bg");
            const Operand mix = input(operand, "mix");
            const std::string path = pathOf(operand);
            Displacement a = displacementOf(fg), b = displacementOf(bg);
            d.vector = a.vector || b.vector;
            for (Displacement* part : {&a, &b})
                if (d.vector && !part->vector)
                    part->amount = append("ND_combine3_vector3",
                                          {numberOf(0.0f), numberOf(0.0f), part->amount}, path);
            d.amount = append(d.vector ? "ND_mix_vector3" : "ND_mix_float",
                              {a.amount, b.amount, mix}, path);
            return d;
        }
        default:
            _diagnostics.warn(pathOf(operand), "displacement",
                              messages::noDisplacement(nodeOf(operand).def->category));
            return d;
        }
    }

    Volume volumeOf(const Operand& operand) {
        return once(_volumes, operand, [&] { return volumeOfNode(operand); });
    }

    Volume volumeOfNode(const Operand operand) {
        Volume v;
        switch (kindOf(operand)) {
        case ClosureKind::Material: return volumeOf(input(operand, "volumeshader"));
        case ClosureKind::Volume:
            v.vdf = input(operand, "vdf");
            v.edf = input(operand, "edf");
            return v;
        case ClosureKind::Mix:
            if (typeOf(operand) == ValueType::VolumeShader) {
                const Operand fg = input(operand, "fg"), bg = input(operand, "bg");
                const Operand mix = input(operand, "mix");
                const std::string path = pathOf(operand);
                const Volume a = volumeOf(fg), b = volumeOf(bg);
                v.vdf = append("ND_mix_vdf", {a.vdf, b.vdf, mix}, path);
                v.edf = append("ND_mix_edf", {a.edf, b.edf, mix}, path);
                return v;
            }
            break;
        default: break;
        }
        if (typeOf(operand) == ValueType::Vdf)
            v.vdf = operand;
        else
            _diagnostics.warn(pathOf(operand), "volume",
                              messages::noVolume(nodeOf(operand).def->category));
        return v;
    }

    Graph& _graph;
    Diagnostics& _diagnostics;
    // By node: what is shared is made one once.
    std::map<int, Surface> _surfaces;
    std::map<int, Displacement> _displacements;
    std::map<int, Volume> _volumes;
};

} // namespace

bool mergeSurfaceShaders(Graph& graph, Diagnostics& diagnostics) {
    return Merger(graph, diagnostics).run();
}

} // namespace patina
