// SPDX-License-Identifier: Apache-2.0
// Arithmetic, component by component. Scalars fill their register, so one function serves all sizes
// and the scalar-vector variants.
#ifndef PATINA_NODE_ROWS

PATINA_FN vec4 nodeAdd(vec4 a, vec4 b) {
    return a + b;
}
PATINA_FN vec4 nodeSubtract(vec4 a, vec4 b) {
    return a - b;
}
PATINA_FN vec4 nodeMultiply(vec4 a, vec4 b) {
    return a * b;
}
PATINA_FN float dividedOrZero(float a, float b) {
    return b == 0.0f ? 0.0f : a / b;
}
PATINA_FN vec4 nodeDivide(vec4 a, vec4 b) {
    return vec4(dividedOrZero(a.x, b.x), dividedOrZero(a.y, b.y), dividedOrZero(a.z, b.z),
                dividedOrZero(a.w, b.w));
}
PATINA_FN float moduloOrZero(float a, float b) {
    return b == 0.0f ? 0.0f : a - b * floor(a / b);
}
PATINA_FN vec4 nodeModulo(vec4 a, vec4 b) {
    return vec4(moduloOrZero(a.x, b.x), moduloOrZero(a.y, b.y), moduloOrZero(a.z, b.z),
                moduloOrZero(a.w, b.w));
}
PATINA_FN vec4 nodePower(vec4 a, vec4 b) {
    return vec4(powerOrZero(a.x, b.x), powerOrZero(a.y, b.y), powerOrZero(a.z, b.z),
                powerOrZero(a.w, b.w));
}
PATINA_FN vec4 nodeMin(vec4 a, vec4 b) {
    return min(a, b);
}
PATINA_FN vec4 nodeMax(vec4 a, vec4 b) {
    return max(a, b);
}
PATINA_FN vec4 nodeClamp(vec4 x, vec4 low, vec4 high) {
    return min(max(x, low), high);
}
PATINA_FN vec4 nodeMix(vec4 fg, vec4 bg, vec4 share) {
    return bg + (fg - bg) * share;
}
PATINA_FN vec4 nodeInvert(vec4 x, vec4 amount) {
    return amount - x;
}
PATINA_FN vec4 nodeAbsolute(vec4 x) {
    return abs(x);
}
PATINA_FN float signOf(float x) {
    return float(x > 0.0f) - float(x < 0.0f);
}
PATINA_FN vec4 nodeSign(vec4 x) {
    return vec4(signOf(x.x), signOf(x.y), signOf(x.z), signOf(x.w));
}
PATINA_FN vec4 nodeFloor(vec4 x) {
    return floor(x);
}
PATINA_FN vec4 nodeCeil(vec4 x) {
    return ceil(x);
}
PATINA_FN vec4 nodeRound(vec4 x) {
    return vec4(roundAway(x.x), roundAway(x.y), roundAway(x.z), roundAway(x.w));
}
PATINA_FN vec4 nodeFract(vec4 x) {
    return x - floor(x);
}
PATINA_FN vec4 nodeSqrt(vec4 x) {
    return sqrt(max(x, vec4(0.0f)));
}
PATINA_FN vec4 nodeLog(vec4 x) {
    return log(max(x, vec4(1e-37f)));
}
PATINA_FN vec4 nodeExp(vec4 x) {
    return exp(min(x, vec4(80.0f)));
}
PATINA_FN vec4 nodeSin(vec4 x) {
    return sin(x);
}
PATINA_FN vec4 nodeCos(vec4 x) {
    return cos(x);
}
PATINA_FN vec4 nodeTan(vec4 x) {
    return tan(x);
}
PATINA_FN vec4 nodeAsin(vec4 x) {
    return vec4(arcsine(x.x), arcsine(x.y), arcsine(x.z), arcsine(x.w));
}
PATINA_FN vec4 nodeAcos(vec4 x) {
    return vec4(arccosine(x.x), arccosine(x.y), arccosine(x.z), arccosine(x.w));
}
PATINA_FN vec4 nodeAtan2(vec4 y, vec4 x) {
    return vec4(atan(y.x, x.x), atan(y.y, x.y), atan(y.z, x.z), atan(y.w, x.w));
}
PATINA_FN float nodeTriangleWave(float x) {
    float a = abs(x);
    return 0.5f - abs(a - floor(a) - 0.5f);
}

PATINA_FN float smoothBetween(float x, float low, float high) {
    float t = high > low ? clamp((x - low) / (high - low), 0.0f, 1.0f) : float(x >= high);
    return t * t * (3.0f - 2.0f * t);
}
PATINA_FN vec4 nodeSmoothstep(vec4 x, vec4 low, vec4 high) {
    return vec4(smoothBetween(x.x, low.x, high.x), smoothBetween(x.y, low.y, high.y),
                smoothBetween(x.z, low.z, high.z), smoothBetween(x.w, low.w, high.w));
}

