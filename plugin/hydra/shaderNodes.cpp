// SPDX-License-Identifier: Apache-2.0
// Tells Sdr of every node that Patina knows: networks then reach Hydra whole, also where OpenUSD
// was built without MaterialX or with an older one.

#include "hdDelegate/hydra/compat.h"

#include "materialNetwork/nodes/models.h"
#include "materialNetwork/nodes/nodeTable.h"

#include <pxr/base/gf/matrix3d.h>
#include <pxr/base/gf/matrix4d.h>
#include <pxr/base/gf/vec2f.h>
#include <pxr/base/gf/vec3f.h>
#include <pxr/base/gf/vec4f.h>
#if PATINA_HAS_SDR_ONLY
#include <pxr/usd/sdr/discoveryPlugin.h>
#include <pxr/usd/sdr/parserPlugin.h>
#else
#include <pxr/usd/ndr/discoveryPlugin.h>
#include <pxr/usd/ndr/parserPlugin.h>
#endif
#include <pxr/usd/sdr/shaderNode.h>
#include <pxr/usd/sdr/shaderProperty.h>

PXR_NAMESPACE_OPEN_SCOPE

namespace {

#if PATINA_HAS_SDR_ONLY
using DiscoveryPlugin = SdrDiscoveryPlugin;
using ParserPlugin = SdrParserPlugin;
using DiscoveryResult = SdrShaderNodeDiscoveryResult;
using DiscoveryResults = SdrShaderNodeDiscoveryResultVec;
using NodePtr = SdrShaderNodeUniquePtr;
using Properties = SdrShaderPropertyUniquePtrVec;
using Tokens = SdrTokenVec;
using TokenMap = SdrTokenMap;
using Options = SdrOptionVec;
using Strings = SdrStringVec;
using Version = SdrVersion;
#define DISCOVER DiscoverShaderNodes
#define PARSE ParseShaderNode
#define INVALID GetInvalidShaderNode
#define REGISTER_DISCOVERY SDR_REGISTER_DISCOVERY_PLUGIN
#define REGISTER_PARSER SDR_REGISTER_PARSER_PLUGIN
#else
using DiscoveryPlugin = NdrDiscoveryPlugin;
using ParserPlugin = NdrParserPlugin;
using DiscoveryResult = NdrNodeDiscoveryResult;
using DiscoveryResults = NdrNodeDiscoveryResultVec;
using NodePtr = NdrNodeUniquePtr;
using Properties = NdrPropertyUniquePtrVec;
using Tokens = NdrTokenVec;
using TokenMap = NdrTokenMap;
using Options = NdrOptionVec;
using Strings = NdrStringVec;
using Version = NdrVersion;
#define DISCOVER DiscoverNodes
#define PARSE Parse
#define INVALID GetInvalidNode
#define REGISTER_DISCOVERY NDR_REGISTER_DISCOVERY_PLUGIN
#define REGISTER_PARSER NDR_REGISTER_PARSER_PLUGIN
#endif

const TfToken& sourceType() {
    static const TfToken type("patina");
    return type;
}

/// Sdr's type of an input or output, and the type of the USD attribute.
struct SdrType {
    TfToken type;
    const char* usd;
};

SdrType sdrType(patina::ValueType type) {
    using patina::ValueType;
    const auto& t = SdrPropertyTypes;
    switch (type) {
    case ValueType::Bool: return {t->Int, "bool"};
    case ValueType::Int: return {t->Int, "int"};
    case ValueType::Float: return {t->Float, "float"};
    case ValueType::Vec2: return {t->Float, "float2"};
    case ValueType::Vec3: return {t->Vector, "vector3f"};
    case ValueType::Vec4: return {t->Color4, "float4"};
    case ValueType::Color3: return {t->Color, "color3f"};
    case ValueType::Color4: return {t->Color4, "color4f"};
    case ValueType::Matrix33: return {t->Matrix, "matrix3d"};
    case ValueType::Matrix44: return {t->Matrix, "matrix4d"};
    case ValueType::String: return {t->String, "string"};
    case ValueType::Filename: return {t->String, "asset"};
    default: return {t->Terminal, "token"};
    }
}

VtValue sdrDefault(const patina::Value& value) {
    using patina::ValueType;
    const auto& n = value.numbers;
    const auto at = [&](size_t i) { return n.empty() ? 0.0f : n[n.size() == 1 ? 0 : i]; };
    switch (value.type) {
    case ValueType::Bool:
    case ValueType::Int: return VtValue(int(at(0)));
    case ValueType::Float: return VtValue(at(0));
    case ValueType::Vec2: return VtValue(GfVec2f(at(0), at(1)));
    case ValueType::Vec3:
    case ValueType::Color3: return VtValue(GfVec3f(at(0), at(1), at(2)));
    case ValueType::Vec4:
    case ValueType::Color4: return VtValue(GfVec4f(at(0), at(1), at(2), at(3)));
    case ValueType::String: return VtValue(value.text);
    default: return VtValue();
    }
}

TfToken contextOf(const patina::NodeDef& def) {
    using patina::ValueType;
    if (def.outputs.empty()) return SdrNodeContext->Pattern;
    switch (def.outputs[0].type) {
    case ValueType::SurfaceShader: return SdrNodeContext->Surface;
    case ValueType::DisplacementShader: return SdrNodeContext->Displacement;
    case ValueType::VolumeShader: return SdrNodeContext->Volume;
    default: return SdrNodeContext->Pattern;
    }
}

/// Inputs that name the primvar which a node reads, in Sdr's words.
std::string primvarsOf(const patina::NodeDef& def) {
    for (const char* name : {"varname", "geomprop"})
        if (def.findInput(name) >= 0) return std::string("$") + name;
    for (const auto& input : def.inputs)
        if (input.geomprop == "UV0") return "st";
    return def.category == "texcoord" ? "st" : "";
}

void addProperty(const std::string& name, patina::ValueType type, const VtValue& value,
                 bool isOutput, Properties& properties) {
    const SdrType sdr = sdrType(type);
    TokenMap metadata;
    if (sdr.type != SdrPropertyTypes->Terminal)
        metadata[SdrPropertyMetadata->SdrUsdDefinitionType] = sdr.usd;
    if (type == patina::ValueType::Filename) metadata[SdrPropertyMetadata->IsAssetIdentifier] = "1";
    const size_t arraySize = type == patina::ValueType::Vec2 ? 2 : 0;
    properties.emplace_back(new SdrShaderProperty(TfToken(name), sdr.type, value, isOutput,
                                                  arraySize, metadata, TokenMap(), Options()));
}

} // namespace

