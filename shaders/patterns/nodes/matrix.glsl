// SPDX-License-Identifier: Apache-2.0
// Matrices. A row of the network is a column here; vectors are rows too and multiply from the left,
// so a matrix of the same columns multiplies from the right, and factors change places.
#ifndef PATINA_NODE_ROWS

PATINA_FN mat3 nodeSame3(mat3 m) {
    return m;
}
PATINA_FN mat3 nodeAdd3(mat3 a, mat3 b) {
    return a + b;
}
PATINA_FN mat3 nodeAddScalar3(mat3 m, float x) {
    return m + x;
}
PATINA_FN mat3 nodeSubtract3(mat3 a, mat3 b) {
    return a - b;
}
PATINA_FN mat3 nodeSubtractScalar3(mat3 m, float x) {
    return m - x;
}
PATINA_FN mat3 nodeMultiply3(mat3 a, mat3 b) {
    return b * a;
}
// A matrix without an inverse has the identity for it. Out of line: it rounds alike wherever it is
// called.
PATINA_FN_RARE mat3 nodeInvert3(mat3 m) {
    float d = determinant(m);
    return d != 0.0f && isFinite(1.0f / d) ? inverse(m) : mat3(1.0f);
}
PATINA_FN mat3 nodeDivide3(mat3 a, mat3 b) {
    return nodeInvert3(b) * a;
}
PATINA_FN mat3 nodeTranspose3(mat3 m) {
    return transpose(m);
}
PATINA_FN float nodeDeterminant3(mat3 m) {
    return determinant(m);
}
PATINA_FN vec3 nodeExtractRow3(mat3 m, int index) {
    return m[min(max(index, 0), 2)];
}
PATINA_FN mat3 nodeIfGreater3(float a, float b, mat3 x, mat3 y) {
    return a > b ? x : y;
}
PATINA_FN mat3 nodeIfGreaterEq3(float a, float b, mat3 x, mat3 y) {
    return a >= b ? x : y;
}
PATINA_FN mat3 nodeIfEqual3(float a, float b, mat3 x, mat3 y) {
    return a == b ? x : y;
}
PATINA_FN mat3 nodeSwitch3(mat3 v0, mat3 v1, mat3 v2, mat3 v3, mat3 v4, mat3 v5, mat3 v6, mat3 v7,
                           mat3 v8, mat3 v9, float which) {
    float i = max(floor(which), 0.0f);
    if (i < 5.0f) return i < 1.0f ? v0 : i < 2.0f ? v1 : i < 3.0f ? v2 : i < 4.0f ? v3 : v4;
    if (i < 10.0f) return i < 6.0f ? v5 : i < 7.0f ? v6 : i < 8.0f ? v7 : i < 9.0f ? v8 : v9;
    return mat3(0.0f);
}

PATINA_FN mat4 nodeSame4(mat4 m) {
    return m;
}
PATINA_FN mat4 nodeAdd4(mat4 a, mat4 b) {
    return a + b;
}
PATINA_FN mat4 nodeAddScalar4(mat4 m, float x) {
    return m + x;
}
PATINA_FN mat4 nodeSubtract4(mat4 a, mat4 b) {
    return a - b;
}
PATINA_FN mat4 nodeSubtractScalar4(mat4 m, float x) {
    return m - x;
}
PATINA_FN mat4 nodeMultiply4(mat4 a, mat4 b) {
    return b * a;
}
// A matrix without an inverse has the identity for it.
PATINA_FN mat4 nodeInvert4(mat4 m) {
    float d = determinant(m);
    return d != 0.0f && isFinite(1.0f / d) ? inverse(m) : mat4(1.0f);
}
PATINA_FN mat4 nodeDivide4(mat4 a, mat4 b) {
    return nodeInvert4(b) * a;
}
PATINA_FN mat4 nodeTranspose4(mat4 m) {
    return transpose(m);
}
PATINA_FN float nodeDeterminant4(mat4 m) {
    return determinant(m);
}
PATINA_FN vec4 nodeExtractRow4(mat4 m, int index) {
    return m[min(max(index, 0), 3)];
}
PATINA_FN mat4 nodeIfGreater4(float a, float b, mat4 x, mat4 y) {
    return a > b ? x : y;
}
PATINA_FN mat4 nodeIfGreaterEq4(float a, float b, mat4 x, mat4 y) {
    return a >= b ? x : y;
}
PATINA_FN mat4 nodeIfEqual4(float a, float b, mat4 x, mat4 y) {
    return a == b ? x : y;
}
PATINA_FN mat4 nodeSwitch4(mat4 v0, mat4 v1, mat4 v2, mat4 v3, mat4 v4, mat4 v5, mat4 v6, mat4 v7,
                           mat4 v8, mat4 v9, float which) {
    float i = max(floor(which), 0.0f);
    if (i < 5.0f) return i < 1.0f ? v0 : i < 2.0f ? v1 : i < 3.0f ? v2 : i < 4.0f ? v3 : v4;
    if (i < 10.0f) return i < 6.0f ? v5 : i < 7.0f ? v6 : i < 8.0f ? v7 : i < 9.0f ? v8 : v9;
    return mat4(0.0f);
}

