// SPDX-License-Identifier: Apache-2.0
// Estimates of the irradiance that a light sends to a place, for choosing among many lights. What hides a light, images and
// profiles are left out. Far from a light the estimate is exact but for these; near it, it is right within a small factor.

// From a light's middle line to a point. Compact lights have no such line.
PATINA_FN vec3 estimateFrom(vec3 place, vec3 along, vec3 point) {
    vec3 v = point - place;
    float l2 = dot(along, along);
    float t = select(0.0f, clamp(dot(v, along) / max(l2, 1e-30f), -1.0f, 1.0f), l2 > 0.0f);
    return v - t * along;
}

// Of a light that faces the point. Falls from 1 / away^2 far away to 1 / away beside what is long.
PATINA_FN float estimateAt(float power, float radius, float least, float away) {
    return power / max(away * max(away, radius), least);
}

// How much of that goes in a direction. cosine: of its angle to the axis; spread: of the directions to the parts of the
// light. It rises from 0 at `start` by `slope`, and never falls to nothing, so that no light is left out.
PATINA_FN float estimateTowards(float cosine, float start, float slope, float spread) {
    return clamp((cosine - start) * slope + spread, 0.05f, 1.0f);
}
