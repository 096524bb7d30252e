// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/geometry/tangentFrames.h"

#include "hdDelegate/geometry/primvarEval.h"
#include "base/maths.h"

#include <cmath>

namespace patina {

namespace {

bool usable(const vec3& v) {
    const float length = glm::length(v);
    return length > 0.0f && std::isfinite(length);
}

} // namespace

TangentFrame tangentFrame(const vec3 positions[3], const vec2 st[3]) {
    TangentFrame frame;
    const vec3 e1 = positions[1] - positions[0], e2 = positions[2] - positions[0];
    const vec2 d1 = st[1] - st[0], d2 = st[2] - st[0];
    const float determinant = d1.x * d2.y - d1.y * d2.x;
    const vec3 n = glm::cross(e1, e2);
    if (!usable(n)) return frame;
    // Relative to the lengths: below this the coordinates are collinear up to rounding.
    if (std::abs(determinant) > 1e-7f * glm::length(d1) * glm::length(d2)) {
        frame.dpdu = (d2.y * e1 - d1.y * e2) / determinant;
        frame.dpdv = (d1.x * e2 - d2.x * e1) / determinant;
        frame.fromTexture = usable(frame.dpdu) && usable(frame.dpdv);
    }
    if (!frame.fromTexture) orthonormalBasis(n / glm::length(n), frame.dpdu, frame.dpdv);
    return frame;
}

TangentFrame tangentFrame(const TriangleMesh& mesh, const MeshAttribute* st, unsigned triangle,
                          size_t step) {
    vec3 positions[3];
    vec2 coordinates[3] = {vec2(0.0f), vec2(0.0f), vec2(0.0f)};
    for (int k = 0; k < 3; ++k) {
        positions[k] = mesh.positions[step][mesh.triangles[triangle][k]];
        float value[4];
        if (st && st->components >= 2 &&
            evalAttribute(mesh, *st, triangle, k == 1 ? 1.0f : 0.0f, k == 2 ? 1.0f : 0.0f, value))
            coordinates[k] = vec2(value[0], value[1]);
    }
    return tangentFrame(positions, coordinates);
}

} // namespace patina
