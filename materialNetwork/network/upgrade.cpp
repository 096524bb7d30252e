// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/network/upgrade.h"

#include "materialNetwork/network/translate.h"

#include "materialNetwork/network/geomprop.h"

#include <algorithm>
#include <deque>
#include <set>
#include <unordered_map>

namespace patina {

namespace {

const std::string swizzlePrefix = "ND_swizzle_";

bool startsWith(const std::string& text, const std::string& start) {
    return text.compare(0, start.size(), start) == 0;
}

bool has(const NetworkNode& node, const std::string& input) {
    return node.inputs.count(input) || node.connections.count(input);
}

/// Whether a node has a form that only 1.38 has.
bool isChanged(const NetworkNode& node) {
    return startsWith(node.id, swizzlePrefix) || node.id == "ND_thin_surface" ||
           node.id == "ND_thin_film_bsdf" ||
           (startsWith(node.id, "ND_atan2_") && (has(node, "in1") || has(node, "in2"))) ||
           (startsWith(node.id, "ND_normalmap") && has(node, "space"));
}

/// Whether a node means something else in 1.38.
bool mayMeanElse(const NetworkNode& node) {
    return startsWith(node.id, "ND_normalmap") || startsWith(node.id, "ND_switch_");
}

class Upgrader {
public:
    Upgrader(std::vector<NetworkNode>& nodes, std::map<std::string, Connection>& ends,
             const std::function<bool(const std::string&)>& before139, Diagnostics& diagnostics)
        : _nodes(nodes.begin(), nodes.end()), _before139(before139), _diagnostics(diagnostics) {
        for (NetworkNode& node : _nodes) {
            _byPath.emplace(node.path, &node);
            const auto shader = node.connections.find("surfaceshader");
            if (node.id == "ND_surfacematerial" && shader != node.connections.end())
                _materials.emplace(shader->second.node, &node);
        }
        for (auto& [name, end] : ends)
            _ends.emplace(end.node, &end);
    }

    std::vector<NetworkNode> run() {
        const size_t count = _nodes.size(); // the upgrade adds nodes of 1.39
        for (size_t i = 0; i < count; ++i) {
            NetworkNode& node = _nodes[i];
            if (startsWith(node.id, swizzlePrefix)) swizzle(node);
            if (startsWith(node.id, "ND_atan2_")) atan2(node);
            if (startsWith(node.id, "ND_normalmap")) normalMap(node);
            if (startsWith(node.id, "ND_switch_")) choice(node);
            if (node.id == "ND_layer_bsdf") thinFilm(node);
            if (node.id == "ND_thin_surface") thinSurface(node);
        }
        return {std::make_move_iterator(_nodes.begin()), std::make_move_iterator(_nodes.end())};
    }

private:
    NetworkNode* find(const std::string& path) {
        const auto found = _byPath.find(path);
        return found == _byPath.end() ? nullptr : found->second;
    }

    /// Adds a node beside another one.
    NetworkNode& add(const NetworkNode& beside, const std::string& ending, const std::string& id) {
        std::string path = beside.path + "_" + ending;
        while (_byPath.count(path))
            path = beside.path + "_" + ending + std::to_string(++_count);
        _nodes.emplace_back();
        NetworkNode& node = _nodes.back();
        node.path = path;
        node.id = id;
        _byPath.emplace(path, &node);
        return node;
    }

    /// What feeds an input of one node feeds one of another.
    static void copy(const NetworkNode& from, const std::string& input, NetworkNode& to,
                     const std::string& name) {
        const auto v = from.inputs.find(input);
        if (v != from.inputs.end()) to.inputs[name] = v->second;
        const auto c = from.connections.find(input);
        if (c != from.connections.end()) to.connections[name] = c->second;
    }
    static void drop(NetworkNode& node, const std::string& input) {
        node.inputs.erase(input);
        node.connections.erase(input);
    }
    static void rename(NetworkNode& node, const std::string& from, const std::string& to) {
        if (!has(node, from)) return;
        copy(node, from, node, to);
        drop(node, from);
    }

