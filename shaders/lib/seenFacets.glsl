// SPDX-License-Identifier: Apache-2.0
// Sums over a fixed few of the facets that wo sees, for what no table holds: curves and films of many
// waves, and facets so narrow along one axis that the tables' ratios of alphas lie too far apart.

PATINA_FN float facetFract(float x) {
    return x - floor(x);
}

// Facet j of `count` that stand for all that wo sees.
PATINA_FN vec3 visibleMicrofacet(vec3 wo, vec2 alpha, int ndf, int j, int count) {
    float n = float(count);
    vec2 u = vec2((float(j) + 0.5f) / n, facetFract((float(j) + 0.5f) * 0.618033989f));
    return microfacetSampleVisible(wo, alpha, u, ndf);
}

// The share of light that a facet m sends where it belongs, over G1: reflected, refracted. c: o.m.
PATINA_FN vec2 facetShares(vec3 o, vec3 m, float c, vec2 alpha, float eta, int ndf) {
    MicrofacetBounce r = microfacetBounce(o, m, c, alpha, eta, true, ndf);
    MicrofacetBounce t = microfacetBounce(o, m, c, alpha, eta, false, ndf);
    return vec2(select(r.ratio, 0.0f, r.valid), select(t.ratio, 0.0f, t.valid));
}

// x: E of a white mirror; y: E of a dielectric's reflection; z: of its refraction. Facets of GGX crowd where
// they lean far, since that tail decides what is lost.
const int FACETS_NARROW = 64;
PATINA_FN_RARE vec3 facetSums(vec3 wo, vec2 alpha, float eta, int ndf) {
    vec3 o = vec3(wo.x, wo.y, min(abs(wo.z), 1.0f));
    bool crowds = ndf == NDF_GGX;
    vec3 sum = vec3(0.0f);
    for (int j = 0; j < FACETS_NARROW; ++j) {
        float v = (float(j) + 0.5f) / float(FACETS_NARROW);
        float turn = facetFract((float(j) + 0.5f) * 0.618033989f);
        vec3 m = microfacetSampleVisible(o, alpha, vec2(turn, select(1.0f - v * v, v, crowds)), ndf);
        float c = clamp(dot(o, m), 0.0f, 1.0f);
        vec2 share = facetShares(o, m, c, alpha, eta, ndf) * select(2.0f * v, 1.0f, crowds);
        float f = fresnelDielectric(c, eta);
        sum += vec3(share.x, share.x * f, share.y * (1.0f - f));
    }
    return sum / float(FACETS_NARROW);
}
