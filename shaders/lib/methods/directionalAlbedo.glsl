// SPDX-License-Identifier: Apache-2.0
// The choice point directionalAlbedo: how the light that a microfacet lobe reflects in total is
// found. All but the tables come down to a few facets, over which the reflectance is averaged.

const int ALBEDO_TABLE = 0;      // albedoTable.glsl and what reads it
const int ALBEDO_FIT = 1;        // albedoFit.glsl: three facets
const int ALBEDO_KARIS = 2;      // methods/albedoKaris.glsl
const int ALBEDO_SAMPLES_16 = 3; // methods/albedoSampled.glsl
const int ALBEDO_QUADRATURE = 4; // the same: truth

const int ALBEDO_STEEP_FACETS = 64; // of metals whose curve no table follows (conductorSteepIor)

// The abilities of a method at an interface; the tables do the rest. eta: as in
// fresnelDielectric, 1 for conductors. The fit knows isotropic GGX from the thinner side, and
// Karis's curve the thinner side.
PATINA_FN int albedoMethod(int asked, vec2 alpha, int ndf, float eta) {
    int method = PATINA_ALBEDO_METHOD(asked);
    bool thinner = eta >= 1.0f;
    bool plain = alpha.x == alpha.y && ndf == NDF_GGX && thinner;
    bool can = (method != ALBEDO_FIT || plain) && (method != ALBEDO_KARIS || thinner);
    return select(method, ALBEDO_TABLE, can);
}

// Whether the method is facets to be summed over, rather than the tables or Karis's curve.
PATINA_FN bool albedoHasMicrofacets(int method) {
    return method != ALBEDO_TABLE && method != ALBEDO_KARIS;
}

// The facets of a method that has them.
struct AlbedoMicrofacets {
    MicrofacetRule rule;
    vec3 wo;
    vec2 alpha;
    int ndf;
    int count;
};

// wo: on either side; alpha: not that of a mirror.
PATINA_FN AlbedoMicrofacets albedoMicrofacets(vec3 wo, vec2 alpha, int ndf, int method) {
    AlbedoMicrofacets a;
    a.wo = vec3(wo.x, wo.y, min(abs(wo.z), 1.0f));
    a.alpha = alpha;
    a.ndf = ndf;
    a.count = select(16, 3, method == ALBEDO_SAMPLES_16);
    a.count = select(ALBEDO_QUADRATURE_NORMALS, a.count, method == ALBEDO_QUADRATURE);
    a.rule.c = vec3(0.0f);
    a.rule.w = vec3(0.0f);
    if (method == ALBEDO_FIT) a.rule = fitRule(a.wo.z, alpha.x);
    return a;
}

// Facet j: (cosine between view and facet, weight).
PATINA_FN vec2 albedoMicrofacet(AlbedoMicrofacets a, int j) {
    if (a.count > 3) return sampledMicrofacet(a.wo, a.alpha, a.ndf, a.count, j);
    float c = select(a.rule.c.x, select(a.rule.c.y, a.rule.c.z, j == 1), j == 0);
    float w = select(a.rule.w.x, select(a.rule.w.y, a.rule.w.z, j == 1), j == 0);
    return vec2(c, w);
}

// The albedo of a white mirror, single scattering, by the same method. A method that knows only Fresnel
// leaves it to the tables.
PATINA_FN float albedoWhite(vec3 wo, vec2 alpha, int ndf, int method) {
    int m = albedoMethod(method, alpha, ndf, 1.0f);
    if (!albedoHasMicrofacets(m)) return microfacetAlbedo0(microfacetPlace(wo, alpha, ndf));
    AlbedoMicrofacets a = albedoMicrofacets(wo, alpha, ndf, m);
    if (m == ALBEDO_FIT) return clamp(a.rule.w.x + a.rule.w.y + a.rule.w.z, ALBEDO_MIN, 1.0f);
    float sum = 0.0f;
    for (int j = 0; j < a.count; ++j)
        sum += albedoMicrofacet(a, j).y;
    return clamp(sum, ALBEDO_MIN, 1.0f);
}
