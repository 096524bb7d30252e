// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/hydra/networkConversion.h"

#include "hdDelegate/hydra/values.h"

#include "materialNetwork/network/translate.h"
#include "materialNetwork/nodes/models.h"

#include <pxr/base/tf/stringUtils.h>
#include <pxr/base/vt/dictionary.h>
#include <pxr/imaging/hd/material.h>
#include <pxr/usd/sdf/assetPath.h>

#include <algorithm>
#include <cstdlib>
#include <unordered_map>

namespace patina {

namespace {

constexpr const char* colorSpacePrefix = "colorSpace:";
constexpr const char* typeNamePrefix = "typeName:";

ValueType typeOfNumbers(const VtValue& given, int components) {
    if (given.IsHolding<bool>()) return ValueType::Bool;
    switch (components) {
    case 1:
        return given.IsHolding<int>() || given.IsHolding<unsigned int>() ||
                       given.IsHolding<int64_t>()
                   ? ValueType::Int
                   : ValueType::Float;
    case 2: return ValueType::Vec2;
    case 3: return ValueType::Vec3;
    case 4: return ValueType::Vec4;
    case 9: return ValueType::Matrix33;
    case 16: return ValueType::Matrix44;
    default: return ValueType::Unknown;
    }
}

std::string parameterText(const std::map<TfToken, VtValue>& parameters, const std::string& name) {
    const auto found = parameters.find(TfToken(name));
    return found == parameters.end() ? std::string() : textOf(found->second);
}

/// The configuration of a network, which releases of OpenUSD before MaterialXConfigAPI have not.
template <class Map> auto configOf(const Map& map, int) -> decltype(&map.config) {
    return &map.config;
}
template <class Map> const VtDictionary* configOf(const Map&, long) {
    return nullptr;
}

/// Whether a network is of MaterialX 1.38, as those are that do not say otherwise.
bool isBefore139(const HdMaterialNetworkMap& map) {
    std::string version = "1.38";
    if (const VtDictionary* config = configOf(map, 0)) {
        const auto found = config->find("mtlx:version");
        if (found != config->end()) version = textOf(found->second);
    }
    return version.compare(0, 2, "1.") == 0 && std::atoi(version.c_str() + 2) < 39;
}

/// Scene indices name nodes within their material.
std::string nodePath(const SdfPath& path, const SdfPath& material) {
    return path.IsAbsolutePath() || path.IsEmpty() ? path.GetString()
                                                   : material.AppendPath(path).GetString();
}

/// Hydra keeps C++ types only: a colour and a vector are one until the definition is asked.
void refineType(const NodeDef* def, const std::string& input, Value& value) {
    const int i = def ? def->findInput(input) : -1;
    if (i < 0) return;
    const ValueType wanted = def->inputs[size_t(i)].type;
    const bool isText = value.type == ValueType::String || value.type == ValueType::Filename;
    const bool wantsText = wanted == ValueType::String || wanted == ValueType::Filename;
    if (isText ? wantsText : valueTypeComponents(wanted) == int(value.numbers.size()) && !wantsText)
        value.type = wanted;
}

/// A texture's sourceColorSpace, where the host gives it as the colour space of the file.
[[maybe_unused]] void moveColorSpace(NetworkNode& node) {
    const auto file = node.inputs.find("file");
    if (node.id != "UsdUVTexture" || file == node.inputs.end()) return;
    std::string& space = file->second.colorSpace;
    if ((space != "raw" && space != "sRGB" && space != "auto") ||
        !node.inputs.emplace("sourceColorSpace", Value::makeString(space)).second)
        return;
    space.clear();
}

/// The nodes that are not Patina's own, while one network is read.
class OtherNodes {
public:
    explicit OtherNodes(HdPatinaDocumentNodes& nodes) : _nodes(nodes) {}
    const NodeDef* definitionOf(const std::string& id) {
        if (const NodeDef* def = findNodeDef(id)) return def;
        const ShadingModel* model = _nodes.find(id, diagnostics);
        _areUsed |= model != nullptr;
        return model ? &model->def : nullptr;
    }
    void expandIn(Network& network) {
        if (_areUsed) network = _nodes.expandIn(network, diagnostics);
    }
    Diagnostics diagnostics;

private:
    HdPatinaDocumentNodes& _nodes;
    bool _areUsed = false;
};

void addNode(const HdMaterialNode& given, const SdfPath& material, HdPatinaRenderParam& param,
             OtherNodes& others, Network& network) {
    NetworkNode node;
    node.path = nodePath(given.path, material);
    node.id = given.identifier.GetString();
    const NodeDef* def = others.definitionOf(node.id);
    if (def && !findNodeDef(node.id)) node.id = def->id;
    for (const auto& item : given.parameters) {
        const std::string& name = item.first.GetString();
        if (describesAnother(name)) continue;
        Value value;
        if (valueOf(item.second, parameterText(given.parameters, typeNamePrefix + name),
                    parameterText(given.parameters, colorSpacePrefix + name), value))
            refineType(def, name, value), node.inputs[name] = std::move(value);
        else
            param.warn(SdfPath(node.path), name,
                       messages::valueTypeUnusable(item.second.GetTypeName()));
    }
#if PATINA_HAS_FILE_COLOR_SPACES
    moveColorSpace(node);
#endif
    network.nodes.push_back(std::move(node));
}

} // namespace

bool describesAnother(const std::string& parameter) {
    return TfStringStartsWith(parameter, colorSpacePrefix) ||
           TfStringStartsWith(parameter, typeNamePrefix);
}

bool valueOf(const VtValue& given, const std::string& typeName, const std::string& colorSpace,
             Value& value) {
    value = Value();
    value.colorSpace = colorSpace;
    if (given.IsHolding<SdfAssetPath>()) {
        value.type = ValueType::Filename;
        value.text = textOf(given);
        return true;
    }
    if (given.IsHolding<TfToken>() || given.IsHolding<std::string>()) {
        value.type = ValueType::String;
        value.text = textOf(given);
        return true;
    }
    if (given.IsArrayValued()) return false;
    int components = 0;
    value.numbers = floatsOf(given, components);
    value.type = typeOfNumbers(given, components);
    if (value.type == ValueType::Unknown) return false;
    const ValueType named = valueTypeFromName(typeName);
    if (named != ValueType::Unknown && valueTypeComponents(named) == components) value.type = named;
    return true;
}

Network networkOf(const VtValue& resource, const SdfPath& material, HdPatinaRenderParam& param) {
    Network network;
    network.path = material.GetString();
    if (!resource.IsHolding<HdMaterialNetworkMap>()) {
        param.warn(material, "", messages::materialNotShown);
        return network;
    }
    const HdMaterialNetworkMap& map = resource.UncheckedGet<HdMaterialNetworkMap>();
    OtherNodes others(param.documentNodes());
    std::unordered_map<std::string, size_t> places; // in network.nodes, by path
    for (const auto& terminal : map.map) {
        const HdMaterialNetwork& part = terminal.second;
        if (part.nodes.empty()) continue;
        // Terminals may share nodes.
        for (const HdMaterialNode& node : part.nodes)
            if (places.emplace(nodePath(node.path, material), network.nodes.size()).second)
                addNode(node, material, param, others, network);
        for (const HdMaterialRelationship& relation : part.relationships) {
            const auto place = places.find(nodePath(relation.outputId, material));
            if (place == places.end()) continue;
            // Hydra's input is where a value comes from.
            network.nodes[place->second].connections[relation.outputName.GetString()] = {
                nodePath(relation.inputId, material), relation.inputName.GetString()};
        }
        // The last node is the terminal's. Which of its outputs is not told.
        const std::string name = terminal.first.GetString();
        const NodeDef* def = others.definitionOf(part.nodes.back().identifier.GetString());
        std::string output = name;
        if (def && !def->outputs.empty())
            output = def->outputs[size_t(std::max(def->findOutput(name), 0))].name;
        network.terminals[name] = {nodePath(part.nodes.back().path, material), output};
    }
    if (isBefore139(map)) upgradeNetwork(network, others.diagnostics);
    others.expandIn(network);
    for (const Diagnostic& d : others.diagnostics.all())
        param.warn(SdfPath::IsValidPathString(d.prim) ? SdfPath(d.prim) : material, d.input,
                   d.what);
    if (network.terminals.empty()) param.warn(material, "", messages::materialNotShown);
    return network;
}

} // namespace patina
