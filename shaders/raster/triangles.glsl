// SPDX-License-Identifier: Apache-2.0
// Values of whole triangles: pulled by the fragment stage, so that corners can share vertices.
#define PATINA_ROW(vector, type, number, initial) vec3 vector; type number;
struct Triangle {
#include "shaders/raster/triangleFields.glsl"
};
#undef PATINA_ROW
layout(std430, binding = 2) readonly buffer Triangles { Triangle triangles[]; };
