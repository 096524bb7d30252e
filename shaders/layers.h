#pragma once

// The functions of layers as C++, in the same namespace as the lobes.

#include "shaders/shaders.h"

#define PATINA_FN inline
#define PATINA_OUT(T) T&

namespace patina {
namespace sh {
#include "shaders/lib/layers.glsl"
} // namespace sh
} // namespace patina

#undef PATINA_FN
#undef PATINA_OUT