PATINA_FN float remapped(float x, float low, float high, float outLow, float outHigh) {
    float t = dividedOrZero(x - low, high - low);
    return outLow + t * (outHigh - outLow);
}
PATINA_FN vec4 nodeRemap(vec4 x, vec4 low, vec4 high, vec4 outLow, vec4 outHigh) {
    return vec4(remapped(x.x, low.x, high.x, outLow.x, outHigh.x),
                remapped(x.y, low.y, high.y, outLow.y, outHigh.y),
                remapped(x.z, low.z, high.z, outLow.z, outHigh.z),
                remapped(x.w, low.w, high.w, outLow.w, outHigh.w));
}

#else // PATINA_NODE_ROWS: rows of the node table, C++ alone

const char* const types = allTypes;
const char* const tuples = tupleTypes;

const NodeRow rows[] = {
    {"ND_constant_$", "constant", "$ value=0", "$", PATINA_PATTERN(patternSame), Algebra::Alias,
     "float color3 color4 vector2 vector3 vector4 integer boolean"},
    {"ND_constant_string", "constant", "string value=", "string", nullptr, Algebra::Alias},
    {"ND_constant_filename", "constant", "filename value=", "filename", nullptr, Algebra::Alias},
    {"ND_dot_$", "dot", "$ in=0, string note=", "$", PATINA_PATTERN(patternSame), Algebra::Alias,
     "float color3 color4 vector2 vector3 vector4 integer boolean"},
    {"ND_dot_string", "dot", "string in=, string note=", "string", nullptr, Algebra::Alias},
    {"ND_dot_$", "dot", "$ in, string note=", "$", nullptr, Algebra::Alias,
     "surfaceshader displacementshader volumeshader lightshader"},
    {"ND_dot_filename", "dot", "filename in=, string note=", "filename", nullptr, Algebra::Alias},
    {"ND_add_$", "add", "$ in1=0, $ in2=0", "$", PATINA_PATTERN(nodeAdd), Algebra::Add, types},
    {"ND_add_integer", "add", "integer in1=0, integer in2=0", "integer", PATINA_PATTERN(nodeAdd),
     Algebra::Add},
    {"ND_add_$FA", "add", "$ in1=0, float in2=0", "$", PATINA_PATTERN(nodeAdd), Algebra::Add,
     tuples},
    {"ND_subtract_$", "subtract", "$ in1=0, $ in2=0", "$", PATINA_PATTERN(nodeSubtract),
     Algebra::Subtract, types},
    {"ND_subtract_integer", "subtract", "integer in1=0, integer in2=0", "integer",
     PATINA_PATTERN(nodeSubtract), Algebra::Subtract},
    {"ND_subtract_$FA", "subtract", "$ in1=0, float in2=0", "$", PATINA_PATTERN(nodeSubtract),
     Algebra::Subtract, tuples},
    {"ND_multiply_$", "multiply", "$ in1=0, $ in2=1", "$", PATINA_PATTERN(nodeMultiply),
     Algebra::Multiply, types},
    {"ND_multiply_$FA", "multiply", "$ in1=0, float in2=1", "$", PATINA_PATTERN(nodeMultiply),
     Algebra::Multiply, tuples},
    {"ND_divide_$", "divide", "$ in1=0, $ in2=1", "$", PATINA_PATTERN(nodeDivide), Algebra::Divide,
     types},
    {"ND_divide_$FA", "divide", "$ in1=0, float in2=1", "$", PATINA_PATTERN(nodeDivide),
     Algebra::Divide, tuples},
    {"ND_modulo_$", "modulo", "$ in1=0, $ in2=1", "$", PATINA_PATTERN(nodeModulo), Algebra::None,
     types},
    {"ND_modulo_$FA", "modulo", "$ in1=0, float in2=1", "$", PATINA_PATTERN(nodeModulo),
     Algebra::None, tuples},
    {"ND_power_$", "power", "$ in1=0, $ in2=1", "$", PATINA_PATTERN(nodePower), Algebra::None,
     types},
    {"ND_power_$FA", "power", "$ in1=0, float in2=1", "$", PATINA_PATTERN(nodePower), Algebra::None,
     tuples},
    {"ND_min_$", "min", "$ in1=0, $ in2=0", "$", PATINA_PATTERN(nodeMin), Algebra::None, types},
    {"ND_min_$FA", "min", "$ in1=0, float in2=0", "$", PATINA_PATTERN(nodeMin), Algebra::None,
     tuples},
    {"ND_max_$", "max", "$ in1=0, $ in2=0", "$", PATINA_PATTERN(nodeMax), Algebra::None, types},
    {"ND_max_$FA", "max", "$ in1=0, float in2=0", "$", PATINA_PATTERN(nodeMax), Algebra::None,
     tuples},
    {"ND_clamp_$", "clamp", "$ in=0, $ low=0, $ high=1", "$", PATINA_PATTERN(nodeClamp),
     Algebra::None, types},
    {"ND_clamp_$FA", "clamp", "$ in=0, float low=0, float high=1", "$", PATINA_PATTERN(nodeClamp),
     Algebra::None, tuples},
    {"ND_mix_$", "mix", "$ fg=0, $ bg=0, float mix=0", "$", PATINA_PATTERN(nodeMix), Algebra::Mix,
     types},
    {"ND_mix_$_$", "mix", "$ fg=0, $ bg=0, $ mix=0", "$", PATINA_PATTERN(nodeMix), Algebra::Mix,
     tuples},
    {"ND_invert_$", "invert", "$ in=0, $ amount=1", "$", PATINA_PATTERN(nodeInvert), Algebra::None,
     types},
    {"ND_invert_$FA", "invert", "$ in=0, float amount=1", "$", PATINA_PATTERN(nodeInvert),
     Algebra::None, tuples},
    {"ND_absval_$", "absval", "$ in=0", "$", PATINA_PATTERN(nodeAbsolute), Algebra::None, types},
    {"ND_sign_$", "sign", "$ in=0", "$", PATINA_PATTERN(nodeSign), Algebra::None, types},
    {"ND_floor_$", "floor", "$ in=0", "$", PATINA_PATTERN(nodeFloor), Algebra::None, types},
    {"ND_ceil_$", "ceil", "$ in=0", "$", PATINA_PATTERN(nodeCeil), Algebra::None, types},
    {"ND_round_$", "round", "$ in=0", "$", PATINA_PATTERN(nodeRound), Algebra::None, types},
    {"ND_fract_$", "fract", "$ in=0", "$", PATINA_PATTERN(nodeFract), Algebra::None, types},
    {"ND_sqrt_$", "sqrt", "$ in=0", "$", PATINA_PATTERN(nodeSqrt), Algebra::None,
     "float vector2 vector3 vector4"},
    {"ND_ln_$", "ln", "$ in=1", "$", PATINA_PATTERN(nodeLog), Algebra::None,
     "float vector2 vector3 vector4"},
    {"ND_exp_$", "exp", "$ in=0", "$", PATINA_PATTERN(nodeExp), Algebra::None,
     "float vector2 vector3 vector4"},
    {"ND_sin_$", "sin", "$ in=0", "$", PATINA_PATTERN(nodeSin), Algebra::None,
     "float vector2 vector3 vector4"},
    {"ND_cos_$", "cos", "$ in=0", "$", PATINA_PATTERN(nodeCos), Algebra::None,
     "float vector2 vector3 vector4"},
    {"ND_tan_$", "tan", "$ in=0", "$", PATINA_PATTERN(nodeTan), Algebra::None,
     "float vector2 vector3 vector4"},
    {"ND_asin_$", "asin", "$ in=0", "$", PATINA_PATTERN(nodeAsin), Algebra::None,
     "float vector2 vector3 vector4"},
    {"ND_acos_$", "acos", "$ in=0", "$", PATINA_PATTERN(nodeAcos), Algebra::None,
     "float vector2 vector3 vector4"},
    {"ND_atan2_$", "atan2", "$ iny=0, $ inx=1", "$", PATINA_PATTERN(nodeAtan2), Algebra::None,
     "float vector2 vector3 vector4"},
    {"ND_trianglewave_float", "trianglewave", "float in=0", "float",
     PATINA_PATTERN(nodeTriangleWave)},
    {"ND_floor_integer", "floor", "float in=0", "integer", PATINA_PATTERN(nodeFloor)},
    {"ND_ceil_integer", "ceil", "float in=0", "integer", PATINA_PATTERN(nodeCeil)},
    {"ND_round_integer", "round", "float in=0", "integer", PATINA_PATTERN(nodeRound)},
    {"ND_smoothstep_$", "smoothstep", "$ in=0, $ low=0, $ high=1", "$",
     PATINA_PATTERN(nodeSmoothstep), Algebra::None, types},
    {"ND_smoothstep_$FA", "smoothstep", "$ in=0, float low=0, float high=1", "$",
     PATINA_PATTERN(nodeSmoothstep), Algebra::None, tuples},
    {"ND_remap_$", "remap", "$ in=0, $ inlow=0, $ inhigh=1, $ outlow=0, $ outhigh=1", "$",
     PATINA_PATTERN(nodeRemap), Algebra::None, types},
    {"ND_remap_$FA", "remap",
     "$ in=0, float inlow=0, float inhigh=1, float outlow=0, float outhigh=1", "$",
     PATINA_PATTERN(nodeRemap), Algebra::None, tuples},
};

#endif
