// SPDX-License-Identifier: Apache-2.0
// Nodes that read the surface.
#ifndef PATINA_NODE_ROWS

const int SPACE_WORLD = 0;
const int SPACE_OBJECT = 1;

PATINA_FN vec3 unitElse(vec3 v, vec3 fallback) {
    float l = length(v);
    return l > 0.0f ? v / l : fallback;
}
// Tangents go by the inverse of the object's matrix, which is the transpose of the normals'.
PATINA_FN vec3 tangentIn(vec3 t, int space, PATINA_IN(SurfacePoint) p) {
    if (space == SPACE_WORLD) return t;
    return unitElse(transpose(p.objectToWorldNormal) * t, vec3(1.0f, 0.0f, 0.0f));
}

PATINA_FN vec3 nodePosition(NodeMode space, PATINA_IN(SurfacePoint) p) {
    return space == SPACE_WORLD ? worldPositionOf(p) : p.objectPosition;
}
// Normals go to object space by the transpose of the object's matrix, which is the inverse of the
// one that brought them out.
PATINA_FN vec3 nodeNormal(NodeMode space, PATINA_IN(SurfacePoint) p) {
    if (space == SPACE_WORLD) return p.normal;
    return unitElse(inverse(p.objectToWorldNormal) * p.normal, vec3(0.0f, 0.0f, 1.0f));
}
PATINA_FN vec3 nodeTangent(NodeMode space, PATINA_IN(SurfacePoint) p) {
    return tangentIn(p.tangent, space, p);
}
PATINA_FN vec3 nodeBitangent(NodeMode space, PATINA_IN(SurfacePoint) p) {
    return tangentIn(p.bitangent, space, p);
}
// Of another uv set than that of the point. along: dP/du in object space, and the side of the bitangent; 0 where
// the surface has no such set.
PATINA_FN vec3 setTangent(vec4 along, PATINA_IN(SurfacePoint) p) {
    vec3 t = transpose(inverse(p.objectToWorldNormal)) * vec3(along);
    t = t - p.normal * dot(p.normal, t);
    float l = length(t);
    return l > 1e-20f && l < 1e30f ? t / l : vec3(0.0f);
}
PATINA_FN vec3 nodeSetTangent(NodeMode space, NodePrimvarOrZero along, PATINA_IN(SurfacePoint) p) {
    vec3 t = setTangent(along, p);
    return tangentIn(dot(t, t) > 0.0f ? t : p.tangent, space, p);
}
PATINA_FN vec3 nodeSetBitangent(NodeMode space, NodePrimvarOrZero along, PATINA_IN(SurfacePoint) p) {
    vec3 t = setTangent(along, p);
    float side = along.w * determinant(p.objectToWorldNormal) < 0.0f ? -1.0f : 1.0f;
    return tangentIn(dot(t, t) > 0.0f ? cross(p.normal, t) * side : p.bitangent, space, p);
}
PATINA_FN vec3 nodeViewDirection(NodeMode space, PATINA_IN(SurfacePoint) p) {
    return tangentIn(viewOf(p), space, p);
}
PATINA_FN bool nodeBackSide(PATINA_IN(SurfacePoint) p) {
    return dot(viewOf(p), p.geometricNormal) < 0.0f;
}

PATINA_FN vec3 nodeTexcoord(NodePrimvarOrZero set) {
    return vec3(set);
}
PATINA_FN float nodeGeomScalar(NodePrimvarOrZero color) {
    return color.x;
}
PATINA_FN vec4 nodeGeomColor(NodePrimvarOrBlack color) {
    return color;
}
PATINA_FN float nodeScalarPrimvar(NodePrimvar value) {
    return value.x;
}
PATINA_FN vec4 nodeTuplePrimvar(NodePrimvar value) {
    return value;
}

// Primvars of strings and matrices have no consumer among the nodes; their fallback is passed on.
PATINA_FN float nodeNoText() {
    return 0.0f;
}
PATINA_FN mat4 nodeFallbackMatrix(mat4 fallback) {
    return fallback;
}

#else // PATINA_NODE_ROWS: rows of the node table, C++ alone

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
    {"PatinaSetTangent", "set_tangent", "string space=object, string set=", "vector3",
     PATINA_PATTERN(nodeSetTangent), Algebra::None, nullptr, prepareSetTangent},
    {"PatinaSetBitangent", "set_bitangent", "string space=object, string set=", "vector3",
     PATINA_PATTERN(nodeSetBitangent), Algebra::None, nullptr, prepareSetTangent},
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

#endif
