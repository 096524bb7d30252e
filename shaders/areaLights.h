// SPDX-License-Identifier: Apache-2.0
#pragma once

// Lobes under area lights by their outlines, as C++, in the same namespace as the lobes.

#include "shaders/shaders.h"

#define PATINA_FN inline
#define PATINA_OUT(T) T&

namespace patina {
namespace sh {
#include "shaders/lib/ltcFit.glsl"

#include "shaders/lib/ltc.glsl"
} // namespace sh
} // namespace patina

#undef PATINA_FN
#undef PATINA_OUT