    /// One extract for each channel, put together again.
    void swizzle(NetworkNode& node) {
        const size_t split = node.id.find('_', swizzlePrefix.size());
        const std::string from = node.id.substr(swizzlePrefix.size(), split - swizzlePrefix.size());
        const std::string to = split == std::string::npos ? "" : node.id.substr(split + 1);
        const int count = valueTypeComponents(valueTypeFromName(to));
        const int available = valueTypeComponents(valueTypeFromName(from));
        if (count < 1 || count > 4 || available < 1) return;
        const auto given = node.inputs.find("channels");
        const std::string channels = given == node.inputs.end() ? "" : given->second.text;
        if (node.connections.count("channels"))
            _diagnostics.warn(node.path, "channels", messages::channelsConnected);
        const NetworkNode source = std::move(node);
        node = {};
        node.path = source.path;
        node.id = count == 1 ? "ND_dot_float" : "ND_combine" + std::to_string(count) + "_" + to;
        const NetworkNode* extracts[4] = {};
        for (int i = 0; i < count; ++i) {
            const std::string input = count == 1 ? "in" : "in" + std::to_string(i + 1);
            const char c = i < int(channels.size()) ? channels[size_t(i)] : '?';
            const size_t known = std::string("rgbaxyzw").find(c);
            const int place = known == std::string::npos || int(known % 4) >= available
                                  ? 0 // as MaterialX has it
                                  : int(known % 4);
            if (c == '0' || c == '1') {
                node.inputs[input] = Value::makeFloat(c == '1' ? 1.0f : 0.0f);
            } else if (available == 1) {
                copy(source, "in", node, input);
            } else {
                if (!extracts[place]) {
                    NetworkNode& extract =
                        add(source, std::string(1, "xyzw"[place]), "ND_extract_" + from);
                    copy(source, "in", extract, "in");
                    extract.inputs["index"] = Value::makeInt(place);
                    extracts[place] = &extract;
                }
                node.connections[input] = {extracts[place]->path, "out"};
            }
        }
    }

    static void atan2(NetworkNode& node) {
        rename(node, "in1", "iny");
        rename(node, "in2", "inx");
    }

    void normalMap(NetworkNode& node) {
        const auto space = node.inputs.find("space");
        const bool object = space != node.inputs.end() && space->second.text == "object";
        drop(node, "space");
        if (object) {
            // A texel is the normal itself: in * 2 - 1.
            NetworkNode& twice = add(node, "twice", "ND_multiply_vector3FA");
            copy(node, "in", twice, "in1");
            if (!has(node, "in")) twice.inputs["in1"] = Value::makeVec3(0.5f, 0.5f, 1.0f);
            twice.inputs["in2"] = Value::makeFloat(2.0f);
            NetworkNode& less = add(node, "less", "ND_subtract_vector3FA");
            less.connections["in1"] = {twice.path, "out"};
            less.inputs["in2"] = Value::makeFloat(1.0f);
            node.id = "ND_normalize_vector3";
            node.inputs.clear();
            node.connections = {{"in", {less.path, "out"}}};
            return;
        }
        if (has(node, "bitangent") || !(has(node, "normal") || has(node, "tangent")) ||
            !_before139(node.path))
            return;
        // 1.38 made the bitangent of the two.
        NetworkNode& cross = add(node, "cross", "ND_crossproduct_vector3");
        feed(node, "normal", "Nworld", cross, "in1");
        feed(node, "tangent", "Tworld", cross, "in2");
        NetworkNode& unit = add(node, "bitangent", "ND_normalize_vector3");
        unit.connections["in"] = {cross.path, "out"};
        node.connections["bitangent"] = {unit.path, "out"};
    }

    /// Copies an input; where it is not authored, its geometric default.
    void feed(const NetworkNode& from, const std::string& input, const char* geomprop,
              NetworkNode& to, const std::string& name) {
        copy(from, input, to, name);
        if (has(from, input)) return;
        NetworkNode standard = geompropNode(geomprop);
        to.connections[name] = {standard.path, "out"};
        if (find(standard.path)) return;
        _nodes.push_back(std::move(standard));
        _byPath.emplace(_nodes.back().path, &_nodes.back());
    }

    /// 1.38 had five inputs: a larger `which` was out of range, and took the first.
    void choice(NetworkNode& node) {
        const auto which = node.inputs.find("which");
        if (which == node.inputs.end() || which->second.numbers.empty() ||
            which->second.numbers[0] < 5.0f || !_before139(node.path))
            return;
        for (int i = 6; i <= 10; ++i)
            if (has(node, "in" + std::to_string(i))) return;
        which->second.numbers[0] = 0.0f;
    }

    /// A film on top of a layer becomes inputs of the microfacet closures under it.
    void thinFilm(NetworkNode& layer) {
        const auto top = layer.connections.find("top");
        const NetworkNode* film = top == layer.connections.end() ? nullptr : find(top->second.node);
        if (!film || film->id != "ND_thin_film_bsdf") return;
        const auto base = layer.connections.find("base");
        if (base != layer.connections.end()) coat(base->second.node, *film);
        // The layer is its base from now on: a mix that takes all of it.
        const NetworkNode old = std::move(layer);
        layer = {};
        layer.path = old.path;
        layer.id = "ND_mix_bsdf";
        copy(old, "base", layer, "fg");
        layer.inputs["mix"] = Value::makeFloat(1.0f);
    }

