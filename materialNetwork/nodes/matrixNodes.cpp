// SPDX-License-Identifier: Apache-2.0
// Matrices. A matrix takes one register per row; vectors are rows too and multiply from the left,
// so glm's matrix of the same columns multiplies from the right.
#include "materialNetwork/nodes/nodeTable.h"

#include <glm/gtc/matrix_inverse.hpp>

#include <cmath>

namespace patina {

namespace {

using glm::mat3;
using glm::mat4;
using glm::vec2;
using glm::vec3;
using glm::vec4;
using Call = const PatternCall&;

const vec4& row(Call c, int input, int i) {
    return c.registers[c.inputs[input] + i];
}
mat3 in3(Call c, int i) {
    return mat3(vec3(row(c, i, 0)), vec3(row(c, i, 1)), vec3(row(c, i, 2)));
}
mat4 in4(Call c, int i) {
    return mat4(row(c, i, 0), row(c, i, 1), row(c, i, 2), row(c, i, 3));
}
void store(Call c, const mat3& m) {
    for (int i = 0; i < 3; ++i)
        c.out(i) = vec4(m[i], 0.0f);
}
void store(Call c, const mat4& m) {
    for (int i = 0; i < 4; ++i)
        c.out(i) = m[i];
}

/// A matrix without an inverse has none: the identity stands for it.
template <class M> M inverted(const M& m) {
    const float d = glm::determinant(m);
    return d != 0.0f && std::isfinite(1.0f / d) ? glm::inverse(m) : M(1.0f);
}

constexpr char copy3Glsl[] = "3|$A0";
constexpr Pattern copy3 = rarePattern(copy3Glsl, [](Call c) { store(c, in3(c, 0)); });
constexpr Pattern copy4 = rarePattern("4|$B0", [](Call c) { store(c, in4(c, 0)); });
constexpr Pattern add3 =
    rarePattern("3|$A0 + $A1", [](Call c) { store(c, in3(c, 0) + in3(c, 1)); });
constexpr Pattern add4 =
    rarePattern("4|$B0 + $B1", [](Call c) { store(c, in4(c, 0) + in4(c, 1)); });
constexpr Pattern addScalar3 =
    rarePattern("3|$A0 + $1.x", [](Call c) { store(c, in3(c, 0) + c.x(1)); });
constexpr Pattern addScalar4 =
    rarePattern("4|$B0 + $1.x", [](Call c) { store(c, in4(c, 0) + c.x(1)); });
constexpr Pattern subtract3 =
    rarePattern("3|$A0 - $A1", [](Call c) { store(c, in3(c, 0) - in3(c, 1)); });
constexpr Pattern subtract4 =
    rarePattern("4|$B0 - $B1", [](Call c) { store(c, in4(c, 0) - in4(c, 1)); });
constexpr Pattern subtractScalar3 =
    rarePattern("3|$A0 - $1.x", [](Call c) { store(c, in3(c, 0) - c.x(1)); });
constexpr Pattern subtractScalar4 =
    rarePattern("4|$B0 - $1.x", [](Call c) { store(c, in4(c, 0) - c.x(1)); });
constexpr Pattern multiply3 =
    rarePattern("3|$A1 * $A0", [](Call c) { store(c, in3(c, 1) * in3(c, 0)); });
constexpr Pattern multiply4 =
    rarePattern("4|$B1 * $B0", [](Call c) { store(c, in4(c, 1) * in4(c, 0)); });
constexpr Pattern divide3 = rarePattern("3|nodeInverse($A1) * $A0",
                                        [](Call c) { store(c, inverted(in3(c, 1)) * in3(c, 0)); });
void divided4(Call c) {
    store(c, inverted(in4(c, 1)) * in4(c, 0));
}
constexpr Pattern divide4 = rarePattern("4|nodeInverse($B1) * $B0", divided4);
constexpr Pattern transpose3 =
    rarePattern("3|transpose($A0)", [](Call c) { store(c, glm::transpose(in3(c, 0))); });
constexpr Pattern transpose4 =
    rarePattern("4|transpose($B0)", [](Call c) { store(c, glm::transpose(in4(c, 0))); });
constexpr Pattern invert3 =
    rarePattern("3|nodeInverse($A0)", [](Call c) { store(c, inverted(in3(c, 0))); });
constexpr Pattern invert4 =
    rarePattern("4|nodeInverse($B0)", [](Call c) { store(c, inverted(in4(c, 0))); });
constexpr Pattern determinant3 = rarePattern(
    "vec4(determinant($A0))", [](Call c) { c.out() = vec4(glm::determinant(in3(c, 0))); });
constexpr Pattern determinant4 = rarePattern(
    "vec4(determinant($B0))", [](Call c) { c.out() = vec4(glm::determinant(in4(c, 0))); });

constexpr Pattern create3 =
    rarePattern("vec4($0.xyz, 0.0); vec4($1.xyz, 0.0); vec4($2.xyz, 0.0)", [](Call c) {
        for (int i = 0; i < 3; ++i)
            c.out(i) = vec4(vec3(c.in(i)), 0.0f);
    });

constexpr Pattern create4 = rarePattern(
    "vec4($0.xyz, 0.0); vec4($1.xyz, 0.0); vec4($2.xyz, 0.0); vec4($3.xyz, 1.0)", [](Call c) {
        for (int i = 0; i < 4; ++i)
            c.out(i) = vec4(vec3(c.in(i)), i == 3 ? 1.0f : 0.0f);
    });

constexpr Pattern create4Full = rarePattern("$0; $1; $2; $3", [](Call c) {
    for (int i = 0; i < 4; ++i)
        c.out(i) = c.in(i);
});

/// A row by its index.
template <int Rows> constexpr const char* extractRowGlsl =
    Rows == 3 ? "vec4($A0[clamp(nodeWhole($1.x), 0, 2)], 0.0)"
              : "$B0[clamp(nodeWhole($1.x), 0, 3)]";
template <int Rows> constexpr Pattern extractRow = rarePattern(extractRowGlsl<Rows>, [](Call c) {
    c.out() = row(c, 0, glm::clamp(c.whole(1), 0, Rows - 1));
});

template <int Rows> void copyRows(Call c, int input) {
    for (int i = 0; i < Rows; ++i)
        c.out(i) = row(c, input, i);
}
/// Inputs (value1, value2, in1, in2).
template <int Rows> constexpr Pattern
    ifGreater = rarePattern(Rows == 3 ? "3|$0.x > $1.x ? $A2 : $A3" : "4|$0.x > $1.x ? $B2 : $B3",
                            [](Call c) { copyRows<Rows>(c, c.x(0) > c.x(1) ? 2 : 3); });
template <int Rows> constexpr Pattern ifGreaterEq =
    rarePattern(Rows == 3 ? "3|$0.x >= $1.x ? $A2 : $A3" : "4|$0.x >= $1.x ? $B2 : $B3",
                [](Call c) { copyRows<Rows>(c, c.x(0) >= c.x(1) ? 2 : 3); });
template <int Rows> constexpr Pattern
    ifEqual = rarePattern(Rows == 3 ? "3|$0.x == $1.x ? $A2 : $A3" : "4|$0.x == $1.x ? $B2 : $B3",
                          [](Call c) { copyRows<Rows>(c, c.x(0) == c.x(1) ? 2 : 3); });
/// Inputs (in1, ..., in10, which).
template <int Rows> constexpr Pattern switched = rarePattern(
    Rows == 3
        ? "3|nodeSwitch3(${10}.x, mat3[10]($A0, $A1, $A2, $A3, $A4, $A5, $A6, $A7, $A8, $A9))"
        : "4|nodeSwitch4(${10}.x, mat4[10]($B0, $B1, $B2, $B3, $B4, $B5, $B6, $B7, $B8, $B9))",
    [](Call c) {
        const float which = std::fmax(std::floor(c.x(10)), 0.0f);
        const bool known = which < 10.0f;
        for (int i = 0; i < Rows; ++i)
            c.out(i) = known ? row(c, int(which), i) : vec4(0.0f);
    });

constexpr Pattern transformPoint2 =
    rarePattern("vec4(($A1 * vec3($0.xy, 1.0)).xy, 0.0, 0.0)", [](Call c) {
        const vec3 v = in3(c, 1) * vec3(vec2(c.in(0)), 1.0f);
        c.out() = vec4(v.x, v.y, 0.0f, 0.0f);
    });

constexpr Pattern transform3 = rarePattern(
    "vec4($A1 * $0.xyz, 0.0)", [](Call c) { c.out() = vec4(in3(c, 1) * vec3(c.in(0)), 0.0f); });
constexpr Pattern transformPoint3 =
    rarePattern("vec4(($B1 * vec4($0.xyz, 1.0)).xyz, 0.0)",
                [](Call c) { c.out() = vec4(vec3(in4(c, 1) * vec4(vec3(c.in(0)), 1.0f)), 0.0f); });
constexpr Pattern transform4 =
    rarePattern("$B1 * $0", [](Call c) { c.out() = in4(c, 1) * c.in(0); });

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
    {"ND_" name "_matrix33" suffix,                                                                \
     name,                                                                                         \
     values ", matrix33 in1=0, matrix33 in2=0",                                                    \
     "matrix33",                                                                                   \
     function<3>,                                                                                  \
     rule},                                                                                        \
    {                                                                                              \
        "ND_" name "_matrix44" suffix, name, values ", matrix44 in1=0, matrix44 in2=0",            \
            "matrix44", function<4>, rule                                                          \
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
    PATINA_MATRIX("constant", "value", "matrix33", "matrix44", copy3, copy4),
    {"ND_dot_matrix33", "dot", "matrix33 in" PATINA_ONE3 ", string note=", "matrix33", copy3},
    {"ND_dot_matrix44", "dot", "matrix44 in" PATINA_ONE4 ", string note=", "matrix44", copy4},
    PATINA_SUMS("add", add3, add4),
    PATINA_MATRIX_SCALAR("add", addScalar3, addScalar4),
    PATINA_SUMS("subtract", subtract3, subtract4),
    PATINA_MATRIX_SCALAR("subtract", subtractScalar3, subtractScalar4),
    PATINA_MATRICES("multiply", multiply3, multiply4),
    PATINA_MATRICES("divide", divide3, divide4),
    PATINA_MATRIX("transpose", "in", "matrix33", "matrix44", transpose3, transpose4),
    PATINA_MATRIX("invertmatrix", "in", "matrix33", "matrix44", invert3, invert4),
    PATINA_MATRIX("determinant", "in", "float", "float", determinant3, determinant4),
    PATINA_CHOICE("ifgreater", "", "float value1=1, float value2=0", ifGreater, Algebra::IfGreater),
    PATINA_CHOICE("ifgreater", "I", "integer value1=1, integer value2=0", ifGreater,
                  Algebra::IfGreater),
    PATINA_CHOICE("ifgreatereq", "", "float value1=1, float value2=0", ifGreaterEq,
                  Algebra::IfGreaterEq),
    PATINA_CHOICE("ifgreatereq", "I", "integer value1=1, integer value2=0", ifGreaterEq,
                  Algebra::IfGreaterEq),
    PATINA_CHOICE("ifequal", "", "float value1=0, float value2=0", ifEqual, Algebra::IfEqual),
    PATINA_CHOICE("ifequal", "I", "integer value1=0, integer value2=0", ifEqual, Algebra::IfEqual),
    PATINA_CHOICE("ifequal", "B", "boolean value1=0, boolean value2=0", ifEqual, Algebra::IfEqual),
    {"ND_switch_$", "switch", PATINA_SWITCH "float which=0", "$", switched<3>, Algebra::Switch,
     "matrix33"},
    {"ND_switch_$", "switch", PATINA_SWITCH "float which=0", "$", switched<4>, Algebra::Switch,
     "matrix44"},
    {"ND_switch_$I", "switch", PATINA_SWITCH "integer which=0", "$", switched<3>, Algebra::Switch,
     "matrix33"},
    {"ND_switch_$I", "switch", PATINA_SWITCH "integer which=0", "$", switched<4>, Algebra::Switch,
     "matrix44"},
    {"ND_extract_matrix33", "extract", "matrix33 in=0, integer index=0", "vector3", extractRow<3>},
    {"ND_extract_matrix44", "extract", "matrix44 in=0, integer index=0", "vector4", extractRow<4>},
    {"ND_creatematrix_vector3_matrix33", "creatematrix",
     "vector3 in1=1 0 0, vector3 in2=0 1 0, vector3 in3=0 0 1", "matrix33", create3},
    {"ND_creatematrix_vector3_matrix44", "creatematrix",
     "vector3 in1=1 0 0, vector3 in2=0 1 0, vector3 in3=0 0 1, vector3 in4=0", "matrix44", create4},
    {"ND_creatematrix_vector4_matrix44", "creatematrix",
     "vector4 in1=1 0 0 0, vector4 in2=0 1 0 0, vector4 in3=0 0 1 0, vector4 in4=0 0 0 1",
     "matrix44", create4Full},
    {"ND_transformmatrix_vector2M3", "transformmatrix", "vector2 in=0, matrix33 mat" PATINA_ONE3,
     "vector2", transformPoint2},
    {"ND_transformmatrix_vector3", "transformmatrix", "vector3 in=0, matrix33 mat" PATINA_ONE3,
     "vector3", transform3},
    {"ND_transformmatrix_vector3M4", "transformmatrix", "vector3 in=0, matrix44 mat" PATINA_ONE4,
     "vector3", transformPoint3},
    {"ND_transformmatrix_vector4", "transformmatrix", "vector4 in=0, matrix44 mat" PATINA_ONE4,
     "vector4", transform4},
};

} // namespace

NodeRows matrixNodes() {
    return {std::begin(rows), std::end(rows)};
}

} // namespace patina