PATINA_FN mat3 nodeCreate3(vec3 a, vec3 b, vec3 c) {
    return mat3(a, b, c);
}
PATINA_FN mat4 nodeCreate4(vec3 a, vec3 b, vec3 c, vec3 d) {
    return mat4(vec4(a, 0.0f), vec4(b, 0.0f), vec4(c, 0.0f), vec4(d, 1.0f));
}
PATINA_FN mat4 nodeCreateFull4(vec4 a, vec4 b, vec4 c, vec4 d) {
    return mat4(a, b, c, d);
}

PATINA_FN vec2 nodeTransformPoint2(vec2 v, mat3 m) {
    return vec2(m * vec3(v, 1.0f));
}
PATINA_FN vec3 nodeTransform3(vec3 v, mat3 m) {
    return m * v;
}
PATINA_FN vec3 nodeTransformPoint3(vec3 v, mat4 m) {
    return vec3(m * vec4(v, 1.0f));
}
PATINA_FN vec4 nodeTransform4(vec4 v, mat4 m) {
    return m * v;
}

#else // PATINA_NODE_ROWS: rows of the node table, C++ alone

#define PATINA_ONE3 "=1 0 0 0 1 0 0 0 1"
#define PATINA_ONE4 "=1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1"
#define PATINA_MATRICES(name, function3, function4)                                                \
    {"ND_" name "_matrix33", name, "matrix33 in1" PATINA_ONE3 ", matrix33 in2" PATINA_ONE3,        \
     "matrix33", function3},                                                                       \
    {                                                                                              \
        "ND_" name "_matrix44", name, "matrix44 in1" PATINA_ONE4 ", matrix44 in2" PATINA_ONE4,     \
            "matrix44", function4                                                                  \
    }
// The second of a sum is 0 unless it is given, that of a product 1.
#define PATINA_SUMS(name, function3, function4)                                                    \
    {"ND_" name "_matrix33", name, "matrix33 in1" PATINA_ONE3 ", matrix33 in2=0", "matrix33",      \
     function3},                                                                                   \
    {                                                                                              \
        "ND_" name "_matrix44", name, "matrix44 in1" PATINA_ONE4 ", matrix44 in2=0", "matrix44",   \
            function4                                                                              \
    }
