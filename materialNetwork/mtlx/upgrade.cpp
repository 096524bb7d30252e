// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/mtlx/upgrade.h"

#include "materialNetwork/mtlx/include.h"
#include "materialNetwork/mtlx/xmlFile.h"
#include "materialNetwork/network/network.h"

#include <cstring>
#include <set>
#include <unordered_map>
#include <vector>

namespace patina {

namespace {

using Node = pugi::xml_node;

bool is(const Node& node, const char* name) {
    return !std::strcmp(node.name(), name);
}

Node inputOf(const Node& node, const char* name) {
    for (const Node& child : node.children())
        if ((is(child, "input") || is(child, "parameter")) &&
            !std::strcmp(child.attribute("name").value(), name))
            return child;
    return {};
}

void set(Node node, const char* attribute, const std::string& value) {
    if (!node.attribute(attribute)) node.append_attribute(attribute);
    node.attribute(attribute).set_value(value.c_str());
}

Node addInput(Node node, const char* name, const char* type) {
    Node input = node.append_child("input");
    set(input, "name", name);
    set(input, "type", type);
    return input;
}

/// The same source for another input: a copy under a new name.
void copyInput(const Node& source, Node node, const char* name, const char* type) {
    Node copy = node.append_child("input");
    for (const pugi::xml_attribute& attribute : source.attributes())
        copy.append_copy(attribute);
    set(copy, "name", name);
    set(copy, "type", type);
    copy.remove_attribute("channels");
}

class Upgrader {
public:
    Upgrader(const std::string& path, Diagnostics& diagnostics)
        : _path(path), _diagnostics(diagnostics) {}

    void run(Node scope) {
        const auto around = std::move(_siblings);
        _siblings.clear();
        for (const Node& child : scope.children())
            if (const auto name = child.attribute("name")) _siblings.emplace(name.value(), child);
        upgradeScope(scope);
        _siblings = around;
    }

private:
    void upgradeScope(Node scope) {
        std::vector<Node> nodes;
        for (const Node& child : scope.children())
            if (child.type() == pugi::node_element && !is(child, "nodedef")) nodes.push_back(child);
        for (const Node& node : nodes)
            channelsToSwizzle(node);
        nodes.clear();
        for (const Node& child : scope.children())
            if (child.type() == pugi::node_element && !is(child, "nodedef")) nodes.push_back(child);
        for (const Node& node : nodes) {
            if (is(node, "nodegraph")) run(node);
            if (is(node, "swizzle")) swizzle(node);
            if (is(node, "atan2")) atan2(node);
            if (is(node, "normalmap")) normalMap(node);
            if (is(node, "layer")) thinFilm(node);
            if (is(node, "thin_surface")) thinSurface(node);
        }
    }

    /// Resolves a name that an element of the scope uses. Documents may hold very many.
    Node siblingNamed(const Node& from, const std::string& name) const {
        for (const std::string& candidate : {qualifiedName(from, name), name}) {
            const auto found = _siblings.find(candidate);
            if (found != _siblings.end()) return found->second;
        }
        return Node();
    }

    Node addNode(Node before, const char* category, const std::string& name, const char* type) {
        Node node = before.parent().insert_child_before(category, before);
        set(node, "name", name);
        set(node, "type", type);
        // It belongs to the same document.
        for (const char* attribute : {"namespace", "colorspace", "fileprefix", sourceAttribute})
            if (const pugi::xml_attribute own = before.attribute(attribute))
                set(node, attribute, own.value());
        _siblings.emplace(name, node);
        return node;
    }

    std::string where(const Node& node) const {
        return _path + ":/" + node.attribute("name").value();
    }

    std::string freeName(const std::string& candidate) {
        std::string name = candidate;
        for (int i = 2; _siblings.count(name); ++i)
            name = candidate + std::to_string(i);
        return name;
    }

