// SPDX-License-Identifier: Apache-2.0
// Matrices, one register per row.
#define PATINA_NODE_FUNCTIONS "shaders/patterns/nodes/matrix.glsl"
#include "materialNetwork/nodes/nodeTable.h"
#include "materialNetwork/nodes/patternFunctions.h"

namespace patina {

namespace {

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

} // namespace

NodeRows matrixNodes() {
    return {std::begin(rows), std::end(rows)};
}

} // namespace patina
