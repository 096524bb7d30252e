// SPDX-License-Identifier: Apache-2.0
#pragma once

// Every lobe of the dialect once more in double (patina::sh64): the oracle of tests and of
// measurements, and the source of the baked tables. It reads the float tables of shaders.h.

#include "shaders/shaders.h"

namespace patina {

namespace sh64 {
#define float double
#include "shaders/compat/cpp.h"
inline float albedoTableFetch(int index) {
    return float(patinaAlbedoTable[index]);
}
#include "shaders/lobes.glsl"
#undef float
} // namespace sh64

#include "shaders/compat/cppEnd.h"

} // namespace patina
