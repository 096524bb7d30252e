// SPDX-License-Identifier: Apache-2.0
#pragma once

// The light functions of the shader dialect as C++, in floats alone. They are apart from the lobes,
// so that what knows lights does not compile those.

#include <cmath>
#include <cstring>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#define PATINA_IN(T) const T&

namespace patina {
namespace shLights {
#include "shaders/compat/cpp.h"

using glm::mat3;

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

#undef PATINA_IN
#include "shaders/compat/cppEnd.h"
