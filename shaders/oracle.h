// SPDX-License-Identifier: Apache-2.0
#pragma once

// Every lobe of the dialect once more in double (patina::sh64): the oracle of tests and of
// measurements, and the source of the baked tables. It reads the float tables of shaders.h.

#include "shaders/shaders.h"

namespace patina {

namespace sh64 {
#define float double
#include "shaders/compat/cpp.h"
#include "shaders/lobes.glsl"
#undef float
} // namespace sh64

#undef PATINA_FN
#undef PATINA_FN_RARE
#undef PATINA_OUT
#undef PATINA_INOUT
#undef PATINA_UNUSED
#undef PATINA_ENERGY_KNOWN
#undef PATINA_COMPENSATE
#undef PATINA_ALBEDO_METHOD
#undef PATINA_FRESNEL
#undef PATINA_FILM
#undef PATINA_FILM_METHOD

} // namespace patina
