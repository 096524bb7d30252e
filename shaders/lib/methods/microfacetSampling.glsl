// SPDX-License-Identifier: Apache-2.0
// The choice point sampling: which facets are drawn.

const int SAMPLING_VNDF = 0;         // what wo sees (microfacetSampleVisible)
const int SAMPLING_BOUNDED_VNDF = 1; // of those, what can reflect upwards
const int SAMPLING_FULL_NDF = 2;     // all, by their density

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

PATINA_FN vec3 microfacetSampleAll(vec2 alpha, vec2 u, int ndf) {
    float left = max(1.0f - u.y, TINY);
    float ggx = sqrt(u.y / left);
    float beckmann = sqrt(-log2(left) * 0.693147181f);
    float r = select(beckmann, ggx, ndf == NDF_BECKMANN);
    float phi = TWO_PI * u.x;
    return normalize(vec3(alpha.x * r * cos(phi), alpha.y * r * sin(phi), 1.0f));
}

// The abilities of a method: bounds are those of reflection on GGX.
PATINA_FN int microfacetSampling(int sampling, int ndf, int mode) {
    bool can = sampling != SAMPLING_BOUNDED_VNDF || (ndf == NDF_GGX && mode == SCATTER_R);
    return select(sampling, SAMPLING_VNDF, can);
}

// Draws a facet for wo above the surface. Facets that wo cannot see come out too, of
// SAMPLING_FULL_NDF.
PATINA_FN vec3 microfacetSample(vec3 wo, vec2 alpha, vec2 u, int ndf, int sampling) {
    if (sampling == SAMPLING_BOUNDED_VNDF) return microfacetSampleBounded(wo, alpha, u);
    if (sampling == SAMPLING_FULL_NDF) return microfacetSampleAll(alpha, u, ndf);
    return microfacetSampleVisible(wo, alpha, u, ndf);
}

// Density over that of the visible normals. mz: z of the facet, c: wo.m.
PATINA_FN float microfacetDensity(vec3 wo, vec2 alpha, float mz, float c, int ndf, int sampling) {
    if (sampling == SAMPLING_VNDF) return 1.0f;
    float length = microfacetLength(wo, alpha, ndf);
    float visible = wo.z + length;
    if (sampling == SAMPLING_FULL_NDF) return 0.5f * mz * visible / max(c, TINY);
    return visible / max(microfacetBound(wo, alpha) * wo.z + length, TINY);
}
