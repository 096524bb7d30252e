// SPDX-License-Identifier: Apache-2.0
// Nodes that take values apart, put them together and change their type.
#ifndef PATINA_NODE_ROWS

PATINA_FN vec4 nodeOpaque(vec3 x) {
    return vec4(x, 1.0f);
}
PATINA_FN vec3 nodeTwoToThree(vec2 x) {
    return vec3(x, 0.0f);
}
PATINA_FN vec4 nodeOpaqueZero(vec2 x) {
    return vec4(x, 0.0f, 1.0f);
}
PATINA_FN float nodeToInteger(float x) {
    return floor(x);
}
PATINA_FN bool nodeToBoolean(float x) {
    return x != 0.0f;
}

PATINA_FN vec2 nodeCombine2(float a, float b) {
    return vec2(a, b);
}
PATINA_FN vec3 nodeCombine3(float a, float b, float c) {
    return vec3(a, b, c);
}
PATINA_FN vec4 nodeCombine4(float a, float b, float c, float d) {
    return vec4(a, b, c, d);
}
PATINA_FN vec4 nodeCombine31(vec3 a, float b) {
    return vec4(a, b);
}
PATINA_FN vec4 nodeCombine22(vec2 a, vec2 b) {
    return vec4(a, b);
}

PATINA_FN float nodeExtract(vec4 v, int index, NodeSize size) {
    return v[min(max(index, 0), size - 1)];
}

PATINA_FN float nodeSeparate2(vec2 v, PATINA_OUT(float) y) {
    y = v.y;
    return v.x;
}
PATINA_FN float nodeSeparate3(vec3 v, PATINA_OUT(float) y, PATINA_OUT(float) z) {
    y = v.y;
    z = v.z;
    return v.x;
}
PATINA_FN float nodeSeparate4(vec4 v, PATINA_OUT(float) y, PATINA_OUT(float) z,
                              PATINA_OUT(float) w) {
    y = v.y;
    z = v.z;
    w = v.w;
    return v.x;
}

#else // PATINA_NODE_ROWS: rows of the node table, C++ alone

