// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/mtlx/parser.h"

#include "base/limits.h"
#include "materialNetwork/mtlx/giveNodes.h"
#include "materialNetwork/mtlx/include.h"
#include "materialNetwork/mtlx/lists.h"
#include "materialNetwork/mtlx/xmlFile.h"
#include "materialNetwork/nodes/nodeTable.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <set>

namespace patina {

namespace {

// Elements of a document that are not nodes.
const std::set<std::string> otherElements = {
    "nodedef",     "nodegraph",  "implementation", "look",     "lookgroup",   "collection",
    "propertyset", "variantset", "typedef",        "geominfo", "geompropdef", "unitdef",
    "unittypedef", "targetdef",  "xi:include",     "input",    "output",      "token",
    "backdrop",    "comment",    "attributedef",   "parameter"};

bool isNode(const pugi::xml_node& element) {
    return element.type() == pugi::node_element && !otherElements.count(element.name());
}

bool isPort(const char* name) {
    return !std::strcmp(name, "input") || !std::strcmp(name, "parameter");
}

/// Of the paths of a graph's nodes.
std::string prefixOf(const pugi::xml_node& graph) {
    return "/" + std::string(graph.attribute("name").value()) + "/";
}

} // namespace

std::string MtlxParser::where(const Element& element) const {
    std::string path;
    for (Element e = element; e && std::strcmp(e.name(), "materialx") != 0; e = e.parent())
        if (!isPort(e.name())) path = "/" + std::string(e.attribute("name").value()) + path;
    return _path + ":" + path;
}

std::string MtlxParser::inherited(const Element& element, const char* attribute) const {
    for (Element e = element; e; e = e.parent())
        if (const auto a = e.attribute(attribute)) return a.value();
    return "";
}

Value MtlxParser::readValue(const Element& port) const {
    Value v;
    v.type = valueTypeFromName(port.attribute("type").value());
    const std::string text = port.attribute("value").value();
    const int n = valueTypeComponents(v.type);
    if (v.type == ValueType::Filename) {
        namespace fs = std::filesystem;
        std::string prefix;
        for (Element e = port; e; e = e.parent())
            prefix = e.attribute("fileprefix").value() + prefix;
        fs::path file(prefix + text);
        const std::string source = inherited(port, sourceAttribute);
        const fs::path document(source.empty() ? _path : source);
        if (!text.empty() && file.is_relative()) file = document.parent_path() / file;
        v.text = text.empty() ? "" : file.lexically_normal().string();
        // Only colours have a colour space; a file says so itself, or is read by a colour node.
        const std::string nodeType = port.parent().attribute("type").value();
        v.colorSpace = nodeType.rfind("color", 0) == 0 || nodeType == "multioutput"
                           ? inherited(port, "colorspace")
                           : port.attribute("colorspace").value();
    } else if (n == 0) {
        v.text = text;
    } else {
        if (!port.attribute("value")) {
            v.numbers.assign(size_t(n), 0.0f);
        } else if (v.type == ValueType::Bool && (text == "true" || text == "false")) {
            v.numbers = {text == "true" ? 1.0f : 0.0f};
        } else if (!readNumbers(text, size_t(n), v.numbers)) {
            // A name may stand for an enumerated value; all else is told of where it is used.
            v.numbers.clear();
            v.type = ValueType::String;
            v.text = text;
        }
        if (v.type == ValueType::Color3 || v.type == ValueType::Color4)
            v.colorSpace = inherited(port, "colorspace");
    }
    return v;
}

void MtlxParser::readDef(const Element& element, NodeDef& def) const {
    def.id = element.attribute("name").value();
    def.category = qualifiedName(element, element.attribute("node").value());
    for (const Element& child : element.children()) {
        if (isPort(child.name())) {
            InputDef input;
            input.name = child.attribute("name").value();
            input.type = valueTypeFromName(child.attribute("type").value());
            input.value = readValue(child);
            input.geomprop = child.attribute("defaultgeomprop").value();
            input.notModelled = child.attribute("patina-not-modelled").value();
            if (const auto values = child.attribute("enumvalues")) {
                const auto names = splitList(child.attribute("enum").value());
                const auto numbers = splitList(values.value());
                for (size_t i = 0; i < std::min(names.size(), numbers.size()); ++i) {
                    input.enumNames.push_back(names[i]);
                    input.enumValues.push_back(float(std::atof(numbers[i].c_str())));
                }
            }
            def.inputs.push_back(std::move(input));
        } else if (!std::strcmp(child.name(), "output")) {
            def.outputs.push_back({child.attribute("name").value(),
                                   valueTypeFromName(child.attribute("type").value())});
        }
    }
    // Up to 1.37 a nodedef named its only output by its own type.
    if (def.outputs.empty())
        def.outputs.push_back({"out", valueTypeFromName(element.attribute("type").value())});
}

/// Resolves a name that an element uses: one of its own namespace before one without.
std::string MtlxParser::referenced(const Element& element, const std::string& name,
                                   const std::map<std::string, Element>& known) const {
    for (const std::string& candidate : {qualifiedName(element, name), name}) {
        const auto found = known.find(candidate);
        if (found != known.end()) return found->second.attribute("name").value();
    }
    return name;
}

std::string MtlxParser::resolveId(const Element& element,
                                  const std::map<std::string, ValueType>& inputTypes) const {
    if (const auto def = element.attribute("nodedef"))
        return referenced(element, def.value(), _defs);
    const std::string category = element.name(), qualified = qualifiedName(element, category);
    const ValueType type = valueTypeFromName(element.attribute("type").value());
    std::string id = findDefinition(qualified, type, inputTypes);
    if (id.empty() && qualified != category) id = findDefinition(category, type, inputTypes);
    // A category is enough: graph() looks models up by it and reports what nobody knows.
    return id.empty() ? category : id;
}

std::string MtlxParser::findDefinition(const std::string& category, ValueType type,
                                       const std::map<std::string, ValueType>& inputTypes) const {
    const ShadingModel* best = nullptr;
    int bestFit = -1;
    const auto [begin, end] = _models.equal_range(category);
    for (auto it = begin; it != end; ++it) {
        const ShadingModel& model = *it->second;
        const bool several = model.def.outputs.size() > 1;
        const int fit = nodeDefFit(model.def, several ? ValueType::Unknown : type, inputTypes);
        if (fit > bestFit) {
            best = &model;
            bestFit = fit;
        }
    }
    const NodeDef* def = NodeTable::get().resolve(category, type, inputTypes);
    if (best && (!def || bestFit >= nodeDefFit(*def, type, inputTypes))) return best->def.id;
    if (def) return def->id;
    // The library's own documents are read while it is made, so only others can ask it.
    if (_useLibrary)
        if (const ShadingModel* model = ModelLibrary::get().resolve(category, type, inputTypes))
            return model->def.id;
    return "";
}

bool MtlxParser::connect(const Element& port, const Scope& scope, Connection& out) {
    const std::string output = port.attribute("output").value();
    if (const auto node = port.attribute("nodename")) {
        const bool topmost = scope.prefix == "/";
        out = {scope.prefix + (topmost ? referenced(port, node.value(), _topmost) : node.value()),
               output};
        return true;
    }
    const auto graphName = port.attribute("nodegraph");
    if (!graphName) return false;
    const auto graph = _graphs.find(referenced(port, graphName.value(), _graphs));
    if (graph == _graphs.end()) {
        _diagnostics.warn(where(port.parent()), port.attribute("name").value(),
                          std::string("node graph '") + graphName.value() +
                              "' does not exist; the default is used");
        return false;
    }
    for (const Element& child : graph->second.children("output"))
        if (output.empty() || output == child.attribute("name").value()) {
            // An output may itself lead to another graph; a circle of those has no end.
            if (++_depth > 64) {
                --_depth;
                return false;
            }
            const Scope inner{graph->second, prefixOf(graph->second), false};
            const bool found = connect(child, inner, out);
            --_depth;
            return found;
        }
    _diagnostics.warn(where(port.parent()), port.attribute("name").value(),
                      std::string("node graph '") + graphName.value() + "' has no output '" +
                          output + "'; the default is used");
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
        if (isPort(child.name()) && interface == child.attribute("name").value()) {
            const Scope outer{scope.element.parent(), "/", false};
            take(child, outer, node, name);
            return true;
        }
    _diagnostics.warn(where(port.parent()), name,
                      "the graph has no input '" + interface + "'; the default is used");
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
        Value value = readValue(port);
        if (hasRoom(value.text.size())) node.inputs[name] = std::move(value);
    }
}

