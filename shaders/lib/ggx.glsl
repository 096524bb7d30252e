// SPDX-License-Identifier: Apache-2.0
// The GGX microfacet distribution (Walter et al. 2007), anisotropic, with height-correlated Smith
// masking-shadowing (Heitz 2014, "Understanding the Masking-Shadowing Function", eq. 86 and 99) and
// visible normal sampling by spherical caps (Dupuy and Benyoub 2023). alpha: roughness along x and
// y, in [ALPHA_MIRROR, 1]. Directions are above the surface.
//
// With l(w) = sqrt(ax^2 x^2 + ay^2 y^2 + z^2), Lambda = (l / z - 1) / 2. Everything below is
// written in l, where the cosines cancel and grazing angles stay finite:
//   G1(o) / o.z          = 2 / (o.z + l(o))
//   G2(o, i) / (o.z i.z) = 2 / (l(o) i.z + l(i) o.z)
// Reflection and refraction use the same G2.

// Clamps MaterialX roughness inputs to usable alphas; x and y are left below ALPHA_MIRROR only when
// both are (a mirror). Facets that are more than ALPHA_RATIO_MAX times as rough along one axis as along
// the other would gain light, because the tables do not tell them apart.
PATINA_FN vec2 ggxAlpha(vec2 roughness) {
    vec2 a = min(max(roughness, vec2(0.0f)), vec2(1.0f));
    bool mirror = max(a.x, a.y) < ALPHA_MIRROR;
    return select(vec2(0.0f), max(a, vec2(max(ALPHA_MIRROR, max(a.x, a.y) / ALPHA_RATIO_MAX))), mirror);
}

PATINA_FN float ggxLength(vec3 w, vec2 alpha) {
    float x = alpha.x * w.x;
    float y = alpha.y * w.y;
    return sqrt(x * x + y * y + w.z * w.z);
}

// Density of facet normals m (unit) per solid angle and projected area.
PATINA_FN float ggxD(vec3 m, vec2 alpha) {
    float a = alpha.x * alpha.y;
    float x = m.x * alpha.y;
    float y = m.y * alpha.x;
    float z = m.z * a;
    float t = a / (x * x + y * y + z * z);
    return INV_PI * a * t * t;
}

// Draws a facet normal with density G1(o) max(0, o.m) D(m) / o.z.
PATINA_FN vec3 ggxSampleVisible(vec3 wo, vec2 alpha, vec2 u) {
    vec3 o = normalize(vec3(alpha.x * wo.x, alpha.y * wo.y, wo.z));
    float phi = TWO_PI * u.x;
    float z = (1.0f - u.y) * (1.0f + o.z) - o.z;
    float r = safeSqrt(1.0f - z * z);
    vec3 h = vec3(r * cos(phi), r * sin(phi), z) + o;
    // h.z = (1 - u.y)(1 + o.z) is above 0 for u.y < 1; the bound only guards rounding.
    return normalize(vec3(alpha.x * h.x, alpha.y * h.y, max(h.z, NORMAL_Z_MIN)));
}
