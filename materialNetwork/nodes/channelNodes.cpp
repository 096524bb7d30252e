// Nodes that take values apart, put them together and change their type.
#include "materialNetwork/nodeTable.h"

#include <cmath>

namespace patina {

namespace {

using glm::vec4;
using Call = const PatternCall&;

void same(Call c) {
    c.out() = c.in(0);
}
void opaque(Call c) {
    c.out() = vec4(c.in(0).x, c.in(0).y, c.in(0).z, 1.0f);
}
void twoToThree(Call c) {
    c.out() = vec4(c.in(0).x, c.in(0).y, 0.0f, 0.0f);
}
void opaqueZero(Call c) {
    c.out() = vec4(c.in(0).x, c.in(0).y, 0.0f, 1.0f);
}
void toInteger(Call c) {
    c.out() = glm::floor(c.in(0));
}
void toBoolean(Call c) {
    c.out() = vec4(c.in(0).x != 0.0f ? 1.0f : 0.0f);
}
void combine2(Call c) {
    c.out() = vec4(c.x(0), c.x(1), 0.0f, 0.0f);
}
void combine3(Call c) {
    c.out() = vec4(c.x(0), c.x(1), c.x(2), 0.0f);
}
void combine4(Call c) {
    c.out() = vec4(c.x(0), c.x(1), c.x(2), c.x(3));
}
void combine31(Call c) {
    c.out() = vec4(c.in(0).x, c.in(0).y, c.in(0).z, c.x(1));
}
void combine22(Call c) {
    c.out() = vec4(c.in(0).x, c.in(0).y, c.in(1).x, c.in(1).y);
}

void extract(Call c) {
    const int i = glm::clamp(c.whole(1), 0, c.data.size - 1);
    c.out() = vec4(c.in(0)[i]);
}

void separate(Call c) {
    const vec4 v = c.in(0);
    for (int i = 0; i < c.data.size; ++i)
        c.out(i) = vec4(v[i]);
}

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
    {"ND_separate2_vector2", "separate2", "vector2 in=0", "float outx, float outy", separate},
    {"ND_separate3_color3", "separate3", "color3 in=0", "float outr, float outg, float outb",
     separate},
    {"ND_separate3_vector3", "separate3", "vector3 in=0", "float outx, float outy, float outz",
     separate},
    {"ND_separate4_color4", "separate4", "color4 in=0",
     "float outr, float outg, float outb, float outa", separate},
    {"ND_separate4_vector4", "separate4", "vector4 in=0",
     "float outx, float outy, float outz, float outw", separate},
};

} // namespace

NodeRows channelNodes() {
    return {std::begin(rows), std::end(rows)};
}

} // namespace patina
