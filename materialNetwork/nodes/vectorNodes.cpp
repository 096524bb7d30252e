// SPDX-License-Identifier: Apache-2.0
// Nodes that look at a vector as a whole.
#include "materialNetwork/nodes/nodeTable.h"

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

constexpr char dotProductGlsl[] = "vec4(nodeDot($0, $1, $s))";
constexpr Pattern dotProduct =
    pattern(dotProductGlsl, [](Call c) { c.out() = vec4(dotOf(c, 0, 1)); });
constexpr Pattern magnitude = pattern("vec4(sqrt(nodeDot($0, $0, $s)))",
                                      [](Call c) { c.out() = vec4(std::sqrt(dotOf(c, 0, 0))); });

constexpr Pattern distance = pattern("vec4(sqrt(nodeDot($0 - $1, $0 - $1, $s)))", [](Call c) {
    float sum = 0.0f;
    for (int i = 0; i < c.data.size; ++i)
        sum += (c.in(0)[i] - c.in(1)[i]) * (c.in(0)[i] - c.in(1)[i]);
    c.out() = vec4(std::sqrt(sum));
});

constexpr Pattern normalized = pattern("nodeNormalize($0, $s)", [](Call c) {
    const float length = std::sqrt(dotOf(c, 0, 0));
    c.out() = length > 0.0f ? c.in(0) / length : vec4(0.0f);
});

constexpr Pattern crossProduct = pattern("vec4(cross($0.xyz, $1.xyz), 0.0)", [](Call c) {
    c.out() = vec4(glm::cross(vec3(c.in(0)), vec3(c.in(1))), 0.0f);
});

constexpr Pattern rotate2d = pattern("vec4(patternRotate2d($0.xy, $1.x), 0.0, 0.0)", [](Call c) {
    c.out() = vec4(sh::patternRotate2d(vec2(c.in(0)), c.x(1)), 0.0f, 0.0f);
});

constexpr Pattern rotate3d =
    pattern("vec4(patternRotate3d($0.xyz, $1.x, $2.xyz), 0.0)", [](Call c) {
        c.out() = vec4(sh::patternRotate3d(vec3(c.in(0)), c.x(1), vec3(c.in(2))), 0.0f);
    });

template <bool Largest> void component(Call c) {
    float x = c.in(0).x;
    for (int i = 1; i < c.data.size; ++i)
        x = Largest ? std::fmax(x, c.in(0)[i]) : std::fmin(x, c.in(0)[i]);
    c.out() = vec4(x);
}

constexpr char place2dGlsl[] =
    "vec4(patternPlace2d($0.xy, $1.xy, $2.xy, $3.x, $4.xy, int($5.x)), 0.0, 0.0)";
constexpr Pattern place2d = pattern(place2dGlsl, [](Call c) {
    c.out() = vec4(sh::patternPlace2d(vec2(c.in(0)), vec2(c.in(1)), vec2(c.in(2)), c.x(3),
                                      vec2(c.in(4)), c.whole(5)),
                   0.0f, 0.0f);
});

constexpr char transform2dGlsl[] = "vec4(patternTransform2d($0.xy, $2.xy, $1.x, $3.xy), 0.0, 0.0)";
constexpr Pattern transform2d = pattern(transform2dGlsl, [](Call c) {
    c.out() = vec4(sh::patternTransform2d(vec2(c.in(0)), vec2(c.in(2)), c.x(1), vec2(c.in(3))),
                   0.0f, 0.0f);
});

constexpr Pattern luminance =
    pattern("vec4(vec3(patternLuminance($0.xyz, $1.xyz)), $0.w)", [](Call c) {
        const float y = sh::patternLuminance(vec3(c.in(0)), vec3(c.in(1)));
        c.out() = vec4(y, y, y, c.in(0).w);
    });

constexpr Pattern rgbToHsv = pattern("vec4(patternRgbToHsv($0.xyz), $0.w)", [](Call c) {
    c.out() = vec4(sh::patternRgbToHsv(vec3(c.in(0))), c.in(0).w);
});

constexpr Pattern hsvToRgb = pattern("vec4(patternHsvToRgb($0.xyz), $0.w)", [](Call c) {
    c.out() = vec4(sh::patternHsvToRgb(vec3(c.in(0))), c.in(0).w);
});

constexpr char normalMapGlsl[] =
    "vec4(patternNormalMap($0.xyz, $1.xy, $2.xyz, $3.xyz, $4.xyz), 0.0)";
constexpr Pattern normalMap = pattern(normalMapGlsl, [](Call c) {
    c.out() = vec4(sh::patternNormalMap(vec3(c.in(0)), vec2(c.in(1)), vec3(c.in(2)), vec3(c.in(3)),
                                        vec3(c.in(4))),
                   0.0f);
});

constexpr Pattern maxComponent = pattern("vec4(nodeLargest($0, $s))", component<true>);
constexpr Pattern minComponent = pattern("vec4(-nodeLargest(-$0, $s))", component<false>);

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
    {"ND_maxcomponent_$", "maxcomponent", "$ in=0", "float", maxComponent, Algebra::None,
     tupleTypes},
    {"ND_mincomponent_$", "mincomponent", "$ in=0", "float", minComponent, Algebra::None,
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
