// SPDX-License-Identifier: Apache-2.0
// Data of all passes. Binding points: uniform blocks 0 pass, 1 parameters of a material; storage
// 2 vertices, 3 instances, 4 lights, 5 shadow matrices, 6 primvars, 7 albedo tables, 8 tables of lights,
// 9 links, 10 sky cells, 11 values of instances, 12 records of draws; textures from 16 on: 16 domes, 17 their
// densities, 18 shadow maps, 19 maps of the sky's cells, 20 prefiltered domes, 21 to 24 what is behind (refraction.glsl).
#define PATINA_MATRIX(name) mat4 name;
#define PATINA_ROW(vector, type, number, initial) vec3 vector; type number;
#define PATINA_NUMBERS(type, a, b, c, d, initial) type a, b, c, d;
#define PATINA_ROWS(name, count) vec4 name[count];
layout(std140, binding = 0) uniform Pass {
#include "shaders/raster/passFields.glsl"
};
#undef PATINA_MATRIX
#undef PATINA_ROW
#undef PATINA_NUMBERS
#undef PATINA_ROWS
