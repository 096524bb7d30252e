// SPDX-License-Identifier: Apache-2.0
// The fields of a light in a pass, row by row of 16 bytes. lights.glsl and
// hdDelegate/raster/lights/rasterLight.h make their structs of these rows:
//   PATINA_ROW(vector, type, number, initial)   a vec3 and a number; vectors begin as zero
//   PATINA_NUMBERS(type, a, b, c, d, initial)   four numbers that begin alike
PATINA_ROW(sampled, float, density, 0)      // position, or direction to the light; by area, by length, or by solid angle
PATINA_ROW(normal, int, kind, 0)            // of the emitter at the sample; see shaders/lights/kinds.glsl
PATINA_ROW(radiance, int, flags, 0)         // of domes that of the sample; see kinds.glsl, too
PATINA_ROW(origin, int, category, -1)       // of the shape; links that say which prims are lit, -1 all
PATINA_ROW(axis0, float, perPixel, 0)       // shape or dome to world; samples that a pixel takes (0: one, of a dome domeSamples)
PATINA_ROW(axis1, float, weight, 1)         // how often the light counts
PATINA_ROW(axis2, float, diffuse, 1)        // of a distant light the direction to its middle; share of diffuse light
PATINA_ROW(inverse0, float, specular, 1)    // world to shape; share of specular light
PATINA_ROW(inverse1, float, versine, 0)     // of a distant light, 1 - cosine of half its angle
PATINA_ROW(inverse2, float, domeSamples, 0) // that a pass takes
PATINA_ROW(shapingAxis, float, focus, 0)    // of triangles the pole of the table
PATINA_ROW(focusTint, float, coneStart, 0)  // angle at which the cone begins to fade, radians
PATINA_ROW(shapingX, float, coneEnd, 0)     // across the axis; where the cone ends
PATINA_ROW(shapingY, int, profileThetas, 0) // across both; size of the profile
PATINA_ROW(shadowColor, int, profilePhis, 0)
PATINA_ROW(domeRadiance, int, firstHarmonic, -1) // without the image; of its harmonics in lightTables, -1 none
PATINA_NUMBERS(float, shadowDistance, shadowFalloff, shadowGamma, domeLayer, -1) // of domeMaps, -1 no image
// Of the sample: its first shadow map (-1 none), how many (0: those of the sky), more for fibres, and the number of the light
// at whose sample they were drawn (-1 this one).
PATINA_NUMBERS(int, firstMap, maps, fibreMaps, mapsFrom, -1)
// In lightTables: first value over a rect or over a triangle's directions (-1 none), columns and rows; first of the profile.
PATINA_NUMBERS(int, firstValue, columns, rows, firstProfile, -1)
