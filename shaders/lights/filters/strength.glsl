// SPDX-License-Identifier: Apache-2.0
// How much a filter does: density mixes from none of it to all of it. Written so that a strength far
// below 1 keeps its digits.

PATINA_FN vec3 filterStrength(vec3 value, bool invert, float density, float intensity) {
    vec3 kept = value;
    if (invert) kept = vec3(1.0f) - value;
    return (vec3(1.0f - density) + density * kept) * intensity;
}

// Rods change light inside of them. cover: of the point, 0..1
PATINA_FN float rodStrength(float cover, bool invert, float density, float intensity) {
    float inside = select(1.0f - cover, cover, invert);
    float share = density * inside;
    return 1.0f - share + share * intensity;
}
