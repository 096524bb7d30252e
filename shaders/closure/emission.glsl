// SPDX-License-Identifier: Apache-2.0
// Leaves of emission. A surface emits alike on both sides.

PATINA_FN vec3 emissionScaled(vec3 color, float amount) {
    return emitted(color) * amount;
}
PATINA_FN vec3 emissionTinted(vec3 emission, vec3 tint) {
    return emission * emitted(tint);
}
PATINA_FN vec3 emissionConical(vec3 color, float inner, float outer, vec3 wo, vec3 axis) {
    return emitted(color) * edfConical(inner, outer, abs(dot(wo, axis)));
}
PATINA_FN vec3 emissionSchlick(vec3 emission, vec3 color0, vec3 color90, float exponent, vec3 wo,
                               vec3 normal) {
    return emission * edfSchlick(color0, color90, exponent, dot(wo, normal));
}

// Where d points about an axis, whose azimuth begins at the tangent: cosine and sine times the same
// number.
PATINA_FN vec2 azimuthOf(vec3 d, vec3 axis, vec3 tangent) {
    vec3 x = tangent - axis * dot(tangent, axis);
    float l = length(x);
    x = select(x / l, anyTangent(axis), l > 1e-6f);
    return vec2(dot(d, x), dot(d, cross(axis, x)));
}
