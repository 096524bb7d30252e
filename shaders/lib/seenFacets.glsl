// SPDX-License-Identifier: Apache-2.0
// A fixed few of the facets that wo sees, to sum over where no table holds the sum: films of many waves, and
// curves that no dielectric has.

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
