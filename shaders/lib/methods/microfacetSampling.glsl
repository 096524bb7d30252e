// SPDX-License-Identifier: Apache-2.0
// The choice point sampling: which facets are drawn.

const int SAMPLING_VNDF = 0;         // what wo sees (microfacetSampleVisible)
const int SAMPLING_BOUNDED_VNDF = 1; // of those, what can reflect upwards

// Bounded visible normals of GGX (Eto and Tokuyoshi 2023, "Bounded VNDF Sampling for Smith-GGX
// Reflections"): the cap that facets are drawn from ends lower by this factor.
PATINA_FN float microfacetBound(vec3 wo, vec2 alpha) {
    float a2 = sqr(min(alpha.x, alpha.y));
    float s2 = sqr(1.0f + sqrt(wo.x * wo.x + wo.y * wo.y));
    return (1.0f - a2) * s2 / (s2 + a2 * wo.z * wo.z);
}

PATINA_FN vec3 microfacetSampleBounded(vec3 wo, vec2 alpha, vec2 u) {
    vec3 o = normalize(vec3(alpha.x * wo.x, alpha.y * wo.y, wo.z));
    float bound = microfacetBound(wo, alpha) * o.z;
    float z = (1.0f - u.y) * (1.0f + bound) - bound;
    float r = safeSqrt(1.0f - z * z);
    float phi = TWO_PI * u.x;
    vec3 h = vec3(r * cos(phi), r * sin(phi), z) + o;
    return normalize(vec3(alpha.x * h.x, alpha.y * h.y, max(h.z, NORMAL_Z_MIN)));
}

// The abilities of a method: bounds are those of reflection on GGX.
PATINA_FN int microfacetSampling(int sampling, int ndf, int mode) {
    bool can = sampling != SAMPLING_BOUNDED_VNDF || (ndf == NDF_GGX && mode == SCATTER_R);
    return select(sampling, SAMPLING_VNDF, can);
}

// Draws a facet for wo above the surface.
PATINA_FN vec3 microfacetSample(vec3 wo, vec2 alpha, vec2 u, int ndf, int sampling) {
    if (sampling == SAMPLING_BOUNDED_VNDF) return microfacetSampleBounded(wo, alpha, u);
    return microfacetSampleVisible(wo, alpha, u, ndf);
}

// Density over that of the visible normals.
PATINA_FN float microfacetDensity(vec3 wo, vec2 alpha, int ndf, int sampling) {
    if (sampling == SAMPLING_VNDF) return 1.0f;
    float length = microfacetLength(wo, alpha, ndf);
    return (wo.z + length) / max(microfacetBound(wo, alpha) * wo.z + length, TINY);
}
