// SPDX-License-Identifier: Apache-2.0
// The fields of a light on a GPU, row by row of 16 bytes. hdDelegate/lights/lightFields.h and the `struct Light` of each
// host that compiles GLSL are made of these rows:
//   PATINA_ROW(vector, type, number, initial)   a vec3 and a number; vectors begin as zero
//   PATINA_NUMBERS(type, a, b, c, d, initial)   four numbers that begin alike
PATINA_ROW(radiance, int, kind, 0)            // of delta lights the irradiance or intensity; see kinds.glsl
PATINA_ROW(origin, int, flags, 0)             // of the shape, the place of a point, the middle of a line; see kinds.glsl, too
PATINA_ROW(axis0, float, weight, 1)           // shape or dome to world, of lines the direction; how often the light counts
PATINA_ROW(axis1, float, diffuse, 1)          // share of diffuse light
PATINA_ROW(axis2, float, specular, 1)         // of a distant light the direction to its middle; share of specular light
PATINA_ROW(inverse0, float, versine, 0)       // world to shape; of a distant light, 1 - cosine of half its angle
PATINA_ROW(inverse1, float, density, 0)       // of samples: by area, by length, or by solid angle
PATINA_ROW(inverse2, float, focus, 0)
PATINA_ROW(focusTint, float, coneStart, 0)    // angle at which the cone begins to fade, radians
PATINA_ROW(shapingAxis, float, coneEnd, 0)    // of triangles the pole of the table; where the cone ends
PATINA_ROW(shapingX, int, profileThetas, 0)   // across the axis; size of the profile
PATINA_ROW(shapingY, int, profilePhis, 0)     // across both
// In the host's table: first value over a rect or over a triangle's directions (-1 none), columns and rows; first of the
// profile. Of a mesh the first of its triangles, and how many.
PATINA_NUMBERS(int, firstValue, columns, rows, firstProfile, -1)
