// SPDX-License-Identifier: Apache-2.0
// Nodes that need their input at neighbouring points. Graphs are evaluated at one point, so the
// part of the graph that makes their input is copied, with the texture coordinates and
// positions that it reads moved a little (materialNetwork/graph/differences.h).
#include "materialNetwork/nodes/nodeTable.h"

#include "shaders/patterns.h"

#include <algorithm>

namespace patina {

namespace {

using glm::vec3;
using glm::vec4;
using Call = const PatternCall&;

/// Half a pixel, but no less than what floats can tell apart. In units of the uv set.
float step(Call c) {
    return std::max(0.5f * c.point().uvFootprint, 1.0f / 4096.0f);
}

/// Inputs (in, axis).
constexpr Pattern shiftTexcoord = rarePattern("nodeShiftTexcoord($0, $1.x)", [](Call c) {
    vec4 v = c.in(0);
    v[c.x(1) != 0.0f ? 1 : 0] += step(c);
    c.out() = v;
});

/// Inputs (in, axis, world).
constexpr Pattern shiftPosition = rarePattern("nodeShiftPosition($0, $1.x, $2.x)", [](Call c) {
    const ShadingPoint& p = c.point();
    vec3 d = (c.x(1) != 0.0f ? p.bitangent : p.tangent) * (step(c) * p.lengthPerUv);
    if (c.x(2) == 0.0f) d = glm::transpose(p.objectToWorldNormal) * d;
    c.out() = c.in(0) + vec4(d, 0.0f);
});

/// Inputs (height here, along u, along v, scale, texcoord here, along u, along v): the normal of
/// the height over the texture coordinates. The factor 1/16 is that of the Sobel filter which this
/// node was once defined by.
constexpr char slopeGlsl[] = "nodeSlope($0.x, $1.x, $2.x, $3.x, $4.xy, $5.xy, $6.xy)";
constexpr Pattern slope = rarePattern(slopeGlsl, [](Call c) {
    const float k = 1.0f / step(c), scale = c.x(3) / 16.0f;
    const auto along = [&](int height, int place) {
        return vec3((c.in(place).x - c.in(4).x) * k, (c.in(place).y - c.in(4).y) * k,
                    (c.x(height) - c.x(0)) * k * scale);
    };
    vec3 n = glm::cross(along(1, 5), along(2, 6));
    if (n.z < 0.0f) n = -n; // mirrored coordinates
    const float length = glm::length(n);
    c.out() =
        vec4((length > 1e-6f && length < 1e30f ? n / length : vec3(0, 0, 1)) * 0.5f + 0.5f, 0.0f);
});

/// The value where the height is the same everywhere.
constexpr char flatGlsl[] = "vec4(0.5, 0.5, 1.0, 0.0)";
constexpr Pattern flat =
    rarePattern(flatGlsl, [](Call c) { c.out() = vec4(0.5f, 0.5f, 1.0f, 0.0f); });

/// The value of a blur where its input is the same everywhere.
constexpr Pattern same = rarePattern("$0", [](Call c) { c.out() = c.in(0); });

/// Inputs (in, size, blur, tap, gaussian): where the tap lies, in units of the uv set.
glm::vec2 tapOf(Call c) {
    return std::max(c.x(1), 0.0f) *
           sh::patternBlurTap(c.point().seed, c.whole(2), c.whole(3), c.x(4) != 0.0f);
}

constexpr Pattern moveTexcoord =
    rarePattern("$0 + vec4(nodeBlurTap($1.x, $2.x, $3.x, $4.x), 0.0, 0.0)",
                [](Call c) { c.out() = c.in(0) + vec4(tapOf(c), 0.0f, 0.0f); });

/// One more input: world.
constexpr Pattern movePosition =
    rarePattern("nodeMovePosition($0, nodeBlurTap($1.x, $2.x, $3.x, $4.x), $5.x)", [](Call c) {
        const ShadingPoint& p = c.point();
        const glm::vec2 by = tapOf(c);
        vec3 d = (p.tangent * by.x + p.bitangent * by.y) * p.lengthPerUv;
        if (c.x(5) == 0.0f) d = glm::transpose(p.objectToWorldNormal) * d;
        c.out() = c.in(0) + vec4(d, 0.0f);
    });

const NodeRow rows[] = {
    {"ND_heighttonormal_vector3", "heighttonormal",
     "float in=0, float scale=1, vector2 texcoord=@UV0", "vector3", flat},
    {"ND_blur_$", "blur", "$ in=0, float size=0, string filtertype=box", "$", same, Algebra::None,
     allTypes},
    {"PatinaShiftTexcoord_$", "shift_texcoord", "$ in=0, float axis=0", "$", shiftTexcoord,
     Algebra::None, "vector2 vector3", nullptr, true},
    {"PatinaShiftPosition", "shift_position", "vector3 in=0, float axis=0, float world=0",
     "vector3", shiftPosition, Algebra::None, nullptr, nullptr, true},
    {"PatinaMoveTexcoord_$", "move_texcoord",
     "$ in=0, float size=0, float blur=0, float tap=0, float gaussian=0", "$", moveTexcoord,
     Algebra::None, "vector2 vector3", nullptr, true},
    {"PatinaMovePosition", "move_position",
     "vector3 in=0, float size=0, float blur=0, float tap=0, float gaussian=0, float world=0",
     "vector3", movePosition, Algebra::None, nullptr, nullptr, true},
    {"PatinaSlope", "slope",
     "float here=0, float along_u=0, float along_v=0, float scale=1, "
     "vector2 texcoord=0, vector2 texcoord_u=0, vector2 texcoord_v=0",
     "vector3", slope, Algebra::None, nullptr, nullptr, true},
};

} // namespace

NodeRows differenceNodes() {
    return {std::begin(rows), std::end(rows)};
}

} // namespace patina
