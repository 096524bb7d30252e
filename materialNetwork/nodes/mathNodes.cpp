// SPDX-License-Identifier: Apache-2.0
// Arithmetic, component by component. Scalars fill their register, so one function serves all
// sizes and the scalar-vector variants.
#define PATINA_NODE_FUNCTIONS "shaders/patterns/nodes/math.glsl"
#include "materialNetwork/nodes/patternFunctions.h"
#include "materialNetwork/nodes/nodeTable.h"

namespace patina {

namespace {

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

} // namespace

NodeRows mathNodes() {
    return {std::begin(rows), std::end(rows)};
}

} // namespace patina
