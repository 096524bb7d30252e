// SPDX-License-Identifier: Apache-2.0
// Choices.
#include "materialNetwork/nodes/nodeTable.h"

#include <cmath>

namespace patina {

namespace {

using glm::vec4;
using Call = const PatternCall&;

constexpr char ifGreaterGlsl[] = "$0.x > $1.x ? $2 : $3";
constexpr Pattern ifGreater =
    pattern(ifGreaterGlsl, [](Call c) { c.out() = c.x(0) > c.x(1) ? c.in(2) : c.in(3); });
constexpr Pattern ifGreaterEq = pattern(
    "$0.x >= $1.x ? $2 : $3", [](Call c) { c.out() = c.x(0) >= c.x(1) ? c.in(2) : c.in(3); });
constexpr Pattern ifEqual = pattern("$0.x == $1.x ? $2 : $3",
                                    [](Call c) { c.out() = c.x(0) == c.x(1) ? c.in(2) : c.in(3); });
constexpr Pattern isGreater = pattern(
    "vec4($0.x > $1.x ? 1.0 : 0.0)", [](Call c) { c.out() = vec4(c.x(0) > c.x(1) ? 1.0f : 0.0f); });
constexpr Pattern isGreaterEq = pattern("vec4($0.x >= $1.x ? 1.0 : 0.0)", [](Call c) {
    c.out() = vec4(c.x(0) >= c.x(1) ? 1.0f : 0.0f);
});

constexpr Pattern isEqual = pattern("vec4($0.x == $1.x ? 1.0 : 0.0)",
                                    [](Call c) { c.out() = vec4(c.x(0) == c.x(1) ? 1.0f : 0.0f); });
constexpr Pattern logicAnd = pattern("vec4($0.x != 0.0 && $1.x != 0.0 ? 1.0 : 0.0)", [](Call c) {
    c.out() = vec4(c.x(0) != 0.0f && c.x(1) != 0.0f ? 1.0f : 0.0f);
});

constexpr Pattern logicOr = pattern("vec4($0.x != 0.0 || $1.x != 0.0 ? 1.0 : 0.0)", [](Call c) {
    c.out() = vec4(c.x(0) != 0.0f || c.x(1) != 0.0f ? 1.0f : 0.0f);
});

constexpr char logicXorGlsl[] = "vec4(($0.x != 0.0) != ($1.x != 0.0) ? 1.0 : 0.0)";
constexpr Pattern logicXor = rarePattern(logicXorGlsl, [](Call c) {
    c.out() = vec4((c.x(0) != 0.0f) != (c.x(1) != 0.0f) ? 1.0f : 0.0f);
});

constexpr Pattern logicNot = pattern("vec4($0.x == 0.0 ? 1.0 : 0.0)",
                                     [](Call c) { c.out() = vec4(c.x(0) == 0.0f ? 1.0f : 0.0f); });

/// Indices below the first take the first; above the last there is nothing.
constexpr Pattern switched = rarePattern(
    "nodeSwitch(${10}.x, vec4[10]($0, $1, $2, $3, $4, $5, $6, $7, $8, $9))", [](Call c) {
        const float which = std::fmax(std::floor(c.x(10)), 0.0f);
        c.out() = which < 10.0f ? c.in(int(which)) : vec4(0.0f);
    });

const char* const types = "float integer color3 color4 vector2 vector3 vector4";
#define PATINA_SWITCH_INPUTS                                                                       \
    "$ in1=0, $ in2=0, $ in3=0, $ in4=0, $ in5=0, $ in6=0, $ in7=0, $ in8=0, $ in9=0, $ in10=0, "

const NodeRow rows[] = {
    {"ND_ifgreater_$", "ifgreater", "float value1=1, float value2=0, $ in1=0, $ in2=0", "$",
     ifGreater, Algebra::IfGreater, types},
    {"ND_ifgreater_$I", "ifgreater", "integer value1=1, integer value2=0, $ in1=0, $ in2=0", "$",
     ifGreater, Algebra::IfGreater, types},
    {"ND_ifgreatereq_$", "ifgreatereq", "float value1=1, float value2=0, $ in1=0, $ in2=0", "$",
     ifGreaterEq, Algebra::IfGreaterEq, types},
    {"ND_ifgreatereq_$I", "ifgreatereq", "integer value1=1, integer value2=0, $ in1=0, $ in2=0",
     "$", ifGreaterEq, Algebra::IfGreaterEq, types},
    {"ND_ifequal_$", "ifequal", "float value1=0, float value2=0, $ in1=0, $ in2=0", "$", ifEqual,
     Algebra::IfEqual, types},
    {"ND_ifequal_$I", "ifequal", "integer value1=0, integer value2=0, $ in1=0, $ in2=0", "$",
     ifEqual, Algebra::IfEqual, types},
    {"ND_ifequal_$B", "ifequal", "boolean value1=0, boolean value2=0, $ in1=0, $ in2=0", "$",
     ifEqual, Algebra::IfEqual, types},
    {"ND_switch_$", "switch", PATINA_SWITCH_INPUTS "float which=0", "$", switched, Algebra::Switch,
     types},
    {"ND_switch_$I", "switch", PATINA_SWITCH_INPUTS "integer which=0", "$", switched,
     Algebra::Switch, types},
    {"ND_ifgreater_boolean", "ifgreater", "float value1=1, float value2=0", "boolean", isGreater},
    {"ND_ifgreater_booleanI", "ifgreater", "integer value1=1, integer value2=0", "boolean",
     isGreater},
    {"ND_ifgreatereq_boolean", "ifgreatereq", "float value1=1, float value2=0", "boolean",
     isGreaterEq},
    {"ND_ifgreatereq_booleanI", "ifgreatereq", "integer value1=1, integer value2=0", "boolean",
     isGreaterEq},
    {"ND_ifequal_boolean", "ifequal", "float value1=1, float value2=0", "boolean", isEqual},
    {"ND_ifequal_booleanI", "ifequal", "integer value1=1, integer value2=0", "boolean", isEqual},
    {"ND_ifequal_booleanB", "ifequal", "boolean value1=0, boolean value2=0", "boolean", isEqual},
    {"ND_logical_and", "and", "boolean in1=0, boolean in2=0", "boolean", logicAnd},
    {"ND_logical_or", "or", "boolean in1=0, boolean in2=0", "boolean", logicOr},
    {"ND_logical_xor", "xor", "boolean in1=0, boolean in2=0", "boolean", logicXor},
    {"ND_logical_not", "not", "boolean in=0", "boolean", logicNot},
};

} // namespace

NodeRows conditionalNodes() {
    return {std::begin(rows), std::end(rows)};
}

} // namespace patina
