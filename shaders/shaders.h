#pragma once

// The shader dialect as C++: every lobe in float (patina::sh) and in double (patina::sh64), from
// the text that the rasterizer reads as GLSL. The double instance is the oracle of the tests and
// the source of the baked tables; it reads the same float tables.

#include <cmath>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace patina {

/// Baked directional albedo tables, sh::ALBEDO_TABLE_SIZE floats; shaders/lib/albedoTable.glsl says
/// how they are laid out. Written by shaders/bake at build time. The rasterizer uploads them.
extern const float *const patinaAlbedoTable;

namespace sh {
#include "shaders/compat/cpp.h"
#include "shaders/lobes.glsl"
} // namespace sh

#undef PATINA_FN
#undef PATINA_OUT

namespace sh64 {
#define float double
#include "shaders/compat/cpp.h"
#include "shaders/lobes.glsl"
#undef float
} // namespace sh64

#undef PATINA_FN
#undef PATINA_OUT

} // namespace patina