    /// An input that takes channels of a node reads a swizzle of it.
    void channelsToSwizzle(const Node& node) {
        for (Node child : node.children()) {
            const pugi::xml_attribute channels = child.attribute("channels");
            if (!channels || is(child, "output")) continue;
            // A swizzle made from the type of the source, as far as it is in sight.
            const Node source = siblingNamed(child, child.attribute("nodename").value());
            const std::string type = source ? source.attribute("type").value() : "";
            if (!source || valueTypeComponents(valueTypeFromName(type)) < 1) {
                _diagnostics.warn(where(node), child.attribute("name").value(),
                                  "the channels of this connection are unknown and are ignored");
                child.remove_attribute("channels");
                continue;
            }
            Node pick = addNode(node, "swizzle",
                                freeName(std::string(node.attribute("name").value()) + "_" +
                                         child.attribute("name").value()),
                                child.attribute("type").value());
            copyInput(child, pick, "in", type.c_str());
            Node which = addInput(pick, "channels", "string");
            set(which, "value", channels.value());
            child.remove_attribute("channels");
            child.remove_attribute("output");
            set(child, "nodename", pick.attribute("name").value());
        }
    }

    /// A swizzle is one extract per channel, put together again.
    void swizzle(Node node) {
        const Node in = inputOf(node, "in");
        const std::string channels = inputOf(node, "channels").attribute("value").value();
        const int count = valueTypeComponents(valueTypeFromName(node.attribute("type").value()));
        const std::string from = in.attribute("type").value();
        const int available = valueTypeComponents(valueTypeFromName(from));
        if (!in || available < 1 || count < 1 || count > 4 || int(channels.size()) < count) {
            _diagnostics.warn(where(node), "channels",
                              "the connected value has no channels '" + channels +
                                  "'; zeros are used");
            node.remove_children();
            node.set_name("constant");
            return;
        }
        std::vector<Node> parts; // inputs of the combination
        const std::string name = node.attribute("name").value();
        const Node source = in;
        for (int i = 0; i < count; ++i) {
            const char c = channels[size_t(i)];
            const size_t place = std::string("rgbaxyzw").find(c);
            Node part = node.append_child("part");
            if (place == std::string::npos) {
                set(part, "value", c == '1' ? "1" : "0");
            } else if (available == 1) {
                copyInput(source, part, "in", "float");
            } else {
                Node extract = addNode(node, "extract", freeName(name + "_" + c), "float");
                copyInput(source, extract, "in", from.c_str());
                set(addInput(extract, "index", "integer"), "value", std::to_string(place % 4));
                set(part, "nodename", extract.attribute("name").value());
            }
            parts.push_back(part);
        }
        std::vector<Node> old;
        for (const Node& child : node.children())
            if (!is(child, "part")) old.push_back(child);
        for (const Node& child : old)
            node.remove_child(child);
        node.set_name(count == 1 ? "dot" : ("combine" + std::to_string(count)).c_str());
        for (int i = 0; i < count; ++i) {
            Node part = parts[size_t(i)];
            const std::string inputName = count == 1 ? "in" : "in" + std::to_string(i + 1);
            if (const Node copied = inputOf(part, "in")) {
                copyInput(copied, node, inputName.c_str(), "float");
            } else {
                Node input = addInput(node, inputName.c_str(), "float");
                for (const char* attribute : {"value", "nodename"})
                    if (part.attribute(attribute))
                        set(input, attribute, part.attribute(attribute).value());
            }
            node.remove_child(part);
        }
    }

    void atan2(Node node) {
        for (const auto& [old, name] : {std::pair{"in1", "iny"}, std::pair{"in2", "inx"}})
            if (Node input = inputOf(node, old)) set(input, "name", name);
    }

    /// In object space a texel is the normal itself: in * 2 - 1.
    void normalMap(Node node) {
        Node space = inputOf(node, "space");
        if (!space) return;
        const bool object = !std::strcmp(space.attribute("value").value(), "object");
        node.remove_child(space);
        const Node in = inputOf(node, "in");
        if (!object || !in) return;
        const std::string name = node.attribute("name").value();
        Node twice = addNode(node, "multiply", freeName(name + "_twice"), "vector3");
        copyInput(in, twice, "in1", "vector3");
        set(addInput(twice, "in2", "float"), "value", "2");
        Node less = addNode(node, "subtract", freeName(name + "_less"), "vector3");
        set(addInput(less, "in1", "vector3"), "nodename", twice.attribute("name").value());
        set(addInput(less, "in2", "float"), "value", "1");
        node.remove_children();
        node.set_name("normalize");
        set(addInput(node, "in", "vector3"), "nodename", less.attribute("name").value());
    }

