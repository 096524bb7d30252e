// SPDX-License-Identifier: Apache-2.0
// Nodes that read the surface.
#include "materialNetwork/nodes/nodeTable.h"

namespace patina {

namespace {

using glm::vec3;
using glm::vec4;
using Call = const PatternCall&;

enum Space { SpaceWorld, SpaceObject };

void prepareSpace(PatternSetup& setup, PatternData& data) {
    const std::string space = setup.text("space");
    data.mode = space == "world" ? SpaceWorld : SpaceObject;
    if (space != "world" && space != "object" && space != "model")
        setup.warn("space", "unknown space '" + space + "'; object space is used");
}

vec3 unit(const vec3& v, const vec3& fallback) {
    const float length = glm::length(v);
    return length > 0.0f ? v / length : fallback;
}

/// Normals go to object space by the transpose of the object's matrix, which is the inverse of the
/// one that brought them out.
vec3 normalTo(Call c, const vec3& n) {
    if (c.data.mode == SpaceWorld) return n;
    return unit(glm::inverse(c.point().objectToWorldNormal) * n, vec3(0, 0, 1));
}

/// Tangents go by the inverse of the object's matrix, which is the transpose of the normals'.
vec3 tangentTo(Call c, const vec3& t) {
    if (c.data.mode == SpaceWorld) return t;
    return unit(glm::transpose(c.point().objectToWorldNormal) * t, vec3(1, 0, 0));
}

constexpr char positionGlsl[] = "nodePosition($m)";
constexpr Pattern position = pattern(positionGlsl, [](Call c) {
    c.out() = vec4(c.data.mode == SpaceWorld ? c.point().worldPosition() : c.point().objectPosition,
                   0.0f);
});

constexpr Pattern normal = pattern("nodeNormal($m, point.normal)", [](Call c) {
    c.out() = vec4(normalTo(c, c.point().normal), 0.0f);
});

constexpr Pattern tangent = pattern("nodeTangent($m, point.tangent)", [](Call c) {
    c.out() = vec4(tangentTo(c, c.point().tangent), 0.0f);
});

constexpr Pattern bitangent = pattern("nodeTangent($m, point.bitangent)", [](Call c) {
    c.out() = vec4(tangentTo(c, c.point().bitangent), 0.0f);
});

constexpr Pattern backSide =
    pattern("vec4(dot(point.view, point.geometricNormal) < 0.0 ? 1.0 : 0.0)", [](Call c) {
        c.out() =
            vec4(glm::dot(c.point().viewDirection, c.point().geometricNormal) < 0.0f ? 1.0f : 0.0f);
    });

constexpr Pattern viewDirection = pattern("nodeTangent($m, point.view)", [](Call c) {
    c.out() = vec4(tangentTo(c, c.point().viewDirection), 0.0f);
});

bool readPrimvar(Call c, float* out) {
    return c.data.slot >= 0 && c.context.point->primvars &&
           c.context.point->primvars->read(c.data.slot, out);
}

constexpr Pattern texcoord = pattern("vec4(primvar($p, vec4(0.0)).xyz, 0.0)", [](Call c) {
    float v[4] = {0, 0, 0, 0};
    readPrimvar(c, v);
    c.out() = vec4(v[0], v[1], v[2], 0.0f);
});

constexpr Pattern scalarPrimvar = pattern("vec4(primvar($p, $1).x)", [](Call c) {
    float v[4] = {c.x(1), 0, 0, 0};
    readPrimvar(c, v);
    c.out() = vec4(v[0]);
});

constexpr Pattern tuplePrimvar = pattern("primvar($p, $1)", [](Call c) {
    vec4 v = c.in(1);
    readPrimvar(c, &v.x);
    c.out() = v;
});

constexpr Pattern geomColor = pattern("primvar($p, vec4(0.0, 0.0, 0.0, 1.0))", [](Call c) {
    vec4 v(0.0f, 0.0f, 0.0f, 1.0f);
    readPrimvar(c, &v.x);
    c.out() = v;
});

constexpr Pattern geomScalar = pattern("vec4(primvar($p, vec4(0.0)).x)", [](Call c) {
    vec4 v(0.0f);
    readPrimvar(c, &v.x);
    c.out() = vec4(v.x);
});

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

/// Primvars of strings and matrices have no consumer among the nodes; their fallback is passed on.
constexpr Pattern fallbackOnly = rarePattern("$1", [](Call c) { c.out() = c.in(1); });
constexpr Pattern fallbackMatrix = rarePattern("4|$B1", [](Call c) {
    for (int i = 0; i < 4; ++i)
        c.out(i) = c.registers[c.inputs[1] + i];
});

void prepareFallback(PatternSetup& setup, PatternData&) {
    setup.warn("varname", "primvars of this type are not read; the fallback is used");
}
void prepareUniform(PatternSetup& setup, PatternData&) {
    setup.warn("geomprop", "primvars of this type are not read; the default is used");
}

const char* const spaces = "string space=object";

const NodeRow rows[] = {
    {"ND_position_vector3", "position", spaces, "vector3", position, Algebra::None, nullptr,
     prepareSpace, true},
    {"PatinaBackSide", "back_side", "", "float", backSide, Algebra::None, nullptr, nullptr, true},
    {"ND_normal_vector3", "normal", spaces, "vector3", normal, Algebra::None, nullptr, prepareSpace,
     true},
    {"ND_tangent_vector3", "tangent", "string space=object, integer index=0", "vector3", tangent,
     Algebra::None, nullptr, prepareSpace, true},
    {"ND_bitangent_vector3", "bitangent", "string space=object, integer index=0", "vector3",
     bitangent, Algebra::None, nullptr, prepareSpace, true},
    {"ND_viewdirection_vector3", "viewdirection", "string space=world", "vector3", viewDirection,
     Algebra::None, nullptr, prepareSpace, true},
    {"ND_texcoord_$", "texcoord", "integer index=0", "$", texcoord, Algebra::None,
     "vector2 vector3", prepareTexcoord, true},
    {"ND_geomcolor_float", "geomcolor", "integer index=0", "float", geomScalar, Algebra::None,
     nullptr, prepareGeomColor, true},
    {"ND_geomcolor_$", "geomcolor", "integer index=0", "$", geomColor, Algebra::None,
     "color3 color4", prepareGeomColor, true},
    {"ND_geompropvalue_$", "geompropvalue", "string geomprop=, $ default=0", "$", scalarPrimvar,
     Algebra::None, "float integer boolean", prepareGeomprop, true},
    {"ND_geompropvalue_$", "geompropvalue", "string geomprop=, $ default=0", "$", tuplePrimvar,
     Algebra::None, tupleTypes, prepareGeomprop, true},
    {"UsdPrimvarReader_float", "UsdPrimvarReader", "string varname=, float fallback=0",
     "float result", scalarPrimvar, Algebra::None, nullptr, prepareVarname, true},
    {"UsdPrimvarReader_int", "UsdPrimvarReader", "string varname=, integer fallback=0",
     "integer result", scalarPrimvar, Algebra::None, nullptr, prepareVarname, true},
    {"UsdPrimvarReader_float2", "UsdPrimvarReader", "string varname=, vector2 fallback=0",
     "vector2 result", tuplePrimvar, Algebra::None, nullptr, prepareVarname, true},
    {"UsdPrimvarReader_$", "UsdPrimvarReader", "string varname=, vector3 fallback=0",
     "vector3 result", tuplePrimvar, Algebra::None, "float3 point normal vector", prepareVarname,
     true},
    {"UsdPrimvarReader_float4", "UsdPrimvarReader", "string varname=, vector4 fallback=0",
     "vector4 result", tuplePrimvar, Algebra::None, nullptr, prepareVarname, true},
    {"UsdPrimvarReader_boolean", "UsdPrimvarReader", "string varname=, boolean fallback=0",
     "boolean result", scalarPrimvar, Algebra::None, nullptr, prepareVarname, true},
    {"UsdPrimvarReader_filename", "UsdPrimvarReader", "string varname=, filename fallback=",
     "filename result", fallbackOnly, Algebra::None, nullptr, prepareFallback, true},
    {"ND_geompropvalueuniform_$", "geompropvalueuniform", "string geomprop=, $ default=", "$",
     fallbackOnly, Algebra::None, "string filename", prepareUniform, true},
    {"UsdPrimvarReader_string", "UsdPrimvarReader", "string varname=, string fallback=",
     "string result", fallbackOnly, Algebra::None, nullptr, prepareFallback, true},
    {"UsdPrimvarReader_matrix", "UsdPrimvarReader", "string varname=, matrix44 fallback=0",
     "matrix44 result", fallbackMatrix, Algebra::None, nullptr, prepareFallback, true},
};

} // namespace

NodeRows geometryNodes() {
    return {std::begin(rows), std::end(rows)};
}

} // namespace patina
