// SPDX-License-Identifier: Apache-2.0
// The fields of a light in a pass that follow those of shaders/lights/fields.glsl: its sample, links and shadows.
PATINA_ROW(sampled, int, category, -1)           // position, or direction to the light; links that say which prims are lit, -1 all
PATINA_ROW(normal, float, perPixel, 0)           // of the emitter there; samples that a pixel takes (0: one, of a dome domeSamples)
PATINA_ROW(shadowColor, float, domeSamples, 0)   // that a pass takes
PATINA_ROW(domeRadiance, int, firstHarmonic, -1) // without the image; of its harmonics in lightTables, -1 none
PATINA_NUMBERS(float, shadowDistance, shadowFalloff, shadowGamma, domeLayer, -1) // of domeMaps, -1 no image
// Of the sample: its first shadow map (-1 none), how many (0: those of the sky), more for fibres, and the number of the light
// at whose sample they were drawn (-1 this one).
PATINA_NUMBERS(int, firstMap, maps, fibreMaps, mapsFrom, -1)