    /// Gives the film to all closures below a node; chains of them may be of any length. What has
    /// been met before has its film.
    void coat(const std::string& base, const NetworkNode& film) {
        std::vector<std::string> open = {base};
        while (!open.empty()) {
            const std::string path = open.back();
            open.pop_back();
            NetworkNode* node = find(path);
            if (!node || !_coated.insert(path).second) continue;
            if (node->id == "ND_dielectric_bsdf" || node->id == "ND_conductor_bsdf" ||
                node->id == "ND_generalized_schlick_bsdf") {
                const auto mode = node->inputs.find("scatter_mode");
                if (mode != node->inputs.end() && mode->second.text == "T") continue;
                giveFilm(*node, film, "thickness", "thinfilm_thickness", 550.0f);
                giveFilm(*node, film, "ior", "thinfilm_ior", 1.5f);
                continue;
            }
            for (const char* input : {"top", "base", "fg", "bg", "in1", "in2"}) {
                const auto c = node->connections.find(input);
                if (c != node->connections.end()) open.push_back(c->second.node);
            }
        }
    }
    static void giveFilm(NetworkNode& node, const NetworkNode& film, const char* from,
                         const char* to, float standard) {
        if (has(node, to)) return;
        copy(film, from, node, to);
        if (!has(node, to)) node.inputs[to] = Value::makeFloat(standard);
    }

    /// One surface for each side; what the back has is for the material to say.
    void thinSurface(NetworkNode& node) {
        const NetworkNode old = std::move(node);
        node = {};
        node.path = old.path;
        node.id = "ND_surface";
        side(old, "front", node);
        if (!has(old, "back_bsdf") && !has(old, "back_edf")) return;
        NetworkNode& back = add(old, "back", "ND_surface");
        side(old, "back", back);
        const std::string front = node.path, behind = back.path;
        const auto [materials, lastMaterial] = _materials.equal_range(front);
        for (auto m = materials; m != lastMaterial; ++m)
            m->second->connections.emplace("backsurfaceshader", Connection{behind, "out"});
        const auto [ends, lastEnd] = _ends.equal_range(front);
        if (ends != lastEnd) {
            NetworkNode& material = add(old, "sides", "ND_surfacematerial");
            material.connections["surfaceshader"] = {front, "out"};
            material.connections["backsurfaceshader"] = {behind, "out"};
            for (auto end = ends; end != lastEnd; ++end)
                *end->second = {material.path, "out"};
        }
        if (materials == lastMaterial && ends == lastEnd)
            _diagnostics.warn(front, "back_bsdf", messages::thinSurfaceUnused);
    }
    static void side(const NetworkNode& thin, const std::string& which, NetworkNode& surface) {
        copy(thin, which + "_bsdf", surface, "bsdf");
        copy(thin, which + "_edf", surface, "edf");
        copy(thin, "opacity", surface, "opacity");
        surface.inputs["thin_walled"] = Value::makeBool(true);
    }

    std::deque<NetworkNode> _nodes; ///< addresses must stay
    const std::function<bool(const std::string&)>& _before139;
    Diagnostics& _diagnostics;
    std::unordered_map<std::string, NetworkNode*> _byPath;
    std::unordered_multimap<std::string, NetworkNode*> _materials; ///< by their surface
    std::unordered_multimap<std::string, Connection*> _ends;       ///< by their node
    std::set<std::string> _coated;                                 ///< paths below a thin film
    size_t _count = 0;                                             ///< of paths that were taken
};

} // namespace

void upgradeNodes(std::vector<NetworkNode>& nodes, std::map<std::string, Connection>& ends,
                  const std::function<bool(const std::string&)>& before139,
                  Diagnostics& diagnostics) {
    if (std::any_of(nodes.begin(), nodes.end(), [&](const NetworkNode& node) {
            return isChanged(node) || (mayMeanElse(node) && before139(node.path));
        }))
        nodes = Upgrader(nodes, ends, before139, diagnostics).run();
}

void upgradeNetwork(Network& network, Diagnostics& diagnostics) {
    upgradeNodes(
        network.nodes, network.terminals, [](const std::string&) { return true; }, diagnostics);
}

} // namespace patina