    /// A film on top of a layer becomes inputs of the microfacet closures under it.
    void thinFilm(Node layer) {
        const Node top = inputOf(layer, "top"), base = inputOf(layer, "base");
        const Node film = siblingNamed(top, top.attribute("nodename").value());
        if (!top || !film || !is(film, "thin_film_bsdf")) return;
        coat(siblingNamed(base, base.attribute("nodename").value()), film);
        // The layer is its base from now on: a mix that takes all of it.
        pugi::xml_document scratch;
        Node kept = scratch.append_copy(base);
        layer.remove_children();
        layer.set_name("mix");
        copyInput(kept, layer, "fg", "BSDF");
        set(addInput(layer, "mix", "float"), "value", "1");
    }

    /// Gives the film to all closures below a node; chains of them may be of any length.
    void coat(const Node& base, const Node& film) {
        std::vector<Node> open = {base};
        std::set<std::string> seen;
        while (!open.empty()) {
            const Node node = open.back();
            open.pop_back();
            if (!node || !seen.insert(node.attribute("name").value()).second) continue;
            if (is(node, "dielectric_bsdf") || is(node, "conductor_bsdf") ||
                is(node, "generalized_schlick_bsdf")) {
                const Node mode = inputOf(node, "scatter_mode");
                if (mode && !std::strcmp(mode.attribute("value").value(), "T")) continue;
                giveFilm(node, film, "thickness", "thinfilm_thickness", "550");
                giveFilm(node, film, "ior", "thinfilm_ior", "1.5");
                continue;
            }
            for (const Node& child : node.children())
                if (!std::strcmp(child.attribute("type").value(), "BSDF") &&
                    child.attribute("nodename"))
                    open.push_back(siblingNamed(child, child.attribute("nodename").value()));
        }
    }

    static void giveFilm(Node node, const Node& film, const char* from, const char* to,
                         const char* standard) {
        if (inputOf(node, to)) return;
        if (const Node given = inputOf(film, from))
            copyInput(given, node, to, "float");
        else
            set(addInput(node, to, "float"), "value", standard);
    }

    void thinSurface(Node node) {
        node.set_name("surface");
        for (const auto& [old, name] :
             {std::pair{"front_bsdf", "bsdf"}, std::pair{"front_edf", "edf"}})
            if (Node input = inputOf(node, old)) set(input, "name", name);
        Node back = inputOf(node, "back_bsdf"), backLight = inputOf(node, "back_edf");
        if (back || backLight) {
            const std::string name = node.attribute("name").value();
            Node other = addNode(node, "surface", freeName(name + "_back"), "surfaceshader");
            if (back) copyInput(back, other, "bsdf", "BSDF");
            if (backLight) copyInput(backLight, other, "edf", "EDF");
            if (const Node opacity = inputOf(node, "opacity"))
                copyInput(opacity, other, "opacity", "float");
            set(addInput(other, "thin_walled", "boolean"), "value", "true");
            node.remove_child(back);
            node.remove_child(backLight);
            for (Node material : node.parent().children("surfacematerial")) {
                const Node shader = inputOf(material, "surfaceshader");
                if (siblingNamed(shader, shader.attribute("nodename").value()) != node) continue;
                set(addInput(material, "backsurfaceshader", "surfaceshader"), "nodename",
                    other.attribute("name").value());
            }
        }
        set(addInput(node, "thin_walled", "boolean"), "value", "true");
    }

    std::string _path;
    Diagnostics& _diagnostics;
    std::unordered_map<std::string, Node> _siblings; ///< of the scope by name, the first of each
};

} // namespace

void upgradeDocument(pugi::xml_node root, const std::string& path, Diagnostics& diagnostics) {
    Upgrader(path, diagnostics).run(root);
}

} // namespace patina
