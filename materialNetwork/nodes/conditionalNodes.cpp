// SPDX-License-Identifier: Apache-2.0
// Choices.
#define PATINA_NODE_FUNCTIONS "shaders/patterns/nodes/conditional.glsl"
#include "materialNetwork/nodes/nodeTable.h"
#include "materialNetwork/nodes/patternFunctions.h"

namespace patina {

namespace {

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

} // namespace

NodeRows conditionalNodes() {
    return {std::begin(rows), std::end(rows)};
}

} // namespace patina
