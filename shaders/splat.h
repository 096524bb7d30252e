// SPDX-License-Identifier: Apache-2.0
#pragma once

// The kernels of particle fields of the shader dialect as C++, in floats alone. They are apart from
// the lobes, so that what knows splats does not compile those.

#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#define PATINA_IN(T) const T&

namespace patina {
namespace shSplats {
#include "shaders/compat/cpp.h"

using glm::mat3;

inline float exp(float x) {
    return std::exp(x);
}

#include "shaders/lib/splat.glsl"

} // namespace shSplats
} // namespace patina

#undef PATINA_IN
#include "shaders/compat/cppEnd.h"
