// SPDX-License-Identifier: Apache-2.0
// Arithmetic, component by component. Scalars fill their register, so one function serves all
// sizes and the scalar-vector variants.
#include "materialNetwork/nodes/nodeTable.h"

#include <cmath>

namespace patina {

namespace {

using glm::vec4;
using Call = const PatternCall&;

template <float (*F)(float)> void map1(Call c) {
    const vec4 a = c.in(0);
    c.out() = vec4(F(a.x), F(a.y), F(a.z), F(a.w));
}

template <float (*F)(float, float)> void map2(Call c) {
    const vec4 a = c.in(0), b = c.in(1);
    c.out() = vec4(F(a.x, b.x), F(a.y, b.y), F(a.z, b.z), F(a.w, b.w));
}

float divided(float a, float b) {
    return b == 0.0f ? 0.0f : a / b;
}
float powered(float a, float b) {
    const float p = std::pow(a, b);
    return std::isfinite(p) ? p : 0.0f;
}
float modulo(float a, float b) {
    return b == 0.0f ? 0.0f : a - b * std::floor(a / b);
}
float root(float a) {
    return std::sqrt(a > 0.0f ? a : 0.0f);
}
float logarithm(float a) {
    return std::log(a > 1e-37f ? a : 1e-37f);
}
float exponential(float a) {
    return std::exp(a < 80.0f ? a : 80.0f);
}
float sign(float a) {
    return float(a > 0.0f) - float(a < 0.0f);
}
float absolute(float a) {
    return std::fabs(a);
}
float floored(float a) {
    return std::floor(a);
}
float ceiled(float a) {
    return std::ceil(a);
}
float rounded(float a) {
    return std::round(a);
}
float fraction(float a) {
    return a - std::floor(a);
}
float triangleWave(float a) {
    const float x = std::fabs(a);
    return 0.5f - std::fabs(x - std::floor(x) - 0.5f);
}
float sine(float a) {
    return std::sin(a);
}
float cosine(float a) {
    return std::cos(a);
}
float tangent(float a) {
    return std::tan(a);
}
float arcsine(float a) {
    return std::asin(glm::clamp(a, -1.0f, 1.0f));
}
float arccosine(float a) {
    return std::acos(glm::clamp(a, -1.0f, 1.0f));
}
float arctangent(float y, float x) {
    return std::atan2(y, x);
}
float larger(float a, float b) {
    return a > b ? a : b;
}
float smaller(float a, float b) {
    return a < b ? a : b;
}

constexpr Pattern constant = pattern("$0", [](Call c) { c.out() = c.in(0); });
constexpr Pattern add = pattern("$0 + $1", [](Call c) { c.out() = c.in(0) + c.in(1); });
constexpr Pattern subtract = pattern("$0 - $1", [](Call c) { c.out() = c.in(0) - c.in(1); });
constexpr Pattern multiply = pattern("$0 * $1", [](Call c) { c.out() = c.in(0) * c.in(1); });
constexpr Pattern invert = pattern("$1 - $0", [](Call c) { c.out() = c.in(1) - c.in(0); });
constexpr Pattern clamped = pattern("min(max($0, $1), $2)", [](Call c) {
    c.out() = glm::min(glm::max(c.in(0), c.in(1)), c.in(2));
});

constexpr Pattern mixed = pattern(
    "$1 + ($0 - $1) * $2", [](Call c) { c.out() = c.in(1) + (c.in(0) - c.in(1)) * c.in(2); });

constexpr Pattern smoothstep = pattern("nodeSmoothstep($0, $1, $2)", [](Call c) {
    for (int i = 0; i < 4; ++i) {
        const float low = c.in(1)[i], high = c.in(2)[i], x = c.in(0)[i];
        const float t =
            high > low ? glm::clamp((x - low) / (high - low), 0.0f, 1.0f) : float(x >= high);
        c.out()[i] = t * t * (3.0f - 2.0f * t);
    }
});

constexpr Pattern remap = pattern("$3 + nodeDivide($0 - $1, $2 - $1) * ($4 - $3)", [](Call c) {
    for (int i = 0; i < 4; ++i) {
        const float t = divided(c.in(0)[i] - c.in(1)[i], c.in(2)[i] - c.in(1)[i]);
        c.out()[i] = c.in(3)[i] + t * (c.in(4)[i] - c.in(3)[i]);
    }
});

constexpr Pattern divideNode = pattern("nodeDivide($0, $1)", map2<divided>);
constexpr Pattern moduloNode = pattern("nodeModulo($0, $1)", map2<modulo>);
constexpr Pattern powerNode = pattern("nodePower($0, $1)", map2<powered>);
constexpr Pattern minNode = pattern("min($0, $1)", map2<smaller>);
constexpr Pattern maxNode = pattern("max($0, $1)", map2<larger>);
constexpr Pattern absvalNode = pattern("abs($0)", map1<absolute>);
constexpr Pattern signNode = pattern("sign($0)", map1<sign>);
constexpr Pattern floorNode = pattern("floor($0)", map1<floored>);
constexpr Pattern ceilNode = pattern("ceil($0)", map1<ceiled>);
constexpr Pattern roundNode = pattern("nodeRound($0)", map1<rounded>);
constexpr Pattern fractNode = pattern("$0 - floor($0)", map1<fraction>);
constexpr Pattern sqrtNode = pattern("sqrt(max($0, vec4(0.0)))", map1<root>);
constexpr Pattern lnNode = pattern("log(max($0, vec4(1e-37)))", map1<logarithm>);
constexpr Pattern expNode = pattern("exp(min($0, vec4(80.0)))", map1<exponential>);
constexpr Pattern sinNode = pattern("sin($0)", map1<sine>);
constexpr Pattern cosNode = pattern("cos($0)", map1<cosine>);
constexpr Pattern tanNode = pattern("tan($0)", map1<tangent>);
constexpr Pattern asinNode = pattern("nodeAsin($0)", map1<arcsine>);
constexpr Pattern acosNode = pattern("nodeAcos($0)", map1<arccosine>);
constexpr Pattern atan2Node = pattern("atan($0, $1)", map2<arctangent>);
constexpr Pattern trianglewaveNode =
    pattern("0.5 - abs(abs($0) - floor(abs($0)) - 0.5)", map1<triangleWave>);

const char* const types = allTypes;
const char* const tuples = tupleTypes;

const NodeRow rows[] = {
    {"ND_constant_$", "constant", "$ value=0", "$", constant, Algebra::Alias,
     "float color3 color4 vector2 vector3 vector4 integer boolean"},
    {"ND_constant_string", "constant", "string value=", "string", nullptr, Algebra::Alias},
    {"ND_constant_filename", "constant", "filename value=", "filename", nullptr, Algebra::Alias},
    {"ND_dot_$", "dot", "$ in=0, string note=", "$", constant, Algebra::Alias,
     "float color3 color4 vector2 vector3 vector4 integer boolean"},
    {"ND_dot_string", "dot", "string in=, string note=", "string", nullptr, Algebra::Alias},
    {"ND_dot_$", "dot", "$ in, string note=", "$", nullptr, Algebra::Alias,
     "surfaceshader displacementshader volumeshader lightshader"},
    {"ND_dot_filename", "dot", "filename in=, string note=", "filename", nullptr, Algebra::Alias},
    {"ND_add_$", "add", "$ in1=0, $ in2=0", "$", add, Algebra::Add, types},
    {"ND_add_integer", "add", "integer in1=0, integer in2=0", "integer", add, Algebra::Add},
    {"ND_add_$FA", "add", "$ in1=0, float in2=0", "$", add, Algebra::Add, tuples},
    {"ND_subtract_$", "subtract", "$ in1=0, $ in2=0", "$", subtract, Algebra::Subtract, types},
    {"ND_subtract_integer", "subtract", "integer in1=0, integer in2=0", "integer", subtract,
     Algebra::Subtract},
    {"ND_subtract_$FA", "subtract", "$ in1=0, float in2=0", "$", subtract, Algebra::Subtract,
     tuples},
    {"ND_multiply_$", "multiply", "$ in1=0, $ in2=1", "$", multiply, Algebra::Multiply, types},
    {"ND_multiply_$FA", "multiply", "$ in1=0, float in2=1", "$", multiply, Algebra::Multiply,
     tuples},
    {"ND_divide_$", "divide", "$ in1=0, $ in2=1", "$", divideNode, Algebra::Divide, types},
    {"ND_divide_$FA", "divide", "$ in1=0, float in2=1", "$", divideNode, Algebra::Divide, tuples},
    {"ND_modulo_$", "modulo", "$ in1=0, $ in2=1", "$", moduloNode, Algebra::None, types},
    {"ND_modulo_$FA", "modulo", "$ in1=0, float in2=1", "$", moduloNode, Algebra::None, tuples},
    {"ND_power_$", "power", "$ in1=0, $ in2=1", "$", powerNode, Algebra::None, types},
    {"ND_power_$FA", "power", "$ in1=0, float in2=1", "$", powerNode, Algebra::None, tuples},
    {"ND_min_$", "min", "$ in1=0, $ in2=0", "$", minNode, Algebra::None, types},
    {"ND_min_$FA", "min", "$ in1=0, float in2=0", "$", minNode, Algebra::None, tuples},
    {"ND_max_$", "max", "$ in1=0, $ in2=0", "$", maxNode, Algebra::None, types},
    {"ND_max_$FA", "max", "$ in1=0, float in2=0", "$", maxNode, Algebra::None, tuples},
    {"ND_clamp_$", "clamp", "$ in=0, $ low=0, $ high=1", "$", clamped, Algebra::None, types},
    {"ND_clamp_$FA", "clamp", "$ in=0, float low=0, float high=1", "$", clamped, Algebra::None,
     tuples},
    {"ND_mix_$", "mix", "$ fg=0, $ bg=0, float mix=0", "$", mixed, Algebra::Mix, types},
    {"ND_mix_$_$", "mix", "$ fg=0, $ bg=0, $ mix=0", "$", mixed, Algebra::Mix, tuples},
    {"ND_invert_$", "invert", "$ in=0, $ amount=1", "$", invert, Algebra::None, types},
    {"ND_invert_$FA", "invert", "$ in=0, float amount=1", "$", invert, Algebra::None, tuples},
    {"ND_absval_$", "absval", "$ in=0", "$", absvalNode, Algebra::None, types},
    {"ND_sign_$", "sign", "$ in=0", "$", signNode, Algebra::None, types},
    {"ND_floor_$", "floor", "$ in=0", "$", floorNode, Algebra::None, types},
    {"ND_ceil_$", "ceil", "$ in=0", "$", ceilNode, Algebra::None, types},
    {"ND_round_$", "round", "$ in=0", "$", roundNode, Algebra::None, types},
    {"ND_fract_$", "fract", "$ in=0", "$", fractNode, Algebra::None, types},
    {"ND_sqrt_$", "sqrt", "$ in=0", "$", sqrtNode, Algebra::None, "float vector2 vector3 vector4"},
    {"ND_ln_$", "ln", "$ in=1", "$", lnNode, Algebra::None, "float vector2 vector3 vector4"},
    {"ND_exp_$", "exp", "$ in=0", "$", expNode, Algebra::None, "float vector2 vector3 vector4"},
    {"ND_sin_$", "sin", "$ in=0", "$", sinNode, Algebra::None, "float vector2 vector3 vector4"},
    {"ND_cos_$", "cos", "$ in=0", "$", cosNode, Algebra::None, "float vector2 vector3 vector4"},
    {"ND_tan_$", "tan", "$ in=0", "$", tanNode, Algebra::None, "float vector2 vector3 vector4"},
    {"ND_asin_$", "asin", "$ in=0", "$", asinNode, Algebra::None, "float vector2 vector3 vector4"},
    {"ND_acos_$", "acos", "$ in=0", "$", acosNode, Algebra::None, "float vector2 vector3 vector4"},
    {"ND_atan2_$", "atan2", "$ iny=0, $ inx=1", "$", atan2Node, Algebra::None,
     "float vector2 vector3 vector4"},
    {"ND_trianglewave_float", "trianglewave", "float in=0", "float", trianglewaveNode},
    {"ND_floor_integer", "floor", "float in=0", "integer", floorNode},
    {"ND_ceil_integer", "ceil", "float in=0", "integer", ceilNode},
    {"ND_round_integer", "round", "float in=0", "integer", roundNode},
    {"ND_smoothstep_$", "smoothstep", "$ in=0, $ low=0, $ high=1", "$", smoothstep, Algebra::None,
     types},
    {"ND_smoothstep_$FA", "smoothstep", "$ in=0, float low=0, float high=1", "$", smoothstep,
     Algebra::None, tuples},
    {"ND_remap_$", "remap", "$ in=0, $ inlow=0, $ inhigh=1, $ outlow=0, $ outhigh=1", "$", remap,
     Algebra::None, types},
    {"ND_remap_$FA", "remap",
     "$ in=0, float inlow=0, float inhigh=1, float outlow=0, float outhigh=1", "$", remap,
     Algebra::None, tuples},
};

} // namespace

NodeRows mathNodes() {
    return {std::begin(rows), std::end(rows)};
}

} // namespace patina
