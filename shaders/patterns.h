// SPDX-License-Identifier: Apache-2.0
#pragma once

// The pattern functions as C++, in the same namespace as the lobes.

#include "shaders/shaders.h"

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>

#define PATINA_FN inline
#define PATINA_OUT(T) T&

namespace patina {
namespace sh {
#include "shaders/compat/cppPatterns.h"
#include "shaders/patterns.glsl"
} // namespace sh
} // namespace patina

#undef PATINA_FN
#undef PATINA_OUT
