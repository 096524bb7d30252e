// SPDX-License-Identifier: Apache-2.0
// Nodes that take values apart, put them together and change their type.
#include "materialNetwork/nodes/nodeTable.h"

#include <cmath>

namespace patina {

namespace {

using glm::vec4;
using Call = const PatternCall&;

constexpr Pattern same = pattern("$0", [](Call c) { c.out() = c.in(0); });
constexpr Pattern opaque = pattern(
    "vec4($0.xyz, 1.0)", [](Call c) { c.out() = vec4(c.in(0).x, c.in(0).y, c.in(0).z, 1.0f); });
constexpr Pattern twoToThree = pattern(
    "vec4($0.xy, 0.0, 0.0)", [](Call c) { c.out() = vec4(c.in(0).x, c.in(0).y, 0.0f, 0.0f); });
constexpr Pattern opaqueZero = rarePattern(
    "vec4($0.xy, 0.0, 1.0)", [](Call c) { c.out() = vec4(c.in(0).x, c.in(0).y, 0.0f, 1.0f); });
constexpr Pattern toInteger = pattern("floor($0)", [](Call c) { c.out() = glm::floor(c.in(0)); });
constexpr Pattern toBoolean = rarePattern("vec4($0.x != 0.0 ? 1.0 : 0.0)", [](Call c) {
    c.out() = vec4(c.in(0).x != 0.0f ? 1.0f : 0.0f);
});

constexpr Pattern combine2 = pattern("vec4($0.x, $1.x, 0.0, 0.0)",
                                     [](Call c) { c.out() = vec4(c.x(0), c.x(1), 0.0f, 0.0f); });
constexpr Pattern combine3 = pattern("vec4($0.x, $1.x, $2.x, 0.0)",
                                     [](Call c) { c.out() = vec4(c.x(0), c.x(1), c.x(2), 0.0f); });
constexpr Pattern combine4 = pattern(
    "vec4($0.x, $1.x, $2.x, $3.x)", [](Call c) { c.out() = vec4(c.x(0), c.x(1), c.x(2), c.x(3)); });
constexpr Pattern combine31 = pattern(
    "vec4($0.xyz, $1.x)", [](Call c) { c.out() = vec4(c.in(0).x, c.in(0).y, c.in(0).z, c.x(1)); });
constexpr Pattern combine22 = pattern("vec4($0.xy, $1.xy)", [](Call c) {
    c.out() = vec4(c.in(0).x, c.in(0).y, c.in(1).x, c.in(1).y);
});

constexpr Pattern extract = pattern("vec4($0[clamp(int($1.x), 0, $s - 1)])", [](Call c) {
    const int i = glm::clamp(c.whole(1), 0, c.data.size - 1);
    c.out() = vec4(c.in(0)[i]);
});

template <int Size> constexpr const char* separateGlsl =
    Size == 2   ? "vec4($0.x); vec4($0.y)"
    : Size == 3 ? "vec4($0.x); vec4($0.y); vec4($0.z)"
                : "vec4($0.x); vec4($0.y); vec4($0.z); vec4($0.w)";
template <int Size> constexpr Pattern separate = pattern(separateGlsl<Size>, [](Call c) {
    const vec4 v = c.in(0);
    for (int i = 0; i < Size; ++i)
        c.out(i) = vec4(v[i]);
});

const NodeRow rows[] = {
    {"ND_convert_float_$", "convert", "float in=0", "$", same, Algebra::Alias,
     "color3 color4 vector2 vector3 vector4"},
    {"ND_convert_boolean_float", "convert", "boolean in=0", "float", same, Algebra::Alias},
    {"ND_convert_integer_float", "convert", "integer in=0", "float", same, Algebra::Alias},
    {"ND_convert_boolean_integer", "convert", "boolean in=0", "integer", same, Algebra::Alias},
    {"ND_convert_float_integer", "convert", "float in=0", "integer", toInteger},
    {"ND_convert_integer_boolean", "convert", "integer in=0", "boolean", toBoolean},
    {"ND_convert_vector3_color3", "convert", "vector3 in=0", "color3", same, Algebra::Alias},
    {"ND_convert_color3_vector3", "convert", "color3 in=0", "vector3", same, Algebra::Alias},
    {"ND_convert_vector4_color4", "convert", "vector4 in=0", "color4", same, Algebra::Alias},
    {"ND_convert_color4_vector4", "convert", "color4 in=0", "vector4", same, Algebra::Alias},
    {"ND_convert_color4_color3", "convert", "color4 in=0", "color3", same, Algebra::Alias},
    {"ND_convert_vector4_vector3", "convert", "vector4 in=0", "vector3", same, Algebra::Alias},
    {"ND_convert_color3_color4", "convert", "color3 in=0", "color4", opaque},
    {"ND_convert_vector3_vector4", "convert", "vector3 in=0", "vector4", opaque},
    {"ND_convert_vector3_vector2", "convert", "vector3 in=0", "vector2", same, Algebra::Alias},
    {"ND_convert_vector2_vector3", "convert", "vector2 in=0", "vector3", twoToThree},
    {"ND_convert_boolean_$", "convert", "boolean in=0", "$", same, Algebra::Alias,
     "color3 color4 vector2 vector3 vector4"},
    {"ND_convert_integer_$", "convert", "integer in=0", "$", same, Algebra::Alias,
     "color3 color4 vector2 vector3 vector4"},
    {"ND_convert_color3_vector2", "convert", "color3 in=0", "vector2", same, Algebra::Alias},
    {"ND_convert_color4_vector2", "convert", "color4 in=0", "vector2", same, Algebra::Alias},
    {"ND_convert_vector4_vector2", "convert", "vector4 in=0", "vector2", same, Algebra::Alias},
    {"ND_convert_color4_vector3", "convert", "color4 in=0", "vector3", same, Algebra::Alias},
    {"ND_convert_vector4_color3", "convert", "vector4 in=0", "color3", same, Algebra::Alias},
    {"ND_convert_color3_vector4", "convert", "color3 in=0", "vector4", opaque},
    {"ND_convert_vector3_color4", "convert", "vector3 in=0", "color4", opaque},
    {"ND_convert_vector2_color3", "convert", "vector2 in=0", "color3", twoToThree},
    {"ND_convert_vector2_$", "convert", "vector2 in=0", "$", opaqueZero, Algebra::None,
     "color4 vector4"},
    {"ND_combine2_vector2", "combine2", "float in1=0, float in2=0", "vector2", combine2},
    {"ND_combine2_color4CF", "combine2", "color3 in1=0, float in2=0", "color4", combine31},
    {"ND_combine2_vector4VF", "combine2", "vector3 in1=0, float in2=0", "vector4", combine31},
    {"ND_combine2_vector4VV", "combine2", "vector2 in1=0, vector2 in2=0", "vector4", combine22},
    {"ND_combine3_$", "combine3", "float in1=0, float in2=0, float in3=0", "$", combine3,
     Algebra::None, "color3 vector3"},
    {"ND_combine4_$", "combine4", "float in1=0, float in2=0, float in3=0, float in4=0", "$",
     combine4, Algebra::None, "color4 vector4"},
    {"ND_extract_$", "extract", "$ in=0, integer index=0", "float", extract, Algebra::None,
     tupleTypes},
    {"ND_separate2_vector2", "separate2", "vector2 in=0", "float outx, float outy", separate<2>},
    {"ND_separate3_color3", "separate3", "color3 in=0", "float outr, float outg, float outb",
     separate<3>},
    {"ND_separate3_vector3", "separate3", "vector3 in=0", "float outx, float outy, float outz",
     separate<3>},
    {"ND_separate4_color4", "separate4", "color4 in=0",
     "float outr, float outg, float outb, float outa", separate<4>},
    {"ND_separate4_vector4", "separate4", "vector4 in=0",
     "float outx, float outy, float outz, float outw", separate<4>},
};

} // namespace

NodeRows channelNodes() {
    return {std::begin(rows), std::end(rows)};
}

} // namespace patina
