// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/scene/types.h"

namespace patina {

/// A point on a triangle with its density over solid angle.
struct TriangleSample {
    vec3 position{0.0f}, normal{0.0f};
    vec2 barycentrics{0.0f}; ///< weights of vertices 1 and 2
    float pdf = 0.0f;
};

/// Chooses a point on a triangle, uniformly in solid angle where that is well conditioned (Arvo
/// 1995, Stratified Sampling of Spherical Triangles), else uniformly in area.
/// @returns false when the side that emits faces away, or the triangle has no area
bool sampleTriangle(const vec3 v[3], bool twoSided, const vec3& point, const vec2& u,
                    TriangleSample& out);

/// Solid angle density with which sampleTriangle() finds a position on the triangle.
float trianglePdf(const vec3 v[3], bool twoSided, const vec3& point, const vec3& position);

} // namespace patina
