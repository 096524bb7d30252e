// SPDX-License-Identifier: Apache-2.0
// Nodes that bring points, vectors and normals from one space to another, and what belongs to the
// frame and the view.
#include "materialNetwork/nodes/nodeTable.h"

#include "shaders/patterns.h"

#include <cmath>

namespace patina {

namespace {

using glm::mat3;
using glm::vec3;
using glm::vec4;
using Call = const PatternCall&;

enum Direction { Same, ToWorld, ToObject };

void prepareSpaces(PatternSetup& setup, PatternData& data) {
    const auto world = [&](const char* input) {
        const std::string space = setup.text(input);
        if (space != "world" && space != "object" && space != "model" && !space.empty())
            setup.warn(input, "unknown space '" + space + "'; world space is used");
        return space != "object" && space != "model";
    };
    const bool from = world("fromspace"), to = world("tospace");
    data.mode = from == to ? Same : to ? ToWorld : ToObject;
}

/// The linear part of the object's matrix; normals go by the inverse of its transpose.
mat3 objectToWorld(Call c) {
    return glm::transpose(glm::inverse(c.point().objectToWorldNormal));
}

constexpr Pattern transformPoint = rarePattern("nodeTransformPoint($m, $0)", [](Call c) {
    const vec3 p(c.in(0));
    if (c.data.mode == Same) {
        c.out() = c.in(0);
    } else if (c.data.mode == ToWorld) {
        c.out() = vec4(
            objectToWorld(c) * (p - c.point().objectPosition) + c.point().worldPosition(), 0.0f);
    } else {
        const mat3 inverse = glm::transpose(c.point().objectToWorldNormal);
        c.out() = vec4(inverse * (p - c.point().worldPosition()) + c.point().objectPosition, 0.0f);
    }
});

constexpr char transformVectorGlsl[] = "nodeTransformVector($m, $0)";
constexpr Pattern transformVector = rarePattern(transformVectorGlsl, [](Call c) {
    const vec3 v(c.in(0));
    c.out() = c.data.mode == Same      ? c.in(0)
              : c.data.mode == ToWorld ? vec4(objectToWorld(c) * v, 0.0f)
                                       : vec4(glm::transpose(c.point().objectToWorldNormal) * v, 0);
});

constexpr char transformNormalGlsl[] = "nodeTransformNormal($m, $0)";
constexpr Pattern transformNormal = rarePattern(transformNormalGlsl, [](Call c) {
    const vec3 n(c.in(0));
    const vec3 m = c.data.mode == Same      ? n
                   : c.data.mode == ToWorld ? c.point().objectToWorldNormal * n
                                            : glm::inverse(c.point().objectToWorldNormal) * n;
    const float length = glm::length(m);
    c.out() = vec4(length > 0.0f && std::isfinite(length) ? m / length : n, 0.0f);
});

constexpr Pattern reflect =
    rarePattern("vec4($0.xyz - $1.xyz * (2.0 * dot($1.xyz, $0.xyz)), 0.0)", [](Call c) {
        const vec3 i(c.in(0)), n(c.in(1));
        c.out() = vec4(i - n * (2.0f * glm::dot(n, i)), 0.0f);
    });

/// ior is the ratio from the side that the vector comes from to the other. 0 at total reflection.
constexpr Pattern refract = rarePattern("nodeRefract($0.xyz, $1.xyz, $2.x)", [](Call c) {
    const vec3 i(c.in(0)), n(c.in(1));
    const float eta = c.x(2), d = glm::dot(i, n);
    const float k = 1.0f - eta * eta * (1.0f - d * d);
    c.out() = k < 0.0f ? vec4(0.0f) : vec4(i * eta - n * (eta * d + std::sqrt(k)), 0.0f);
});

/// Inputs (viewdirection, normal, faceforward, invert). MaterialX's view direction points away
/// from the eye, the network's towards it, so the sign is the other here.
constexpr Pattern facingRatio =
    rarePattern("nodeFacingRatio($0.xyz, $1.xyz, $2.x, $3.x)", [](Call c) {
        const float d = glm::dot(vec3(c.in(0)), vec3(c.in(1)));
        const float facing = c.x(2) != 0.0f ? std::fabs(d) : d;
        c.out() = vec4(c.x(3) != 0.0f ? 1.0f - facing : facing);
    });

/// Inputs (warm_color, cool_color, specular_intensity, shininess, light_direction). Gooch et al.
/// 1998, "A non-photorealistic lighting model for automatic technical illustration".
constexpr Pattern goochShade = rarePattern("nodeGooch($0, $1, $2.x, $3.x, $4.xyz)", [](Call c) {
    const vec3 n = c.point().normal, v = -c.point().viewDirection;
    const vec3 raw(c.in(4));
    const float length = glm::length(raw);
    const vec3 l = length > 0.0f ? raw / length : vec3(0, 0, 1);
    const float cool = 0.5f * (1.0f + glm::dot(n, l));
    const vec3 reflected = v - n * (2.0f * glm::dot(n, v));
    const float highlight =
        sh::powSchlick(glm::max(glm::dot(-l, reflected), 0.0f), c.x(3)) * c.x(2);
    c.out() = c.in(0) + (c.in(1) - c.in(0)) * cool + highlight;
});

constexpr Pattern frame = rarePattern("vec4($0.x)", [](Call c) { c.out() = vec4(c.x(0)); });
/// Inputs (fps, frame).
constexpr Pattern time = rarePattern("vec4($0.x != 0.0 ? $1.x / $0.x : 0.0)", [](Call c) {
    c.out() = vec4(c.x(0) != 0.0f ? c.x(1) / c.x(0) : 0.0f);
});

#define PATINA_SPACES "string fromspace=, string tospace="

const NodeRow rows[] = {
    {"ND_transformpoint_vector3", "transformpoint", "vector3 in=0, " PATINA_SPACES, "vector3",
     transformPoint, Algebra::None, nullptr, prepareSpaces, true},
    {"ND_transformvector_vector3", "transformvector", "vector3 in=0, " PATINA_SPACES, "vector3",
     transformVector, Algebra::None, nullptr, prepareSpaces, true},
    {"ND_transformnormal_vector3", "transformnormal", "vector3 in=0 0 1, " PATINA_SPACES, "vector3",
     transformNormal, Algebra::None, nullptr, prepareSpaces, true},
    {"ND_reflect_vector3", "reflect", "vector3 in=1 0 0, vector3 normal=@Nworld", "vector3",
     reflect},
    {"ND_refract_vector3", "refract", "vector3 in=1 0 0, vector3 normal=@Nworld, float ior=1",
     "vector3", refract},
    {"ND_facingratio_float", "facingratio",
     "vector3 viewdirection=@Vworld, vector3 normal=@Nworld, boolean faceforward=1, "
     "boolean invert=0",
     "float", facingRatio},
    {"ND_gooch_shade", "gooch_shade",
     "color3 warm_color=0.8 0.8 0.7, color3 cool_color=0.3 0.3 0.8, float specular_intensity=1, "
     "float shininess=64, vector3 light_direction=1 -0.5 -0.5",
     "color3", goochShade, Algebra::None, nullptr, nullptr, true},
    // The host writes the number of the frame into the input `frame`, which MaterialX does not
    // have.
    {"ND_frame_float", "frame", "float frame=1", "float", frame},
    {"ND_time_float", "time", "float fps=24, float frame=1", "float", time},
};

} // namespace

NodeRows spaceNodes() {
    return {std::begin(rows), std::end(rows)};
}

} // namespace patina
