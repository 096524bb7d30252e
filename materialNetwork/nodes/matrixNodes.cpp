// Matrices. A matrix takes one register per row; vectors are rows too and multiply from the left,
// so glm's matrix of the same columns multiplies from the right.
#include "materialNetwork/nodeTable.h"

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

void copy3(Call c) {
    store(c, in3(c, 0));
}
void copy4(Call c) {
    store(c, in4(c, 0));
}
void add3(Call c) {
    store(c, in3(c, 0) + in3(c, 1));
}
void add4(Call c) {
    store(c, in4(c, 0) + in4(c, 1));
}
void addScalar3(Call c) {
    store(c, in3(c, 0) + c.x(1));
}
void addScalar4(Call c) {
    store(c, in4(c, 0) + c.x(1));
}
void subtract3(Call c) {
    store(c, in3(c, 0) - in3(c, 1));
}
void subtract4(Call c) {
    store(c, in4(c, 0) - in4(c, 1));
}
void subtractScalar3(Call c) {
    store(c, in3(c, 0) - c.x(1));
}
void subtractScalar4(Call c) {
    store(c, in4(c, 0) - c.x(1));
}
void multiply3(Call c) {
    store(c, in3(c, 1) * in3(c, 0));
}
void multiply4(Call c) {
    store(c, in4(c, 1) * in4(c, 0));
}
void divide3(Call c) {
    store(c, inverted(in3(c, 1)) * in3(c, 0));
}
void divide4(Call c) {
    store(c, inverted(in4(c, 1)) * in4(c, 0));
}
void transpose3(Call c) {
    store(c, glm::transpose(in3(c, 0)));
}
void transpose4(Call c) {
    store(c, glm::transpose(in4(c, 0)));
}
void invert3(Call c) {
    store(c, inverted(in3(c, 0)));
}
void invert4(Call c) {
    store(c, inverted(in4(c, 0)));
}
void determinant3(Call c) {
    c.out() = vec4(glm::determinant(in3(c, 0)));
}
void determinant4(Call c) {
    c.out() = vec4(glm::determinant(in4(c, 0)));
}

void create3(Call c) {
    for (int i = 0; i < 3; ++i)
        c.out(i) = vec4(vec3(c.in(i)), 0.0f);
}
void create4(Call c) {
    for (int i = 0; i < 4; ++i)
        c.out(i) = vec4(vec3(c.in(i)), i == 3 ? 1.0f : 0.0f);
}
void create4Full(Call c) {
    for (int i = 0; i < 4; ++i)
        c.out(i) = c.in(i);
}

/// A row by its index.
template <int Rows> void extractRow(Call c) {
    c.out() = row(c, 0, glm::clamp(c.whole(1), 0, Rows - 1));
}

template <int Rows> void copyRows(Call c, int input) {
    for (int i = 0; i < Rows; ++i)
        c.out(i) = row(c, input, i);
}
/// Inputs (value1, value2, in1, in2).
template <int Rows> void ifGreater(Call c) {
    copyRows<Rows>(c, c.x(0) > c.x(1) ? 2 : 3);
}
template <int Rows> void ifGreaterEq(Call c) {
    copyRows<Rows>(c, c.x(0) >= c.x(1) ? 2 : 3);
}
template <int Rows> void ifEqual(Call c) {
    copyRows<Rows>(c, c.x(0) == c.x(1) ? 2 : 3);
}
/// Inputs (in1, ..., in10, which).
template <int Rows> void switched(Call c) {
    const float which = std::fmax(std::floor(c.x(10)), 0.0f);
    const bool known = which < 10.0f;
    for (int i = 0; i < Rows; ++i)
        c.out(i) = known ? row(c, int(which), i) : vec4(0.0f);
}

void transformPoint2(Call c) {
    const vec3 v = in3(c, 1) * vec3(vec2(c.in(0)), 1.0f);
    c.out() = vec4(v.x, v.y, 0.0f, 0.0f);
}
void transform3(Call c) {
    c.out() = vec4(in3(c, 1) * vec3(c.in(0)), 0.0f);
}
void transformPoint3(Call c) {
    c.out() = vec4(vec3(in4(c, 1) * vec4(vec3(c.in(0)), 1.0f)), 0.0f);
}
void transform4(Call c) {
    c.out() = in4(c, 1) * c.in(0);
}

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
