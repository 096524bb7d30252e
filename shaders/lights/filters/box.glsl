// SPDX-License-Identifier: Apache-2.0
// The rounded box of rods and, as a rectangle of any depth, of barn doors: an inner box, grown by a radius, with a soft
// edge outside. Lengths are the filter's own.

struct FilterBox {
    vec3 low; // of the inner box
    vec3 high;
    vec3 edgeLow; // thickness of the edge beyond each side
    vec3 edgeHigh;
    float radius;
};

// 1 inside, 0 beyond the edge. Around corners the thicknesses of the sides mix by how far the point is beyond each.
PATINA_FN float filterBoxCover(PATINA_IN(FilterBox) b, vec3 q) {
    vec3 below = max(b.low - q, vec3(0.0f));
    vec3 above = max(q - b.high, vec3(0.0f));
    vec3 beyond = below + above;
    float square = dot(beyond, beyond);
    float outside = sqrt(square) - b.radius;
    if (outside <= 0.0f) return 1.0f;
    float edge = (dot(below * below, b.edgeLow) + dot(above * above, b.edgeHigh)) / square;
    float t = clamp(outside / max(edge, 1e-20f), 0.0f, 1.0f);
    return 1.0f - t * t * (3.0f - 2.0f * t);
}
