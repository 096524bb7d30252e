// SPDX-License-Identifier: Apache-2.0
// Amounts as authored, made fit to compute with: negative and NaN count as 0. They are compared, since
// drivers may pick either side of max() where one is NaN.

PATINA_FN float largest(vec3 c) {
    return max(c.x, max(c.y, c.z));
}
// Of linear light with the primaries of Rec. 709 (ITU-R BT.709).
PATINA_FN float luminance(vec3 c) {
    return dot(c, vec3(0.2126f, 0.7152f, 0.0722f));
}

// A share.
PATINA_FN float unit(float x) {
    return select(min(x, 1.0f), 0.0f, x > 0.0f);
}
PATINA_FN vec3 unitColor(vec3 c) {
    return vec3(unit(c.x), unit(c.y), unit(c.z));
}

PATINA_FN float heldBelow(float x, float bound) {
    return select(min(x, bound), 0.0f, x > 0.0f);
}
// A factor on a BSDF.
PATINA_FN vec3 factor(vec3 c) {
    return vec3(heldBelow(c.x, COLOR_MAX), heldBelow(c.y, COLOR_MAX), heldBelow(c.z, COLOR_MAX));
}
// Emission, which may be far brighter than a colour.
PATINA_FN vec3 emitted(vec3 c) {
    return vec3(heldBelow(c.x, EMISSION_MAX), heldBelow(c.y, EMISSION_MAX), heldBelow(c.z, EMISSION_MAX));
}
// A coefficient of a medium; products of them stay finite.
const float COEFFICIENT_MAX = 1e15f;
PATINA_FN vec3 coefficient(vec3 c) {
    return vec3(heldBelow(c.x, COEFFICIENT_MAX), heldBelow(c.y, COEFFICIENT_MAX),
                heldBelow(c.z, COEFFICIENT_MAX));
}

// Closures are linear: sums of parts times factors.
PATINA_FN vec3 closureSum(vec3 a, vec3 b) {
    return a + b;
}
PATINA_FN vec3 closureScaled(vec3 a, float share) {
    return a * share;
}
// The part of `a` that a share leaves.
PATINA_FN vec3 closureRest(vec3 a, float share) {
    return a * (1.0f - share);
}
PATINA_FN vec3 closureProduct(vec3 a, vec3 b) {
    return a * b;
}
// tint: as authored.
PATINA_FN vec3 closureTinted(vec3 a, vec3 tint) {
    return a * factor(tint);
}
// share: of a.
PATINA_FN vec3 closureMix(vec3 a, vec3 b, float share) {
    return a * share + b * (1.0f - share);
}
