// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/nodes/nodeTable.h"

#include <cstdlib>
#include <sstream>

namespace patina {

namespace {

std::string replaceAll(std::string text, const std::string& type) {
    for (size_t at = text.find('$'); at != std::string::npos; at = text.find('$', at))
        text.replace(at, 1, type);
    return text;
}

std::vector<std::string> split(const std::string& text, char separator) {
    std::vector<std::string> parts;
    std::istringstream stream(text);
    for (std::string part; std::getline(stream, part, separator);) {
        const size_t first = part.find_first_not_of(' ');
        if (first != std::string::npos)
            parts.push_back(part.substr(first, part.find_last_not_of(' ') - first + 1));
    }
    return parts;
}

Value parseDefault(ValueType type, const std::string& text) {
    Value v;
    v.type = type;
    const int n = valueTypeComponents(type);
    if (n == 0) {
        v.text = text;
        return v;
    }
    std::istringstream stream(text);
    for (float x; stream >> x;)
        v.numbers.push_back(x);
    const float fill = v.numbers.empty() ? 0.0f : v.numbers.back();
    v.numbers.resize(size_t(n), fill);
    return v;
}

InputDef parseInput(const std::string& text) {
    InputDef input;
    const size_t space = text.find(' ');
    const size_t equals = text.find('=');
    input.type = valueTypeFromName(text.substr(0, space));
    const size_t nameEnd = equals == std::string::npos ? text.size() : equals;
    input.name = text.substr(space + 1, nameEnd - space - 1);
    const std::string value = equals == std::string::npos ? "" : text.substr(equals + 1);
    if (!value.empty() && value[0] == '@') input.geomprop = value.substr(1);
    if (value.find('|') != std::string::npos) input.words = split(value, '|');
    std::string standard = input.words.empty() ? value : input.words[0];
    for (std::string& word : input.words)
        if (word[0] == '*') standard = word = word.substr(1);
    input.value = parseDefault(input.type, input.geomprop.empty() ? standard : "");
    return input;
}

} // namespace

int NodeDef::findInput(const std::string& name) const {
    for (size_t i = 0; i < inputs.size(); ++i)
        if (inputs[i].name == name) return int(i);
    return -1;
}

int NodeDef::findOutput(const std::string& name) const {
    if (name.empty()) return outputs.empty() ? -1 : 0;
    for (size_t i = 0; i < outputs.size(); ++i)
        if (outputs[i].name == name) return int(i);
    // USD writes "out" or "surface" for nodes with one output, whatever the definition calls it.
    if (outputs.size() == 1) return 0;
    // MaterialX's name for the output of a shader that has a second one here.
    return name == "out" && !outputs.empty() && isClosureType(outputs[0].type) ? 0 : -1;
}

bool isTextType(ValueType type) {
    return type == ValueType::String || type == ValueType::Filename;
}

bool isClosureType(ValueType type) {
    return type >= ValueType::Bsdf;
}

int wordIndex(const InputDef& input, const std::string& text) {
    for (size_t i = 0; i < input.words.size(); ++i)
        if (input.words[i] == text) return int(i);
    return 0;
}

const NodeTable& NodeTable::get() {
    static const NodeTable table;
    return table;
}

NodeTable::NodeTable() {
    for (const NodeRows& rows :
         {mathNodes(), vectorNodes(), channelNodes(), conditionalNodes(), geometryNodes(),
          textureNodes(), usdNodes(), helperNodes(), noiseNodes(), shapeNodes(), colorNodes(),
          placedImageNodes(), hexTileNodes(), matrixNodes(), spaceNodes(), differenceNodes(),
          closureNodes(), hairNodes(), legacyNodes()})
        for (const NodeRow* row = rows.begin; row != rows.end; ++row)
            add(*row);

    // Names of MaterialX 1.38 and of the talk of 2020 that first showed these nodes.
    alias("ND_diffuse_brdf", "ND_oren_nayar_diffuse_bsdf");
    alias("ND_oren_nayar_diffuse_brdf", "ND_oren_nayar_diffuse_bsdf");
    alias("ND_burley_diffuse_brdf", "ND_burley_diffuse_bsdf");
    alias("ND_dielectric_brdf", "ND_dielectric_bsdf");
    alias("ND_conductor_brdf", "ND_conductor_bsdf");
    alias("ND_generalized_schlick_brdf", "ND_generalized_schlick_bsdf");
    alias("ND_diffuse_btdf", "ND_translucent_bsdf");
    alias("ND_subsurface_brdf", "ND_subsurface_bsdf");
    alias("ND_sheen_brdf", "ND_sheen_bsdf");
    alias("ND_thin_film_brdf", "ND_thin_film_bsdf");
    alias("ND_multiply_bsdf_color3", "ND_multiply_bsdfC");
    alias("ND_multiply_bsdf_float", "ND_multiply_bsdfF");
    alias("ND_normalmap", "ND_normalmap_float");
    alias("ND_geompropvalue_string", "ND_geompropvalueuniform_string");
    for (const char* type : {"float", "float2", "float3", "float4", "int", "string", "point",
                             "normal", "vector", "matrix", "boolean", "filename"}) {
        const std::string id = std::string("UsdPrimvarReader_") + type;
        if (find(id)) alias(("ND_" + id).c_str(), id.c_str());
    }
    alias("ND_UsdPrimvarReader_integer", "UsdPrimvarReader_int");
    alias("ND_UsdPrimvarReader_vector2", "UsdPrimvarReader_float2");
    alias("ND_UsdPrimvarReader_vector3", "UsdPrimvarReader_float3");
    alias("ND_UsdPrimvarReader_vector4", "UsdPrimvarReader_float4");
    alias("ND_UsdTransform2d_23", "UsdTransform2d");
    alias("ND_UsdTransform2d", "UsdTransform2d");
    alias("ND_UsdUVTexture_23", "ND_UsdUVTexture");
    alias("ND_UsdUVTexture_22", "ND_UsdUVTexture");
}

void NodeTable::alias(const char* name, const char* id) {
    if (const NodeDef* def = find(id)) _byId.emplace(name, def);
}

void NodeTable::add(const NodeRow& row) {
    if (!row.types) {
        addOne(row, "");
        return;
    }
    for (const std::string& type : split(row.types, ' '))
        addOne(row, type);
}

void NodeTable::addOne(const NodeRow& row, const std::string& type) {
    auto def = std::make_unique<NodeDef>();
    def->id = replaceAll(row.id, type);
    def->category = row.category;
    for (const std::string& text : split(replaceAll(row.inputs, type), ','))
        def->inputs.push_back(parseInput(text));
    for (const std::string& text : split(replaceAll(row.outputs, type), ',')) {
        const size_t space = text.find(' ');
        def->outputs.push_back({space == std::string::npos ? "out" : text.substr(space + 1),
                                valueTypeFromName(text.substr(0, space))});
    }
    def->pattern = row.pattern.function ? &row.pattern : nullptr;
    def->prepare = row.prepare;
    def->algebra = row.algebra;
    def->varying = row.prepare || row.pattern.varies();
    def->closure = row.closure;
    _byId.emplace(def->id, def.get());
    _byCategory.emplace(def->category, def.get());
    _defs.push_back(std::move(def));
}

const NodeDef* NodeTable::find(const std::string& id) const {
    const auto found = _byId.find(id);
    return found == _byId.end() ? nullptr : found->second;
}

int nodeDefFit(const NodeDef& def, ValueType outputType,
               const std::map<std::string, ValueType>& inputTypes) {
    if (outputType != ValueType::Unknown &&
        (def.outputs.empty() || def.outputs[0].type != outputType || def.outputs.size() > 1))
        return -1;
    int fit = 0;
    for (const auto& [name, type] : inputTypes) {
        const int i = def.findInput(name);
        if (i < 0) continue;
        fit += def.inputs[size_t(i)].type == type ? 2 : -1;
    }
    return fit < 0 ? 0 : fit;
}

const NodeDef* NodeTable::resolve(const std::string& category, ValueType outputType,
                                  const std::map<std::string, ValueType>& inputTypes) const {
    const NodeDef* best = nullptr;
    int bestFit = -1;
    const auto range = _byCategory.equal_range(category);
    for (auto it = range.first; it != range.second; ++it) {
        const int fit = nodeDefFit(*it->second, outputType, inputTypes);
        if (fit > bestFit) {
            best = it->second;
            bestFit = fit;
        }
    }
    return best ? best : find("ND_" + category) ? find("ND_" + category) : find(category);
}

} // namespace patina
