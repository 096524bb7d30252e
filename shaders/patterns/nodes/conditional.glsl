// SPDX-License-Identifier: Apache-2.0
// Choices.
#ifndef PATINA_NODE_ROWS

PATINA_FN vec4 nodeIfGreater(float a, float b, vec4 x, vec4 y) {
    return a > b ? x : y;
}
PATINA_FN vec4 nodeIfGreaterEq(float a, float b, vec4 x, vec4 y) {
    return a >= b ? x : y;
}
PATINA_FN vec4 nodeIfEqual(float a, float b, vec4 x, vec4 y) {
    return a == b ? x : y;
}
PATINA_FN bool nodeIsGreater(float a, float b) {
    return a > b;
}
PATINA_FN bool nodeIsGreaterEq(float a, float b) {
    return a >= b;
}
PATINA_FN bool nodeIsEqual(float a, float b) {
    return a == b;
}

PATINA_FN bool nodeAnd(bool a, bool b) {
    return a && b;
}
PATINA_FN bool nodeOr(bool a, bool b) {
    return a || b;
}
PATINA_FN bool nodeXor(bool a, bool b) {
    return a != b;
}
PATINA_FN bool nodeNot(bool a) {
    return !a;
}

// Indices below the first take the first; above the last there is nothing.
PATINA_FN vec4 nodeSwitch(vec4 v0, vec4 v1, vec4 v2, vec4 v3, vec4 v4, vec4 v5, vec4 v6, vec4 v7,
                          vec4 v8, vec4 v9, float which) {
    float i = max(floor(which), 0.0f);
    if (i < 5.0f) return i < 1.0f ? v0 : i < 2.0f ? v1 : i < 3.0f ? v2 : i < 4.0f ? v3 : v4;
    if (i < 10.0f) return i < 6.0f ? v5 : i < 7.0f ? v6 : i < 8.0f ? v7 : i < 9.0f ? v8 : v9;
    return vec4(0.0f);
}

#else // PATINA_NODE_ROWS: rows of the node table, C++ alone

const char* const types = "float integer color3 color4 vector2 vector3 vector4";
#define PATINA_SWITCH_INPUTS                                                                       \
    "$ in1=0, $ in2=0, $ in3=0, $ in4=0, $ in5=0, $ in6=0, $ in7=0, $ in8=0, $ in9=0, $ in10=0, "

const NodeRow rows[] = {
    {"ND_ifgreater_$", "ifgreater", "float value1=1, float value2=0, $ in1=0, $ in2=0", "$",
     PATINA_PATTERN(nodeIfGreater), Algebra::IfGreater, types},
    {"ND_ifgreater_$I", "ifgreater", "integer value1=1, integer value2=0, $ in1=0, $ in2=0", "$",
     PATINA_PATTERN(nodeIfGreater), Algebra::IfGreater, types},
    {"ND_ifgreatereq_$", "ifgreatereq", "float value1=1, float value2=0, $ in1=0, $ in2=0", "$",
     PATINA_PATTERN(nodeIfGreaterEq), Algebra::IfGreaterEq, types},
    {"ND_ifgreatereq_$I", "ifgreatereq", "integer value1=1, integer value2=0, $ in1=0, $ in2=0",
     "$", PATINA_PATTERN(nodeIfGreaterEq), Algebra::IfGreaterEq, types},
    {"ND_ifequal_$", "ifequal", "float value1=0, float value2=0, $ in1=0, $ in2=0", "$",
     PATINA_PATTERN(nodeIfEqual), Algebra::IfEqual, types},
    {"ND_ifequal_$I", "ifequal", "integer value1=0, integer value2=0, $ in1=0, $ in2=0", "$",
     PATINA_PATTERN(nodeIfEqual), Algebra::IfEqual, types},
    {"ND_ifequal_$B", "ifequal", "boolean value1=0, boolean value2=0, $ in1=0, $ in2=0", "$",
     PATINA_PATTERN(nodeIfEqual), Algebra::IfEqual, types},
    {"ND_switch_$", "switch", PATINA_SWITCH_INPUTS "float which=0", "$", PATINA_PATTERN(nodeSwitch),
     Algebra::Switch, types},
    {"ND_switch_$I", "switch", PATINA_SWITCH_INPUTS "integer which=0", "$",
     PATINA_PATTERN(nodeSwitch), Algebra::Switch, types},
    {"ND_ifgreater_boolean", "ifgreater", "float value1=1, float value2=0", "boolean",
     PATINA_PATTERN(nodeIsGreater)},
    {"ND_ifgreater_booleanI", "ifgreater", "integer value1=1, integer value2=0", "boolean",
     PATINA_PATTERN(nodeIsGreater)},
    {"ND_ifgreatereq_boolean", "ifgreatereq", "float value1=1, float value2=0", "boolean",
     PATINA_PATTERN(nodeIsGreaterEq)},
    {"ND_ifgreatereq_booleanI", "ifgreatereq", "integer value1=1, integer value2=0", "boolean",
     PATINA_PATTERN(nodeIsGreaterEq)},
    {"ND_ifequal_boolean", "ifequal", "float value1=1, float value2=0", "boolean",
     PATINA_PATTERN(nodeIsEqual)},
    {"ND_ifequal_booleanI", "ifequal", "integer value1=1, integer value2=0", "boolean",
     PATINA_PATTERN(nodeIsEqual)},
    {"ND_ifequal_booleanB", "ifequal", "boolean value1=0, boolean value2=0", "boolean",
     PATINA_PATTERN(nodeIsEqual)},
    {"ND_logical_and", "and", "boolean in1=0, boolean in2=0", "boolean", PATINA_PATTERN(nodeAnd)},
    {"ND_logical_or", "or", "boolean in1=0, boolean in2=0", "boolean", PATINA_PATTERN(nodeOr)},
    {"ND_logical_xor", "xor", "boolean in1=0, boolean in2=0", "boolean", PATINA_PATTERN(nodeXor)},
    {"ND_logical_not", "not", "boolean in=0", "boolean", PATINA_PATTERN(nodeNot)},
};

#endif
