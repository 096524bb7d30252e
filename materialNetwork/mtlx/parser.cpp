// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/mtlx/parser.h"

#include "base/limits.h"
#include "materialNetwork/mtlx/giveNodes.h"
#include "materialNetwork/network/geomprop.h"
#include "materialNetwork/network/upgrade.h"

#include <cstring>
#include <set>

namespace patina {

namespace {

// Elements of a document that are not nodes.
const std::set<std::string> otherElements = {
    "nodedef",     "nodegraph",  "implementation", "look",     "lookgroup",   "collection",
    "propertyset", "variantset", "typedef",        "geominfo", "geompropdef", "unitdef",
    "unittypedef", "targetdef",  "xi:include",     "input",    "output",      "token",
    "backdrop",    "comment",    "attributedef",   "parameter"};

/// Outputs that lead to other outputs, and nodes that inherit from others: a circle has no end.
constexpr int mostFollowed = 64;

/// Of the paths of a graph's nodes.
std::string prefixOf(const pugi::xml_node& graph) {
    return "/" + std::string(graph.attribute("name").value()) + "/";
}

} // namespace

bool MtlxParser::isNode(const Element& element) {
    return element.type() == pugi::node_element && !otherElements.count(element.name());
}

bool MtlxParser::isPort(const Element& element) {
    return !std::strcmp(element.name(), "input") || !std::strcmp(element.name(), "parameter");
}

std::string MtlxParser::where(const Element& element) const {
    std::string path;
    for (Element e = element; e && std::strcmp(e.name(), "materialx") != 0; e = e.parent())
        if (!isPort(e)) path = "/" + std::string(e.attribute("name").value()) + path;
    return _path + ":" + path;
}

bool MtlxParser::connect(const Element& port, const Scope& scope, Connection& out) {
    const std::string output = port.attribute("output").value();
    if (const auto node = port.attribute("nodename")) {
        const bool topmost = scope.prefix == "/";
        out = {scope.prefix + (topmost ? referenced(port, node.value(), _topmost) : node.value()),
               output};
        return true;
    }
    const auto follow = [&](const Element& to, const Scope& inner) {
        if (_depth == mostFollowed) return false;
        ++_depth;
        const bool found = connect(to, inner, out);
        --_depth;
        return found;
    };
    const auto graphName = port.attribute("nodegraph");
    if (!graphName) { // an output of the document itself
        if (output.empty()) return false;
        const auto found = _outputs.find(referenced(port, output, _outputs));
        if (found != _outputs.end())
            return follow(found->second, {found->second.parent(), "/", false});
        _diagnostics.warn(where(port.parent()), port.attribute("name").value(),
                          messages::documentOutputMissing(output));
        return false;
    }
    const auto graph = _graphs.find(referenced(port, graphName.value(), _graphs));
    if (graph == _graphs.end()) {
        _diagnostics.warn(where(port.parent()), port.attribute("name").value(),
                          messages::nodeGraphMissing(graphName.value()));
        return false;
    }
    const Element first = graph->second.child("output");
    const bool isOnly = first && !first.next_sibling("output"); // whatever it is called
    for (const Element& child : graph->second.children("output"))
        if (isOnly || output.empty() || output == child.attribute("name").value())
            return follow(child, {graph->second, prefixOf(graph->second), false});
    _diagnostics.warn(where(port.parent()), port.attribute("name").value(),
                      messages::nodeGraphWithoutOutput(graphName.value(), output));
    return false;
}

bool MtlxParser::connectInterface(const Element& port, const Scope& scope, NetworkNode& node,
                                  const std::string& name) {
    const std::string interface = port.attribute("interfacename").value();
    if (interface.empty()) return false;
    if (scope.functional) {
        node.connections[name] = {ShadingModel::interfaceNode, interface};
        return true;
    }
    for (const Element& child : scope.element.children())
        if (isPort(child) && interface == child.attribute("name").value()) {
            const Scope outer{scope.element.parent(), "/", false};
            take(child, outer, node, name);
            return true;
        }
    _diagnostics.warn(where(port.parent()), name, messages::graphWithoutInput(interface));
    return true;
}

void MtlxParser::readInput(const Element& input, const Scope& scope, NetworkNode& node) {
    const std::string name = input.attribute("name").value();
    if (connectInterface(input, scope, node, name)) return;
    take(input, scope, node, name);
}

void MtlxParser::take(const Element& port, const Scope& scope, NetworkNode& node,
                      const std::string& name) {
    Connection c;
    if (connect(port, scope, c)) {
        if (hasRoom(c.node.size())) node.connections[name] = std::move(c);
    } else if (port.attribute("value")) {
        Value value = readValue(port, node.id, name);
        if (hasRoom(value.text.size())) node.inputs[name] = std::move(value);
    } else if (const auto geomprop = port.attribute("defaultgeomprop");
               geomprop && !scope.functional) {
        const auto custom = _geomprops.find(geomprop.value());
        NetworkNode source =
            geompropNode(custom == _geomprops.end() ? geomprop.value() : custom->second);
        if (source.id.empty()) return;
        node.connections[name] = {source.path, ""};
        _geompropNodes.emplace(source.path, std::move(source));
    }
}

bool MtlxParser::hasRoom(size_t bytes) {
    const uint64_t most = limitOf(Limit::documentBytes);
    if (_bytes > most) return false;
    _bytes += bytes;
    if (_bytes > most)
        _diagnostics.warn(_path, "",
                          messages::documentTextTooLong(limitText(Limit::documentBytes)));
    return _bytes <= most;
}

std::vector<pugi::xml_node> MtlxParser::portsOf(const Element& element) {
    std::vector<Element> ports;
    std::set<std::string> nearer;
    Element from = element;
    for (int depth = 0; depth < mostFollowed; ++depth) {
        const size_t own = ports.size();
        for (const Element& child : from.children())
            if (const char* name = child.attribute("name").value();
                isPort(child) && !nearer.count(name)) {
                if (depth > 0 && !hasRoom(1 + std::strlen(name))) return ports;
                ports.push_back(child);
            }
        const auto inherit = from.attribute("inherit");
        if (!inherit) break;
        // Only elements of the document are inherited.
        const auto above = _topmost.find(referenced(from, inherit.value(), _topmost));
        if (above == _topmost.end()) {
            _diagnostics.warn(where(from), "inherit",
                              messages::nodeToInheritMissing(inherit.value()));
            break;
        }
        for (size_t i = own; i < ports.size(); ++i)
            nearer.insert(ports[i].attribute("name").value());
        from = above->second;
    }
    return ports;
}

void MtlxParser::readNode(const Element& element, const Scope& scope,
                          std::vector<NetworkNode>& nodes) {
    NetworkNode node;
    node.path = scope.prefix + element.attribute("name").value();
    if (!hasRoom(node.path.size())) return;
    const std::vector<Element> ports = portsOf(element);
    std::map<std::string, ValueType> types;
    for (const Element& port : ports)
        types[port.attribute("name").value()] = valueTypeFromName(port.attribute("type").value());
    node.id = resolveId(element, types);
    for (const Element& port : ports) {
        const Element owner = port.parent();
        readInput(port, owner == element ? scope : Scope{owner.parent(), "/", scope.functional},
                  node);
    }
    readTokens(element, node);
    if (isBefore139(element)) _before139.insert(node.path);
    nodes.push_back(std::move(node));
}

void MtlxParser::readNodes(const Scope& scope, std::vector<NetworkNode>& nodes) {
    for (const Element& child : scope.element.children())
        if (isNode(child)) readNode(child, scope, nodes);
}

/// Tokens that the node's definition has; others are of use to the node's own file names alone.
void MtlxParser::readTokens(const Element& element, NetworkNode& node) {
    const auto def = _defExtras.find(node.id);
    if (def == _defExtras.end()) return;
    for (const Element& token : element.children("token")) {
        const std::string name = token.attribute("name").value();
        if (def->second.tokens.count(name) && hasRoom(name.size()))
            node.inputs[ShadingModel::tokenInput(name)] =
                Value::makeString(token.attribute("value").value());
    }
}

void MtlxParser::parse(const Element& root, bool wantMaterials, MtlxDocument& out) {
    _useLibrary = wantMaterials;
    readUnits(root);
    readGeomprops(root);
    indexNames(root);
    readExtras();
    readDefinitions(root, out);
    if (wantMaterials) readMaterials(root, out);
}

void MtlxParser::readMaterials(const Element& root, MtlxDocument& out) {
    std::vector<NetworkNode> nodes;
    readNodes({root, "/", false}, nodes);
    for (const auto& [name, element] : _graphs)
        if (name == element.attribute("name").value()) // not known by another name as well
            readNodes({element, prefixOf(element), false}, nodes);
    for (const auto& [path, node] : _geompropNodes)
        nodes.push_back(node);
    const auto addMaterial = [&](const std::string& name) -> Network& {
        out.materials.emplace_back();
        out.materials.back().path = _path + ":" + name;
        return out.materials.back();
    };
    for (const Element& old : root.children("material"))
        if (old.child("shaderref")) _diagnostics.warn(where(old), "", messages::materialElementOld);
    // Nodes of other definitions may be materials too.
    for (const Element& child : root.children()) {
        const std::string type = child.attribute("type").value();
        const std::string name = child.attribute("name").value();
        if (!isNode(child)) continue;
        if (type == "material" && std::strcmp(child.name(), "surfacematerial") != 0 &&
            std::strcmp(child.name(), "volumematerial") != 0)
            addMaterial(name).terminals["surface"] = {"/" + name, ""};
    }
    for (const NetworkNode& node : nodes) {
        if (node.id != "ND_surfacematerial" && node.id != "ND_volumematerial") continue;
        Network& material = addMaterial(node.path.substr(1));
        for (const auto& [input, terminal] : {std::pair{"surfaceshader", "surface"},
                                              std::pair{"displacementshader", "displacement"},
                                              std::pair{"volumeshader", "volume"}}) {
            const auto c = node.connections.find(input);
            if (c != node.connections.end()) material.terminals[terminal] = c->second;
        }
        // Which side is seen is for the material to choose.
        if (node.connections.count("backsurfaceshader"))
            material.terminals["surface"] = {node.path, ""};
    }
    const bool shadersAlone = out.materials.empty();
    for (const Element& child : root.children()) {
        const std::string type = child.attribute("type").value();
        const std::string name = child.attribute("name").value();
        if (!isNode(child) || (type != "surfaceshader" && type != "lightshader")) continue;
        if (shadersAlone)
            addMaterial(name).terminals["surface"] = {"/" + name, ""};
        else if (type == "lightshader")
            _diagnostics.warn(where(child), "", messages::documentLights);
    }
    if (const size_t leftOut = giveNodes(nodes, out.materials))
        _diagnostics.warn(_path, "",
                          messages::documentNodesTooMany(limitText(Limit::nodes), leftOut));
    const auto before139 = [&](const std::string& path) { return _before139.count(path) > 0; };
    for (Network& material : out.materials)
        upgradeNodes(material.nodes, material.terminals, before139, _diagnostics);
}

} // namespace patina
