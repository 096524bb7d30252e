// SPDX-License-Identifier: Apache-2.0
// Directional factors on emission, over the cosine between the direction of emission and the
// normal: MaterialX generalized_schlick_edf and conical_edf.

// Schlick's curve from color0 along the normal to color90 at grazing angles. Unlike a reflectance
// it is not bounded by 1.
PATINA_FN vec3 edfSchlick(vec3 color0, vec3 color90, float exponent, float c) {
    float x = clamp(1.0f - abs(c), 0.0f, 1.0f);
    float rise = powSchlick(x, clamp(exponent, 0.0f, 100.0f));
    return mix(lobeColor(color0), lobeColor(color90), rise);
}

// Full inside the inner cone, none outside the outer one, smooth in the cosine between. Angles are
// those of the whole cones, in degrees; an outer angle below the inner one makes a hard edge.
PATINA_FN float edfConical(float innerAngle, float outerAngle, float c) {
    float inner = clamp(innerAngle, 0.0f, 360.0f);
    float outer = clamp(outerAngle, inner, 360.0f);
    float ci = cos(inner * (PI / 360.0f));
    float co = cos(outer * (PI / 360.0f));
    float t = clamp((c - co) / max(ci - co, TINY), 0.0f, 1.0f);
    return select(t * t * (3.0f - 2.0f * t), select(1.0f, 0.0f, c >= ci), ci - co > 1e-6f);
}
