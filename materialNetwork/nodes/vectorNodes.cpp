// Nodes that look at a vector as a whole.
#include "materialNetwork/nodeTable.h"

#include "shaders/patterns.h"

#include <cmath>

namespace patina {

namespace {

using glm::vec2;
using glm::vec3;
using glm::vec4;
using Call = const PatternCall&;

float dotOf(Call c, int a, int b) {
    float sum = 0.0f;
    for (int i = 0; i < c.data.size; ++i)
        sum += c.in(a)[i] * c.in(b)[i];
    return sum;
}

void dotProduct(Call c) {
    c.out() = vec4(dotOf(c, 0, 1));
}
void magnitude(Call c) {
    c.out() = vec4(std::sqrt(dotOf(c, 0, 0)));
}

void distance(Call c) {
    float sum = 0.0f;
    for (int i = 0; i < c.data.size; ++i)
        sum += (c.in(0)[i] - c.in(1)[i]) * (c.in(0)[i] - c.in(1)[i]);
    c.out() = vec4(std::sqrt(sum));
}

void normalized(Call c) {
    const float length = std::sqrt(dotOf(c, 0, 0));
    c.out() = length > 0.0f ? c.in(0) / length : vec4(0.0f);
}

void crossProduct(Call c) {
    c.out() = vec4(glm::cross(vec3(c.in(0)), vec3(c.in(1))), 0.0f);
}

void rotate2d(Call c) {
    c.out() = vec4(sh::patternRotate2d(vec2(c.in(0)), c.x(1)), 0.0f, 0.0f);
}

void rotate3d(Call c) {
    c.out() = vec4(sh::patternRotate3d(vec3(c.in(0)), c.x(1), vec3(c.in(2))), 0.0f);
}

template <bool Largest> void component(Call c) {
    float x = c.in(0).x;
    for (int i = 1; i < c.data.size; ++i)
        x = Largest ? std::fmax(x, c.in(0)[i]) : std::fmin(x, c.in(0)[i]);
    c.out() = vec4(x);
}

void place2d(Call c) {
    c.out() = vec4(sh::patternPlace2d(vec2(c.in(0)), vec2(c.in(1)), vec2(c.in(2)), c.x(3),
                                      vec2(c.in(4)), c.whole(5)),
                   0.0f, 0.0f);
}

void transform2d(Call c) {
    c.out() = vec4(sh::patternTransform2d(vec2(c.in(0)), vec2(c.in(2)), c.x(1), vec2(c.in(3))),
                   0.0f, 0.0f);
}

void luminance(Call c) {
    const float y = sh::patternLuminance(vec3(c.in(0)), vec3(c.in(1)));
    c.out() = vec4(y, y, y, c.in(0).w);
}

void rgbToHsv(Call c) {
    c.out() = vec4(sh::patternRgbToHsv(vec3(c.in(0))), c.in(0).w);
}

void hsvToRgb(Call c) {
    c.out() = vec4(sh::patternHsvToRgb(vec3(c.in(0))), c.in(0).w);
}

void normalMap(Call c) {
    c.out() = vec4(sh::patternNormalMap(vec3(c.in(0)), vec2(c.in(1)), vec3(c.in(2)), vec3(c.in(3)),
                                        vec3(c.in(4))),
                   0.0f);
}

const char* const vectors = "vector2 vector3 vector4";
const char* const normalMapFrame =
    "vector3 in=0.5 0.5 1, $ scale=1, vector3 normal=@Nworld, vector3 tangent=@Tworld, "
    "vector3 bitangent=@Bworld";

const NodeRow rows[] = {
    {"ND_dotproduct_$", "dotproduct", "$ in1=0, $ in2=0", "float", dotProduct, Algebra::None,
     vectors},
    {"ND_magnitude_$", "magnitude", "$ in=0", "float", magnitude, Algebra::None, vectors},
    {"ND_distance_$", "distance", "$ in1=0, $ in2=0", "float", distance, Algebra::None, vectors},
    {"ND_normalize_$", "normalize", "$ in=0", "$", normalized, Algebra::None, vectors},
    {"ND_crossproduct_vector3", "crossproduct", "vector3 in1=0, vector3 in2=0", "vector3",
     crossProduct},
    {"ND_rotate2d_vector2", "rotate2d", "vector2 in=0, float amount=0", "vector2", rotate2d,
     Algebra::Rotate},
    {"ND_rotate3d_vector3", "rotate3d", "vector3 in=0, float amount=0, vector3 axis=0 1 0",
     "vector3", rotate3d, Algebra::Rotate},
    {"ND_place2d_vector2", "place2d",
     "vector2 texcoord=@UV0, vector2 pivot=0, vector2 scale=1, float rotate=0, vector2 offset=0, "
     "integer operationorder=0",
     "vector2", place2d},
    {"UsdTransform2d", "UsdTransform2d",
     "vector2 in=0, float rotation=0, vector2 scale=1, vector2 translation=0", "vector2 result",
     transform2d},
    {"ND_maxcomponent_$", "maxcomponent", "$ in=0", "float", component<true>, Algebra::None,
     tupleTypes},
    {"ND_mincomponent_$", "mincomponent", "$ in=0", "float", component<false>, Algebra::None,
     tupleTypes},
    {"ND_luminance_$", "luminance", "$ in=0, color3 lumacoeffs=0.2722287 0.6740818 0.0536895", "$",
     luminance, Algebra::None, "color3 color4"},
    {"ND_rgbtohsv_$", "rgbtohsv", "$ in=0", "$", rgbToHsv, Algebra::None, "color3 color4"},
    {"ND_hsvtorgb_$", "hsvtorgb", "$ in=0", "$", hsvToRgb, Algebra::None, "color3 color4"},
    {"ND_normalmap_$", "normalmap", normalMapFrame, "vector3", normalMap, Algebra::NormalMap,
     "float vector2"},
};

} // namespace

NodeRows vectorNodes() {
    return {std::begin(rows), std::end(rows)};
}

} // namespace patina