bool MtlxParser::hasRoom(size_t bytes) {
    const uint64_t most = limitOf(Limit::documentBytes);
    if (_bytes > most) return false;
    _bytes += bytes;
    if (_bytes > most)
        _diagnostics.warn(_path, "",
                          "the names and texts of its nodes take more bytes than " +
                              limitText(Limit::documentBytes) + "; what follows is left out");
    return _bytes <= most;
}

void MtlxParser::readNode(const Element& element, const Scope& scope,
                          std::vector<NetworkNode>& nodes) {
    NetworkNode node;
    node.path = scope.prefix + element.attribute("name").value();
    if (!hasRoom(node.path.size())) return;
    std::map<std::string, ValueType> types;
    for (const Element& child : element.children())
        if (isPort(child.name())) {
            types[child.attribute("name").value()] =
                valueTypeFromName(child.attribute("type").value());
            readInput(child, scope, node);
        }
    node.id = resolveId(element, types);
    nodes.push_back(std::move(node));
}

void MtlxParser::readNodes(const Scope& scope, std::vector<NetworkNode>& nodes) {
    for (const Element& child : scope.element.children())
        if (isNode(child)) readNode(child, scope, nodes);
}

void MtlxParser::readModel(const Element& graph, const NodeDef& def, ShadingModel& model) {
    model.def = def;
    const Scope scope{graph, "", true};
    readNodes(scope, model.nodes);
    for (const Element& child : graph.children("output")) {
        Connection c;
        if (connect(child, scope, c)) model.outputs[child.attribute("name").value()] = c;
    }
}

