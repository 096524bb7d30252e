// SPDX-License-Identifier: Apache-2.0
// Mathematics of pattern nodes, beyond plain arithmetic. Needs shaders/lib/degenerate.glsl.
#ifndef PATINA_ATAN2
#define PATINA_ATAN2(y, x) atan(y, x)
#endif
#include "shaders/patterns/color.glsl"
#include "shaders/patterns/normalMap.glsl"
#include "shaders/patterns/place2d.glsl"
#include "shaders/patterns/reflectance.glsl"
#include "shaders/patterns/blackbody.glsl"
#include "shaders/patterns/dispersion.glsl"
#include "shaders/patterns/noise.glsl"
#include "shaders/patterns/blur.glsl"
#include "shaders/patterns/worley.glsl"
#include "shaders/patterns/flake.glsl"
#include "shaders/patterns/shapes.glsl"
#include "shaders/patterns/ramp.glsl"
#include "shaders/patterns/hexTile.glsl"
