// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include <cmath>

namespace patina {

// Constants and functions that every room computes with.

inline constexpr float pi = 3.14159265358979323846f;
inline constexpr double piDouble = 3.14159265358979323846;

/// Of linear light with the primaries of Rec. 709 (ITU-R BT.709).
inline float luminance(const glm::vec3& c) {
    return glm::dot(c, glm::vec3(0.2126f, 0.7152f, 0.0722f));
}

/// Two unit vectors that complete a right-handed frame (Duff et al. 2017).
/// @param n of unit length
inline void orthonormalBasis(const glm::vec3& n, glm::vec3& t, glm::vec3& b) {
    const float sign = std::copysign(1.0f, n.z);
    const float a = -1.0f / (sign + n.z);
    const float c = n.x * n.y * a;
    t = glm::vec3(1.0f + sign * n.x * n.x * a, sign * c, -sign * n.x);
    b = glm::vec3(c, sign + n.y * n.y * a, -n.y);
}

/// A point of the unit disk; equal areas of the unit square stay equal (Shirley and Chiu 1997).
/// @param u both 0..1
inline glm::vec2 concentricDisk(const glm::vec2& u) {
    const glm::vec2 p = 2.0f * u - 1.0f;
    if (p.x == 0.0f && p.y == 0.0f) return glm::vec2(0.0f);
    const bool wide = std::abs(p.x) > std::abs(p.y);
    const float r = wide ? p.x : p.y;
    const float phi = wide ? 0.25f * pi * (p.y / p.x) : 0.5f * pi - 0.25f * pi * (p.x / p.y);
    return r * glm::vec2(std::cos(phi), std::sin(phi));
}

} // namespace patina