void MtlxParser::indexNames(const Element& root) {
    std::vector<std::pair<Element, std::map<std::string, Element>*>> spaced;
    for (const Element& child : root.children()) {
        const std::string name = child.attribute("name").value();
        const bool isDef = !std::strcmp(child.name(), "nodedef");
        if (isDef || (!std::strcmp(child.name(), "nodegraph") && !child.attribute("nodedef"))) {
            auto& known = isDef ? _defs : _graphs;
            if (qualifiedName(child, name) == name)
                known[name] = child;
            else
                spaced.push_back({child, &known});
        } else if (isNode(child)) {
            _topmost.emplace(name, child);
        }
    }
    // A name that several namespaces have is written with the namespace, but for the first.
    for (auto& [element, known] : spaced) {
        pugi::xml_attribute name = element.attribute("name");
        const std::string qualified = qualifiedName(element, name.value());
        if (!known->emplace(name.value(), element).second) name.set_value(qualified.c_str());
        known->emplace(qualified, element);
    }
}

void MtlxParser::parse(const pugi::xml_node& root, bool wantMaterials, MtlxDocument& out) {
    _useLibrary = wantMaterials;
    indexNames(root);
    std::map<std::string, Element> functional;
    std::set<std::string> implementing; // graphs that implementations name
    for (const Element& child : root.children("nodegraph"))
        if (const auto def = child.attribute("nodedef"))
            functional[referenced(child, def.value(), _defs)] = child;
    for (const Element& child : root.children("implementation")) {
        const auto graph =
            _graphs.find(referenced(child, child.attribute("nodegraph").value(), _graphs));
        if (graph == _graphs.end()) continue;
        functional[referenced(child, child.attribute("nodedef").value(), _defs)] = graph->second;
        implementing.insert(graph->second.attribute("name").value());
    }
    // Their interface is that of the definition.
    for (auto it = _graphs.begin(); it != _graphs.end();)
        it = implementing.count(it->second.attribute("name").value()) ? _graphs.erase(it)
                                                                      : std::next(it);
    // The interfaces come first, because graphs use each other's definitions.
    std::vector<Element> bodies;
    for (const auto& [name, element] : _defs) {
        if (name != element.attribute("name").value()) continue; // known by another name as well
        const auto body = functional.find(name);
        if (body == functional.end()) continue;
        ShadingModel model;
        readDef(element, model.def);
        out.models.push_back(std::move(model));
        bodies.push_back(body->second);
    }
    for (const ShadingModel& model : out.models)
        _models.emplace(model.def.category, &model);
    for (size_t i = 0; i < bodies.size(); ++i) {
        const NodeDef def = out.models[i].def;
        readModel(bodies[i], def, out.models[i]);
    }
    if (wantMaterials) readMaterials(root, out);
}

void MtlxParser::readMaterials(const Element& root, MtlxDocument& out) {
    std::vector<NetworkNode> nodes;
    readNodes({root, "/", false}, nodes);
    for (const auto& [name, element] : _graphs)
        if (name == element.attribute("name").value()) // not known by another name as well
            readNodes({element, prefixOf(element), false}, nodes);
    const auto addMaterial = [&](const std::string& name) -> Network& {
        out.materials.emplace_back();
        out.materials.back().path = _path + ":" + name;
        return out.materials.back();
    };
    // Nodes of other definitions may be materials too.
    for (const Element& child : root.children()) {
        const std::string type = child.attribute("type").value();
        const std::string name = child.attribute("name").value();
        if (!isNode(child)) continue;
        if (type == "lightshader")
            _diagnostics.warn(where(child), "",
                              "lights of documents are not drawn; the node is ignored");
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
    if (out.materials.empty())
        for (const Element& child : root.children())
            if (!std::strcmp(child.attribute("type").value(), "surfaceshader") && isNode(child)) {
                const std::string name = child.attribute("name").value();
                addMaterial(name).terminals["surface"] = {"/" + name, ""};
            }
    if (const size_t leftOut = giveNodes(nodes, out.materials))
        _diagnostics.warn(_path, "",
                          "the materials have more nodes than five times " +
                              limitText(Limit::nodes) + "; " + std::to_string(leftOut) +
                              " of them are left out");
}

} // namespace patina
