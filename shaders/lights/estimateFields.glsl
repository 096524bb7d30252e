// SPDX-License-Identifier: Apache-2.0
// What tells about how much a light sends to a place, row by row as in fields.glsl; see estimate.glsl.
PATINA_ROW(place, float, power, 0)             // the middle; intensity far away, along the brightest direction
PATINA_ROW(along, float, radius, 0)            // by how much it is longer than wide, half of that; of the ball around it
PATINA_ROW(axis, float, least, 0)              // about which it shines; squared distance below which nearer is no brighter
PATINA_NUMBERS(float, start, slope, found, unusedA, 0) // see estimateTowards(); 1 where rays can meet it
