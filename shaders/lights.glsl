// SPDX-License-Identifier: Apache-2.0
// All that makes up lights. Hosts that compile GLSL may include fewer of these, in this order.
#include "shaders/lights/table.glsl"
#include "shaders/lights/ies.glsl"
#include "shaders/lights/shaping.glsl"
#include "shaders/lights/basis.glsl"
#include "shaders/lights/shapes.glsl"
#include "shaders/lights/sphereInside.glsl"
#include "shaders/lights/line.glsl"
#include "shaders/lights/distant.glsl"
#include "shaders/lights/dome.glsl"
#include "shaders/lights/filters/box.glsl"
#include "shaders/lights/filters/opening.glsl"
#include "shaders/lights/filters/ramp.glsl"
