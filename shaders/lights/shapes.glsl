// SPDX-License-Identifier: Apache-2.0
// The shapes that lights have, by number. everyShape.glsl is made by shaders/CMakeLists.txt: the files
// of shaders/lights/shapes, and the functions that choose among them by number:
//   bool shapeHit(kind, o, d, out t, out q)   float shapePlaceDensity(kind, s, q)
//   vec3 shapePlace(kind, u)                  vec3 shapeNormalAt(kind, s, q)
//   vec3 shapeExtent(kind, s)
// A shape is named in its own file and nowhere else in shaders; see shape.glsl.
#include "shaders/lights/shape.glsl"
#include "shaders/everyShape.glsl"
