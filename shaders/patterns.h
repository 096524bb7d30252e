// SPDX-License-Identifier: Apache-2.0
#pragma once

// The pattern functions as C++, in the same namespace as the lobes.

#include "shaders/shaders.h"

#define PATINA_FN inline
#define PATINA_OUT(T) T&
#define PATINA_ATAN2(y, x) std::atan2(y, x)

namespace patina {
namespace sh {
using uint = unsigned int;
#include "shaders/patterns.glsl"
} // namespace sh
} // namespace patina

#undef PATINA_FN
#undef PATINA_OUT
#undef PATINA_ATAN2
