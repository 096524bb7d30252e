// SPDX-License-Identifier: Apache-2.0
// Node definitions of a document, and the definitions that its nodes ask for.
#include "materialNetwork/mtlx/parser.h"

#include "materialNetwork/mtlx/include.h"
#include "materialNetwork/mtlx/lists.h"
#include "materialNetwork/mtlx/xmlFile.h"
#include "materialNetwork/network/geomprop.h"
#include "materialNetwork/network/upgrade.h"
#include "materialNetwork/nodes/nodeTable.h"

#include <algorithm>
#include <cstring>
#include <set>

namespace patina {

namespace {

/// Takes the place of what is inherited of that name, or is added.
template <class Def> class Heirs {
public:
    explicit Heirs(std::vector<Def>& defs) : _defs(defs) {
        for (size_t i = 0; i < defs.size(); ++i)
            _places.emplace(defs[i].name, i);
    }
    void put(Def def) {
        const auto inherited = _places.find(def.name);
        if (inherited == _places.end())
            _defs.push_back(std::move(def));
        else
            _defs[inherited->second] = std::move(def);
    }

private:
    std::vector<Def>& _defs;
    std::map<std::string, size_t> _places;
};

constexpr int mostInherited = 16; ///< definitions that inherit from each other

} // namespace

InputDef MtlxParser::readInputDef(const Element& element, const std::string& id) {
    InputDef input;
    input.name = element.attribute("name").value();
    input.type = valueTypeFromName(element.attribute("type").value());
    input.value = readValue(element, id, input.name);
    const auto geomprop = _geomprops.find(element.attribute("defaultgeomprop").value());
    input.geomprop = geomprop == _geomprops.end() ? element.attribute("defaultgeomprop").value()
                                                  : geomprop->second;
    input.notModelled = element.attribute("patina-not-modelled").value();
    if (const auto values = element.attribute("enumvalues")) {
        const auto names = splitList(element.attribute("enum").value());
        const auto numbers = splitList(values.value());
        for (size_t i = 0; i < std::min(names.size(), numbers.size()); ++i) {
            input.enumNames.push_back(names[i]);
            input.enumValues.push_back(float(std::atof(numbers[i].c_str())));
        }
    }
    return input;
}

void MtlxParser::readDef(const Element& element, NodeDef& def, int depth) {
    if (const auto parent = element.attribute("inherit")) {
        const auto known = _defs.find(referenced(element, parent.value(), _defs));
        if (known != _defs.end() && depth < mostInherited)
            readDef(known->second, def, depth + 1);
        else if (const NodeDef* library = _useLibrary ? findNodeDef(parent.value()) : nullptr)
            def = *library;
        else
            _diagnostics.warn(where(element), "inherit",
                              messages::definitionMissing(parent.value()));
    }
    if (!hasRoom(sizeof(InputDef) * def.inputs.size())) def.inputs.clear();
    Heirs<InputDef> inputs(def.inputs);
    Heirs<OutputDef> outputs(def.outputs);
    def.id = element.attribute("name").value();
    // Some documents write nodename, as their nodes do.
    const auto node = element.attribute("node");
    def.category = qualifiedName(element, (node ? node : element.attribute("nodename")).value());
    for (const Element& child : element.children()) {
        if (isPort(child)) {
            inputs.put(readInputDef(child, def.id));
        } else if (!std::strcmp(child.name(), "token")) {
            InputDef token;
            token.name = ShadingModel::tokenInput(child.attribute("name").value());
            token.type = ValueType::String;
            token.value = Value::makeString(child.attribute("value").value());
            inputs.put(std::move(token));
        } else if (!std::strcmp(child.name(), "output")) {
            outputs.put({child.attribute("name").value(),
                         valueTypeFromName(child.attribute("type").value())});
        }
    }
    // Up to 1.37 a nodedef named its only output by its own type.
    if (def.outputs.empty())
        def.outputs.push_back({"out", valueTypeFromName(element.attribute("type").value())});
}

void MtlxParser::readGeomprops(const Element& root) {
    for (const Element& child : root.children("geompropdef")) {
        const auto text = [&](const char* attribute) {
            const std::string value = child.attribute(attribute).value();
            return value.find('/') == std::string::npos ? value : "";
        };
        const std::string name = child.attribute("name").value();
        const std::string custom = customGeomprop(text("name"), text("type"), text("geomprop"),
                                                  text("space"), text("index"));
        if (NodeTable::get().find(geompropNode(custom).id))
            _geomprops[name] = custom;
        else
            _diagnostics.warn(where(child), "geomprop", messages::geompropMissing);
    }
}

void MtlxParser::readExtras() {
    for (const auto& [name, def] : _defs) {
        Element element = def;
        for (int depth = 0; depth <= mostInherited; ++depth) {
            for (const Element& child : element.children()) {
                const std::string input = child.attribute("name").value();
                if (const auto unit = child.attribute("unit"))
                    _defExtras[name].units.emplace(input, unit.value());
                if (!std::strcmp(child.name(), "token")) _defExtras[name].tokens.insert(input);
            }
            const auto parent = element.attribute("inherit");
            const auto above = _defs.find(referenced(element, parent.value(), _defs));
            if (!parent || above == _defs.end()) break;
            element = above->second;
        }
    }
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
    const std::string version = element.attribute("version").value();
    std::string id = findDefinition(element, qualified, type, inputTypes, version);
    if (id.empty() && qualified != category)
        id = findDefinition(element, category, type, inputTypes, version);
    // A category is enough: graph() looks models up by it and reports what nobody knows.
    return id.empty() ? category : id;
}

std::string MtlxParser::findDefinition(const Element& element, const std::string& category,
                                       ValueType type,
                                       const std::map<std::string, ValueType>& inputTypes,
                                       const std::string& version) const {
    BestModel best(type, inputTypes, version);
    const auto [begin, end] = _models.equal_range(category);
    for (auto it = begin; it != end; ++it)
        best.offer(*it->second);
    const NodeDef* def = NodeTable::get().resolve(category, type, inputTypes);
    if (best.model() && (!def || best.fit() >= nodeDefFit(*def, type, inputTypes))) {
        const std::string& found = best.model()->version;
        if (!version.empty() && !found.empty() && found != version)
            _diagnostics.warn(where(element), "version",
                              messages::versionMissing(version, category, found));
        return best.model()->def.id;
    }
    if (def) return def->id;
    // The library's own documents are read while it is made, so only others can ask it.
    if (_useLibrary)
        if (const ShadingModel* model =
                ModelLibrary::get().resolve(category, type, inputTypes, version))
            return model->def.id;
    return "";
}

void MtlxParser::readModel(const Element& graph, ShadingModel& model) {
    const Scope scope{graph, "", true};
    readNodes(scope, model.nodes);
    for (const Element& child : graph.children("output")) {
        Connection c;
        if (connect(child, scope, c)) model.outputs[child.attribute("name").value()] = c;
    }
    const bool old = isBefore139(graph);
    upgradeNodes(
        model.nodes, model.outputs, [&](const std::string&) { return old; }, _diagnostics);
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
        } else if (!std::strcmp(child.name(), "output")) {
            _outputs.emplace(name, child);
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

void MtlxParser::readDefinitions(const Element& root, MtlxDocument& out) {
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
        readDef(element, model.def, 0);
        model.version = element.attribute("version").value();
        model.isDefaultVersion = element.attribute("isdefaultversion").as_bool();
        out.models.push_back(std::move(model));
        bodies.push_back(body->second);
    }
    for (const ShadingModel& model : out.models)
        _models.emplace(model.def.category, &model);
    for (size_t i = 0; i < bodies.size(); ++i)
        readModel(bodies[i], out.models[i]);
}

} // namespace patina