const NodeRow rows[] = {
    {"ND_convert_float_$", "convert", "float in=0", "$", PATINA_PATTERN(patternSame),
     Algebra::Alias, "color3 color4 vector2 vector3 vector4"},
    {"ND_convert_boolean_float", "convert", "boolean in=0", "float", PATINA_PATTERN(patternSame),
     Algebra::Alias},
    {"ND_convert_integer_float", "convert", "integer in=0", "float", PATINA_PATTERN(patternSame),
     Algebra::Alias},
    {"ND_convert_boolean_integer", "convert", "boolean in=0", "integer",
     PATINA_PATTERN(patternSame), Algebra::Alias},
    {"ND_convert_float_integer", "convert", "float in=0", "integer", PATINA_PATTERN(nodeToInteger)},
    {"ND_convert_integer_boolean", "convert", "integer in=0", "boolean",
     PATINA_PATTERN(nodeToBoolean)},
    {"ND_convert_vector3_color3", "convert", "vector3 in=0", "color3", PATINA_PATTERN(patternSame),
     Algebra::Alias},
    {"ND_convert_color3_vector3", "convert", "color3 in=0", "vector3", PATINA_PATTERN(patternSame),
     Algebra::Alias},
    {"ND_convert_vector4_color4", "convert", "vector4 in=0", "color4", PATINA_PATTERN(patternSame),
     Algebra::Alias},
    {"ND_convert_color4_vector4", "convert", "color4 in=0", "vector4", PATINA_PATTERN(patternSame),
     Algebra::Alias},
    {"ND_convert_color4_color3", "convert", "color4 in=0", "color3", PATINA_PATTERN(patternSame),
     Algebra::Alias},
    {"ND_convert_vector4_vector3", "convert", "vector4 in=0", "vector3",
     PATINA_PATTERN(patternSame), Algebra::Alias},
    {"ND_convert_color3_color4", "convert", "color3 in=0", "color4", PATINA_PATTERN(nodeOpaque)},
    {"ND_convert_vector3_vector4", "convert", "vector3 in=0", "vector4",
     PATINA_PATTERN(nodeOpaque)},
    {"ND_convert_vector3_vector2", "convert", "vector3 in=0", "vector2",
     PATINA_PATTERN(patternSame), Algebra::Alias},
    {"ND_convert_vector2_vector3", "convert", "vector2 in=0", "vector3",
     PATINA_PATTERN(nodeTwoToThree)},
    {"ND_convert_boolean_$", "convert", "boolean in=0", "$", PATINA_PATTERN(patternSame),
     Algebra::Alias, "color3 color4 vector2 vector3 vector4"},
    {"ND_convert_integer_$", "convert", "integer in=0", "$", PATINA_PATTERN(patternSame),
     Algebra::Alias, "color3 color4 vector2 vector3 vector4"},
    {"ND_convert_color3_vector2", "convert", "color3 in=0", "vector2", PATINA_PATTERN(patternSame),
     Algebra::Alias},
    {"ND_convert_color4_vector2", "convert", "color4 in=0", "vector2", PATINA_PATTERN(patternSame),
     Algebra::Alias},
    {"ND_convert_vector4_vector2", "convert", "vector4 in=0", "vector2",
     PATINA_PATTERN(patternSame), Algebra::Alias},
    {"ND_convert_color4_vector3", "convert", "color4 in=0", "vector3", PATINA_PATTERN(patternSame),
     Algebra::Alias},
    {"ND_convert_vector4_color3", "convert", "vector4 in=0", "color3", PATINA_PATTERN(patternSame),
     Algebra::Alias},
    {"ND_convert_color3_vector4", "convert", "color3 in=0", "vector4", PATINA_PATTERN(nodeOpaque)},
    {"ND_convert_vector3_color4", "convert", "vector3 in=0", "color4", PATINA_PATTERN(nodeOpaque)},
    {"ND_convert_vector2_color3", "convert", "vector2 in=0", "color3",
     PATINA_PATTERN(nodeTwoToThree)},
    {"ND_convert_vector2_$", "convert", "vector2 in=0", "$", PATINA_PATTERN(nodeOpaqueZero),
     Algebra::None, "color4 vector4"},
    {"ND_combine2_vector2", "combine2", "float in1=0, float in2=0", "vector2",
     PATINA_PATTERN(nodeCombine2)},
    {"ND_combine2_color4CF", "combine2", "color3 in1=0, float in2=0", "color4",
     PATINA_PATTERN(nodeCombine31)},
    {"ND_combine2_vector4VF", "combine2", "vector3 in1=0, float in2=0", "vector4",
     PATINA_PATTERN(nodeCombine31)},
    {"ND_combine2_vector4VV", "combine2", "vector2 in1=0, vector2 in2=0", "vector4",
     PATINA_PATTERN(nodeCombine22)},
    {"ND_combine3_$", "combine3", "float in1=0, float in2=0, float in3=0", "$",
     PATINA_PATTERN(nodeCombine3), Algebra::None, "color3 vector3"},
    {"ND_combine4_$", "combine4", "float in1=0, float in2=0, float in3=0, float in4=0", "$",
     PATINA_PATTERN(nodeCombine4), Algebra::None, "color4 vector4"},
    {"ND_extract_$", "extract", "$ in=0, integer index=0", "float", PATINA_PATTERN(nodeExtract),
     Algebra::None, tupleTypes},
    {"ND_separate2_vector2", "separate2", "vector2 in=0", "float outx, float outy",
     PATINA_PATTERN(nodeSeparate2)},
    {"ND_separate3_color3", "separate3", "color3 in=0", "float outr, float outg, float outb",
     PATINA_PATTERN(nodeSeparate3)},
    {"ND_separate3_vector3", "separate3", "vector3 in=0", "float outx, float outy, float outz",
     PATINA_PATTERN(nodeSeparate3)},
    {"ND_separate4_color4", "separate4", "color4 in=0",
     "float outr, float outg, float outb, float outa", PATINA_PATTERN(nodeSeparate4)},
    {"ND_separate4_vector4", "separate4", "vector4 in=0",
     "float outx, float outy, float outz, float outw", PATINA_PATTERN(nodeSeparate4)},
};

#endif