#define PATINA_CHOICE(name, suffix, values, function, rule)                                        \
    {"ND_" name "_matrix33" suffix, name, values ", matrix33 in1=0, matrix33 in2=0", "matrix33",   \
     PATINA_PATTERN(function##3),   rule},                                                         \
    {                                                                                              \
        "ND_" name "_matrix44" suffix, name, values ", matrix44 in1=0, matrix44 in2=0",            \
            "matrix44", PATINA_PATTERN(function##4), rule                                          \
    }
#define PATINA_SWITCH                                                                              \
    "$ in1=0, $ in2=0, $ in3=0, $ in4=0, $ in5=0, $ in6=0, $ in7=0, $ in8=0, $ in9=0, $ in10=0, "
#define PATINA_MATRIX_SCALAR(name, function3, function4)                                           \
    {"ND_" name "_matrix33FA", name, "matrix33 in1" PATINA_ONE3 ", float in2=0", "matrix33",       \
     function3},                                                                                   \
    {                                                                                              \
        "ND_" name "_matrix44FA", name, "matrix44 in1" PATINA_ONE4 ", float in2=0", "matrix44",    \
            function4                                                                              \
    }
#define PATINA_MATRIX(name, input, output3, output4, function3, function4)                         \
    {"ND_" name "_matrix33", name, "matrix33 " input PATINA_ONE3, output3, function3}, {           \
        "ND_" name "_matrix44", name, "matrix44 " input PATINA_ONE4, output4, function4            \
    }

const NodeRow rows[] = {
    PATINA_MATRIX("constant", "value", "matrix33", "matrix44", PATINA_PATTERN(nodeSame3),
                  PATINA_PATTERN(nodeSame4)),
    {"ND_dot_matrix33", "dot", "matrix33 in" PATINA_ONE3 ", string note=", "matrix33",
     PATINA_PATTERN(nodeSame3)},
    {"ND_dot_matrix44", "dot", "matrix44 in" PATINA_ONE4 ", string note=", "matrix44",
     PATINA_PATTERN(nodeSame4)},
    PATINA_SUMS("add", PATINA_PATTERN(nodeAdd3), PATINA_PATTERN(nodeAdd4)),
    PATINA_MATRIX_SCALAR("add", PATINA_PATTERN(nodeAddScalar3), PATINA_PATTERN(nodeAddScalar4)),
    PATINA_SUMS("subtract", PATINA_PATTERN(nodeSubtract3), PATINA_PATTERN(nodeSubtract4)),
    PATINA_MATRIX_SCALAR("subtract", PATINA_PATTERN(nodeSubtractScalar3),
                         PATINA_PATTERN(nodeSubtractScalar4)),
    PATINA_MATRICES("multiply", PATINA_PATTERN(nodeMultiply3), PATINA_PATTERN(nodeMultiply4)),
    PATINA_MATRICES("divide", PATINA_PATTERN(nodeDivide3), PATINA_PATTERN(nodeDivide4)),
    PATINA_MATRIX("transpose", "in", "matrix33", "matrix44", PATINA_PATTERN(nodeTranspose3),
                  PATINA_PATTERN(nodeTranspose4)),
    PATINA_MATRIX("invertmatrix", "in", "matrix33", "matrix44", PATINA_PATTERN(nodeInvert3),
                  PATINA_PATTERN(nodeInvert4)),
    PATINA_MATRIX("determinant", "in", "float", "float", PATINA_PATTERN(nodeDeterminant3),
                  PATINA_PATTERN(nodeDeterminant4)),
    PATINA_CHOICE("ifgreater", "", "float value1=1, float value2=0", nodeIfGreater,
                  Algebra::IfGreater),
    PATINA_CHOICE("ifgreater", "I", "integer value1=1, integer value2=0", nodeIfGreater,
                  Algebra::IfGreater),
    PATINA_CHOICE("ifgreatereq", "", "float value1=1, float value2=0", nodeIfGreaterEq,
                  Algebra::IfGreaterEq),
    PATINA_CHOICE("ifgreatereq", "I", "integer value1=1, integer value2=0", nodeIfGreaterEq,
                  Algebra::IfGreaterEq),
    PATINA_CHOICE("ifequal", "", "float value1=0, float value2=0", nodeIfEqual, Algebra::IfEqual),
    PATINA_CHOICE("ifequal", "I", "integer value1=0, integer value2=0", nodeIfEqual,
                  Algebra::IfEqual),
    PATINA_CHOICE("ifequal", "B", "boolean value1=0, boolean value2=0", nodeIfEqual,
                  Algebra::IfEqual),
    {"ND_switch_$", "switch", PATINA_SWITCH "float which=0", "$", PATINA_PATTERN(nodeSwitch3),
     Algebra::Switch, "matrix33"},
    {"ND_switch_$", "switch", PATINA_SWITCH "float which=0", "$", PATINA_PATTERN(nodeSwitch4),
     Algebra::Switch, "matrix44"},
    {"ND_switch_$I", "switch", PATINA_SWITCH "integer which=0", "$", PATINA_PATTERN(nodeSwitch3),
     Algebra::Switch, "matrix33"},
    {"ND_switch_$I", "switch", PATINA_SWITCH "integer which=0", "$", PATINA_PATTERN(nodeSwitch4),
     Algebra::Switch, "matrix44"},
    {"ND_extract_matrix33", "extract", "matrix33 in=0, integer index=0", "vector3",
     PATINA_PATTERN(nodeExtractRow3)},
    {"ND_extract_matrix44", "extract", "matrix44 in=0, integer index=0", "vector4",
     PATINA_PATTERN(nodeExtractRow4)},
    {"ND_creatematrix_vector3_matrix33", "creatematrix",
     "vector3 in1=1 0 0, vector3 in2=0 1 0, vector3 in3=0 0 1", "matrix33",
     PATINA_PATTERN(nodeCreate3)},
    {"ND_creatematrix_vector3_matrix44", "creatematrix",
     "vector3 in1=1 0 0, vector3 in2=0 1 0, vector3 in3=0 0 1, vector3 in4=0", "matrix44",
     PATINA_PATTERN(nodeCreate4)},
    {"ND_creatematrix_vector4_matrix44", "creatematrix",
     "vector4 in1=1 0 0 0, vector4 in2=0 1 0 0, vector4 in3=0 0 1 0, vector4 in4=0 0 0 1",
     "matrix44", PATINA_PATTERN(nodeCreateFull4)},
    {"ND_transformmatrix_vector2M3", "transformmatrix", "vector2 in=0, matrix33 mat" PATINA_ONE3,
     "vector2", PATINA_PATTERN(nodeTransformPoint2)},
    {"ND_transformmatrix_vector3", "transformmatrix", "vector3 in=0, matrix33 mat" PATINA_ONE3,
     "vector3", PATINA_PATTERN(nodeTransform3)},
    {"ND_transformmatrix_vector3M4", "transformmatrix", "vector3 in=0, matrix44 mat" PATINA_ONE4,
     "vector3", PATINA_PATTERN(nodeTransformPoint3)},
    {"ND_transformmatrix_vector4", "transformmatrix", "vector4 in=0, matrix44 mat" PATINA_ONE4,
     "vector4", PATINA_PATTERN(nodeTransform4)},
};

#endif
