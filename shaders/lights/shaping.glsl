// SPDX-License-Identifier: Apache-2.0
// How a light's emission varies with direction (UsdLux ShapingAPI), all angles measured from the light's axis:
//   focus   mix(focusTint, 1, |cos|^focus)
//   cone    1 - smoothstep(mix(cutoff, 0, softness), cutoff, angle)
// A profile is a factor of its own, see ies.glsl.

struct Shaping {
    vec3 axis; // the light's local -z, unit
    vec3 x;    // its local x and y across the axis, unit
    vec3 y;
    vec3 focusTint;
    float focus; // 0: none
    bool cone;
    float coneStart; // where the cone begins to fade, radians
    float coneEnd;   // beyond this no light leaves
};

// away: unit, from the light.
PATINA_FN float shapingCosine(Shaping s, vec3 away) {
    return clamp(dot(away, s.axis), -1.0f, 1.0f);
}

PATINA_FN float shapingCone(float angle, float start, float end) {
    if (!(end > start)) return select(1.0f, 0.0f, angle <= end);
    float t = clamp((angle - start) / (end - start), 0.0f, 1.0f);
    return 1.0f - t * t * (3.0f - 2.0f * t);
}

// The factor of cone and focus. cosine: of shapingCosine()
PATINA_FN vec3 shapingBeam(Shaping s, float cosine) {
    vec3 f = vec3(1.0f);
    if (s.cone) {
        float inside = shapingCone(acos(cosine), s.coneStart, s.coneEnd);
        if (inside <= 0.0f) return vec3(0.0f);
        f = vec3(inside);
    }
    if (s.focus > 0.0f) f *= s.focusTint + (vec3(1.0f) - s.focusTint) * pow(abs(cosine), s.focus);
    return f;
}
