// SPDX-License-Identifier: Apache-2.0
#pragma once

// How lobes become a material, as C++, in the same namespace as the lobes.

#include "shaders/shaders.h"

#define PATINA_FN inline
#define PATINA_OUT(T) T&
#define PATINA_INOUT(T) T&

namespace patina {
namespace sh {
#include "shaders/closure.glsl"
} // namespace sh
} // namespace patina

#undef PATINA_FN
#undef PATINA_OUT
#undef PATINA_INOUT
