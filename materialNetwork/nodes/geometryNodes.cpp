// SPDX-License-Identifier: Apache-2.0
// Nodes that read the surface.
#define PATINA_NODE_FUNCTIONS "shaders/patterns/nodes/geometry.glsl"
#include "materialNetwork/nodes/nodeTable.h"
#include "materialNetwork/nodes/patternFunctions.h"

namespace patina {

namespace {

void prepareSpace(PatternSetup& setup, PatternData& data) {
    const std::string space = setup.text("space");
    data.mode = space == "world" ? sh::SPACE_WORLD : sh::SPACE_OBJECT;
    if (space != "world" && space != "object" && space != "model")
        setup.warn("space", "unknown space '" + space + "'; object space is used");
}

/// Set 0 is "st", as every exporter to USD writes it; set n is "stn".
void prepareTexcoord(PatternSetup& setup, PatternData& data) {
    const int index = int(setup.number("index", 0.0f));
    data.slot = setup.primvarSlot(index > 0 ? "st" + std::to_string(index) : "st", ValueType::Vec2);
}

void prepareGeomColor(PatternSetup& setup, PatternData& data) {
    const int index = int(setup.number("index", 0.0f));
    data.slot = setup.primvarSlot(
        index > 0 ? "displayColor" + std::to_string(index) : "displayColor", ValueType::Color4);
}

void prepareNamed(PatternSetup& setup, PatternData& data, const char* input) {
    const std::string name = setup.text(input);
    const Value* fallback =
        setup.constant(input == std::string("varname") ? "fallback" : "default");
    if (name.empty())
        setup.warn(input, "no primvar is named; the fallback is used");
    else
        data.slot = setup.primvarSlot(name, fallback ? fallback->type : ValueType::Vec4);
}
void prepareGeomprop(PatternSetup& setup, PatternData& data) {
    prepareNamed(setup, data, "geomprop");
}
void prepareVarname(PatternSetup& setup, PatternData& data) {
    prepareNamed(setup, data, "varname");
}

void prepareFallback(PatternSetup& setup, PatternData&) {
    setup.warn("varname", "primvars of this type are not read; the fallback is used");
}
void prepareUniform(PatternSetup& setup, PatternData&) {
    setup.warn("geomprop", "primvars of this type are not read; the default is used");
}

const char* const spaces = "string space=object";

const NodeRow rows[] = {
    {"ND_position_vector3", "position", spaces, "vector3", PATINA_PATTERN(nodePosition),
     Algebra::None, nullptr, prepareSpace},
    {"PatinaBackSide", "back_side", "", "float", PATINA_PATTERN(nodeBackSide)},
    {"ND_normal_vector3", "normal", spaces, "vector3", PATINA_PATTERN(nodeNormal), Algebra::None,
     nullptr, prepareSpace},
    {"ND_tangent_vector3", "tangent", "string space=object, integer index=0", "vector3",
     PATINA_PATTERN(nodeTangent), Algebra::None, nullptr, prepareSpace},
    {"ND_bitangent_vector3", "bitangent", "string space=object, integer index=0", "vector3",
     PATINA_PATTERN(nodeBitangent), Algebra::None, nullptr, prepareSpace},
    {"ND_viewdirection_vector3", "viewdirection", "string space=world", "vector3",
     PATINA_PATTERN(nodeViewDirection), Algebra::None, nullptr, prepareSpace},
    {"ND_texcoord_$", "texcoord", "integer index=0", "$", PATINA_PATTERN(nodeTexcoord),
     Algebra::None, "vector2 vector3", prepareTexcoord},
    {"ND_geomcolor_float", "geomcolor", "integer index=0", "float", PATINA_PATTERN(nodeGeomScalar),
     Algebra::None, nullptr, prepareGeomColor},
    {"ND_geomcolor_$", "geomcolor", "integer index=0", "$", PATINA_PATTERN(nodeGeomColor),
     Algebra::None, "color3 color4", prepareGeomColor},
    {"ND_geompropvalue_$", "geompropvalue", "string geomprop=, $ default=0", "$",
     PATINA_PATTERN(nodeScalarPrimvar), Algebra::None, "float integer boolean", prepareGeomprop},
    {"ND_geompropvalue_$", "geompropvalue", "string geomprop=, $ default=0", "$",
     PATINA_PATTERN(nodeTuplePrimvar), Algebra::None, tupleTypes, prepareGeomprop},
    {"UsdPrimvarReader_float", "UsdPrimvarReader", "string varname=, float fallback=0",
     "float result", PATINA_PATTERN(nodeScalarPrimvar), Algebra::None, nullptr, prepareVarname},
    {"UsdPrimvarReader_int", "UsdPrimvarReader", "string varname=, integer fallback=0",
     "integer result", PATINA_PATTERN(nodeScalarPrimvar), Algebra::None, nullptr, prepareVarname},
    {"UsdPrimvarReader_float2", "UsdPrimvarReader", "string varname=, vector2 fallback=0",
     "vector2 result", PATINA_PATTERN(nodeTuplePrimvar), Algebra::None, nullptr, prepareVarname},
    {"UsdPrimvarReader_$", "UsdPrimvarReader", "string varname=, vector3 fallback=0",
     "vector3 result", PATINA_PATTERN(nodeTuplePrimvar), Algebra::None,
     "float3 point normal vector", prepareVarname},
    {"UsdPrimvarReader_float4", "UsdPrimvarReader", "string varname=, vector4 fallback=0",
     "vector4 result", PATINA_PATTERN(nodeTuplePrimvar), Algebra::None, nullptr, prepareVarname},
    {"UsdPrimvarReader_boolean", "UsdPrimvarReader", "string varname=, boolean fallback=0",
     "boolean result", PATINA_PATTERN(nodeScalarPrimvar), Algebra::None, nullptr, prepareVarname},
    {"UsdPrimvarReader_filename", "UsdPrimvarReader", "string varname=, filename fallback=",
     "filename result", PATINA_PATTERN(nodeNoText), Algebra::None, nullptr, prepareFallback},
    {"ND_geompropvalueuniform_$", "geompropvalueuniform", "string geomprop=, $ default=", "$",
     PATINA_PATTERN(nodeNoText), Algebra::None, "string filename", prepareUniform},
    {"UsdPrimvarReader_string", "UsdPrimvarReader", "string varname=, string fallback=",
     "string result", PATINA_PATTERN(nodeNoText), Algebra::None, nullptr, prepareFallback},
    {"UsdPrimvarReader_matrix", "UsdPrimvarReader", "string varname=, matrix44 fallback=0",
     "matrix44 result", PATINA_PATTERN(nodeFallbackMatrix), Algebra::None, nullptr,
     prepareFallback},
};

} // namespace

NodeRows geometryNodes() {
    return {std::begin(rows), std::end(rows)};
}

} // namespace patina