/// Finds the nodes of the table and of the shading models, MaterialX ids only: what USD itself
/// defines (UsdPreviewSurface) is left to it.
class HdPatinaNodeDiscovery final : public DiscoveryPlugin {
public:
    DiscoveryResults DISCOVER(const Context&) override {
        DiscoveryResults found;
        const auto add = [&](const std::string& id, const patina::NodeDef& def) {
            if (id.rfind("ND_", 0) == 0)
                found.emplace_back(TfToken(id), Version(), id, TfToken(def.category), sourceType(),
                                   sourceType(), "patina:" + id, "patina:" + id);
        };
        for (const auto& item : patina::NodeTable::get().ids())
            add(item.first, *item.second);
        for (const auto& model : patina::ModelLibrary::get().all())
            add(model->def.id, model->def);
        return found;
    }
    const Strings& GetSearchURIs() const override {
        static const Strings none;
        return none;
    }
};

/// Makes Sdr's description of such a node.
class HdPatinaNodeParser final : public ParserPlugin {
public:
    NodePtr PARSE(const DiscoveryResult& found) override {
        const patina::NodeDef* def = patina::findNodeDef(found.identifier.GetString());
        if (!def) return INVALID(found);
        Properties properties;
        for (const auto& input : def->inputs)
            addProperty(input.name, input.type, sdrDefault(input.value), false, properties);
        for (const auto& output : def->outputs)
            addProperty(output.name, output.type, VtValue(), true, properties);
        TokenMap metadata;
        const std::string primvars = primvarsOf(*def);
        if (!primvars.empty()) metadata[SdrNodeMetadata->Primvars] = primvars;
        return NodePtr(new SdrShaderNode(found.identifier, found.version, found.name, found.family,
                                         contextOf(*def), sourceType(), found.resolvedUri,
                                         found.resolvedUri, std::move(properties), metadata));
    }
    const Tokens& GetDiscoveryTypes() const override {
        static const Tokens types = {sourceType()};
        return types;
    }
    const TfToken& GetSourceType() const override { return sourceType(); }
};

REGISTER_DISCOVERY(HdPatinaNodeDiscovery)
REGISTER_PARSER(HdPatinaNodeParser)

PXR_NAMESPACE_CLOSE_SCOPE
