// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/mtlx/channels.h"

#include "materialNetwork/mtlx/include.h"
#include "materialNetwork/mtlx/xmlFile.h"
#include "materialNetwork/network/network.h"

#include <cstring>
#include <unordered_map>
#include <vector>

namespace patina {

namespace {

using Element = pugi::xml_node;

bool is(const Element& element, const char* name) {
    return !std::strcmp(element.name(), name);
}

void set(Element element, const char* attribute, const std::string& value) {
    if (!element.attribute(attribute)) element.append_attribute(attribute);
    element.attribute(attribute).set_value(value.c_str());
}

/// Children by name, the first of each. Documents may hold very many.
class Names {
public:
    explicit Names(const Element& scope) {
        for (const Element& child : scope.children())
            if (const auto name = child.attribute("name")) _byName.emplace(name.value(), child);
    }
    /// Resolves a name that an element uses.
    Element find(const Element& from, const std::string& name) const {
        for (const std::string& candidate : {qualifiedName(from, name), name}) {
            const auto found = _byName.find(candidate);
            if (found != _byName.end()) return found->second;
        }
        return Element();
    }
    void add(const std::string& name, const Element& element) { _byName.emplace(name, element); }
    bool has(const std::string& name) const { return _byName.count(name) > 0; }

private:
    std::unordered_map<std::string, Element> _byName;
};

/// @returns the type that has all of these channels; numbers of a connection fit any of its size
std::string typeOfChannels(const std::string& channels) {
    return channels.find_first_of("xyzw") != std::string::npos ? "vector4" : "color4";
}

class ChannelReader {
public:
    ChannelReader(const Element& root, const std::string& path, Diagnostics& diagnostics)
        : _root(root), _all(root), _path(path), _diagnostics(diagnostics) {}

    void run() {
        readScope(_root, _all);
        for (const Element& graph : _root.children("nodegraph")) {
            Names names(graph);
            readScope(graph, names);
        }
    }

private:
    void readScope(const Element& scope, Names& names) {
        std::vector<Element> ports;
        for (const Element& child : scope.children()) {
            if (is(child, "nodedef") || is(child, "nodegraph")) continue;
            if (is(child, "output") && child.attribute("channels")) ports.push_back(child);
            for (const Element& port : child.children())
                if (port.attribute("channels")) ports.push_back(port);
        }
        for (Element port : ports)
            readPort(port, scope, names);
    }

    void readPort(Element port, const Element& scope, Names& names) {
        const std::string channels = port.attribute("channels").value();
        port.remove_attribute("channels");
        const std::string type = sourceType(port, scope, names, channels);
        const std::string wanted = port.attribute("type").value();
        const bool isOutput = is(port, "output");
        const Element owner = isOutput ? port : port.parent();
        if (type.empty()) {
            const std::string name = owner.attribute("name").value();
            _diagnostics.warn(_path + ":/" + name, isOutput ? "" : port.attribute("name").value(),
                              messages::channelsUnknown);
            return;
        }
        if (type == "float" && wanted == "float") return;
        std::string name = owner.attribute("name").value();
        name += "_" + (isOutput ? "channels" : std::string(port.attribute("name").value()));
        if (names.has(name)) name += "_" + std::to_string(++_count);
        Element pick = owner.parent().insert_child_before("swizzle", owner);
        set(pick, "name", name);
        set(pick, "type", wanted);
        // It belongs to the same document.
        for (const char* attribute :
             {"namespace", "colorspace", "fileprefix", sourceAttribute, versionAttribute})
            if (const pugi::xml_attribute own = owner.attribute(attribute))
                set(pick, attribute, own.value());
        names.add(name, pick);
        Element in = pick.append_child("input");
        for (const pugi::xml_attribute& attribute : port.attributes())
            in.append_copy(attribute);
        set(in, "name", "in");
        set(in, "type", type);
        Element which = pick.append_child("input");
        set(which, "name", "channels");
        set(which, "type", "string");
        set(which, "value", channels);
        for (const char* attribute : {"output", "nodegraph", "interfacename", "value"})
            port.remove_attribute(attribute);
        set(port, "nodename", name);
    }

    /// @returns empty where the source is not in sight
    std::string sourceType(const Element& port, const Element& scope, const Names& names,
                           const std::string& channels) const {
        Element source;
        if (const auto node = port.attribute("nodename")) {
            source = names.find(port, node.value());
        } else if (const auto graph = port.attribute("nodegraph")) {
            const std::string output = port.attribute("output").value();
            for (const Element& child : _all.find(port, graph.value()).children("output"))
                if (!source && (output.empty() || output == child.attribute("name").value()))
                    source = child;
        } else if (const auto interface = port.attribute("interfacename")) {
            source = names.find(port, interface.value());
            const Element def = _all.find(scope, scope.attribute("nodedef").value());
            for (const Element& child : def.children())
                if (!source && !std::strcmp(child.attribute("name").value(), interface.value()))
                    source = child;
        } else {
            source = port;
        }
        if (!source) return "";
        const std::string type = source.attribute("type").value();
        if (source == port || type == "multioutput") return typeOfChannels(channels);
        return valueTypeComponents(valueTypeFromName(type)) < 1 ? "" : type;
    }

    Element _root;
    Names _all; ///< of the document
    std::string _path;
    Diagnostics& _diagnostics;
    size_t _count = 0; ///< of names that were taken
};

} // namespace

void channelsToSwizzles(pugi::xml_node root, const std::string& path, Diagnostics& diagnostics) {
    ChannelReader(root, path, diagnostics).run();
}

} // namespace patina
