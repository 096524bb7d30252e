// SPDX-License-Identifier: Apache-2.0
#pragma once

// The light functions of the shader dialect as C++. They are apart from the lobes, so that what
// knows lights does not compile those; and in floats alone, so that the vectors' functions are
// glm's own.

#include <cmath>
#include <cstring>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#define PATINA_FN inline
#define PATINA_FN_RARE [[gnu::noinline]] inline
#define PATINA_IN(T) const T&
#define PATINA_OUT(T) T&

namespace patina {
namespace shLights {

using glm::mat3;
using glm::vec2;
using glm::vec3;
using glm::vec4;

using glm::cross;
using glm::dot;
using glm::length;
using glm::normalize;

constexpr float PI = 3.14159265358979323846f;
constexpr float INV_PI = 0.318309886183790671538f;
constexpr float TWO_PI = 6.28318530717958647693f;

inline float select(float a, float b, bool cond) {
    return cond ? a : b;
}
inline int select(int a, int b, bool cond) {
    return cond ? a : b;
}
inline float sqrt(float x) {
    return std::sqrt(x);
}
inline float abs(float x) {
    return std::fabs(x);
}
inline vec3 sqrt(const vec3& v) {
    return glm::sqrt(v);
}
inline vec3 abs(const vec3& v) {
    return glm::abs(v);
}
inline vec3 max(const vec3& a, const vec3& b) {
    return glm::max(a, b);
}
inline float floor(float x) {
    return std::floor(x);
}
inline float pow(float x, float y) {
    return std::pow(x, y);
}
inline float sin(float x) {
    return std::sin(x);
}
inline float cos(float x) {
    return std::cos(x);
}
inline float tan(float x) {
    return std::tan(x);
}
inline float asin(float x) {
    return std::asin(x);
}
inline float acos(float x) {
    return std::acos(x);
}
inline float atan(float y, float x) {
    return std::atan2(y, x);
}
// The comparison is written so that a NaN in the first argument yields the second one.
inline float max(float a, float b) {
    return a > b ? a : b;
}
inline float min(float a, float b) {
    return a < b ? a : b;
}
inline int max(int a, int b) {
    return a > b ? a : b;
}
inline int min(int a, int b) {
    return a < b ? a : b;
}
inline float clamp(float x, float low, float high) {
    return min(max(x, low), high);
}
inline int floatBitsToInt(float x) {
    int bits;
    std::memcpy(&bits, &x, sizeof bits);
    return bits;
}

// Shapes have the same functions, some of which need not ask where.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-parameter"
#include "shaders/lights.glsl"
#pragma GCC diagnostic pop

} // namespace shLights
} // namespace patina

#undef PATINA_FN
#undef PATINA_FN_RARE
#undef PATINA_IN
#undef PATINA_OUT
