// SPDX-License-Identifier: Apache-2.0
// Cook and Torrance 1982 ("A Reflectance Model for Computer Graphics"): Beckmann facets, V-cavity
// masking, with the normalisation by 4 that the paper lacks. Reflectance by Schlick's curve from a
// colour, or exact for a complex ior. Reciprocal, one-sided, no multiple scattering.

const int COOK_TORRANCE_EXACT = 0;
const int COOK_TORRANCE_SCHLICK = 1;
const int COOK_TORRANCE_FACETS = 64; // that stand for all, where the reflectance jumps

struct CookTorranceLobe {
    vec3 color; // F0, for Schlick
    vec3 ior;
    vec3 extinction;
    float alpha;
    int fresnel;
};

// color: reflectance at normal incidence, for Schlick. ior, extinction: for the exact equations.
// roughness: root mean square slope of the facets times sqrt(2), in [ALPHA_MIRROR, 1].
PATINA_FN CookTorranceLobe cookTorranceSetup(vec3 color, vec3 ior, vec3 extinction, float roughness,
                                             int fresnel) {
    CookTorranceLobe l;
    l.color = min(lobeColor(color), vec3(1.0f));
    l.ior = min(max(ior, vec3(0.0f)), vec3(METAL_IOR_MAX));
    l.extinction = min(max(extinction, vec3(0.0f)), vec3(METAL_IOR_MAX));
    l.alpha = clamp(roughness, ALPHA_MIRROR, 1.0f);
    l.fresnel = fresnel;
    return l;
}

PATINA_FN vec3 cookTorranceFresnel(CookTorranceLobe l, float c) {
    if (l.fresnel == COOK_TORRANCE_EXACT) return fresnelConductor(c, l.ior, l.extinction);
    return mix(l.color, vec3(1.0f), powSchlick(clamp(1.0f - c, 0.0f, 1.0f), 5.0f));
}

PATINA_FN LobeEval cookTorranceEval(CookTorranceLobe l, vec3 wo, vec3 wi) {
    if (wo.z < 0.0f || wi.z <= 0.0f) return lobeEvalNone();
    vec3 h = wo + wi;
    float h2 = max(dot(h, h), TINY);
    float z2 = max(h.z * h.z, NORMAL_Z_MIN * NORMAL_Z_MIN);
    float d = beckmannD((h.x * h.x + h.y * h.y) / z2, sqr(z2 / h2), sqr(l.alpha));
    d = select(d, 0.0f, d > TINY);
    float c = min(0.5f * sqrt(h2), 1.0f); // o.m
    float mz = min(h.z / sqrt(h2), 1.0f);
    LobeEval e;
    e.pdf = 0.25f * d * vCavityVisible(wo.z, c, mz);
    e.value = cookTorranceFresnel(l, c) * (0.25f * d * vCavityBoth(wo.z, wi.z, c, mz));
    return e;
}

PATINA_FN LobeSample cookTorranceSample(CookTorranceLobe l, vec3 wo, vec3 u) {
    if (wo.z < 0.0f) return lobeSampleNone();
    vec3 m = vCavityChoose(wo, beckmannSample(l.alpha, vec2(u.x, u.y)), u.z);
    float c = dot(wo, m);
    LobeSample s = lobeSampleNone();
    s.wi = m * (2.0f * c) - wo;
    if (c <= 0.0f) return lobeSampleNone();
    LobeEval e = cookTorranceEval(l, wo, s.wi);
    bool found = e.pdf > 0.0f;
    s.weight = e.value / max(e.pdf, TINY);
    s.pdf = e.pdf;
    s.event = select(LOBE_REFLECT, 0, found);
    return s;
}

PATINA_FN bool cookTorranceSteep(CookTorranceLobe l) {
    return l.fresnel == COOK_TORRANCE_EXACT && conductorSteepIor(l.ior, l.extinction);
}

// Mean reflectance over facets drawn as samples are, by the sequence of Roberts 2018 ("The
// Unreasonable Effectiveness of Quasirandom Sequences") in three dimensions.
PATINA_FN_RARE vec3 cookTorranceFacets(CookTorranceLobe l, vec3 wo) {
    vec3 sum = vec3(0.0f);
    float white = 0.0f;
    for (int j = 0; j < COOK_TORRANCE_FACETS; ++j) {
        float t = float(j) + 0.5f;
        vec2 u = vec2(facetFract(t * 0.8191725134f), facetFract(t * 0.6710436067f));
        vec3 m = vCavityChoose(wo, beckmannSample(l.alpha, u), facetFract(t * 0.5497004779f));
        float c = clamp(dot(wo, m), 0.0f, 1.0f);
        float iz = m.z * (2.0f * c) - wo.z;
        float left = vCavityBoth(wo.z, iz, c, m.z) / vCavityVisible(wo.z, c, m.z);
        left = select(left, 0.0f, c > 0.0f && iz > 0.0f);
        sum += cookTorranceFresnel(l, c) * left;
        white += left;
    }
    return sum / max(white, ALBEDO_MIN);
}

PATINA_FN vec3 cookTorranceAlbedo(CookTorranceLobe l, vec3 wo) {
    if (wo.z < 0.0f) return vec3(0.0f);
    MicrofacetPlace p = microfacetPlace(wo, vec2(l.alpha), NDF_GGX);
    p.moment.base += V_CAVITY_TABLE;
    vec3 mean = mix(l.color, vec3(1.0f), microfacetMean(p, 5.0f));
    if (l.fresnel == COOK_TORRANCE_EXACT) mean = conductorMean(p, l.ior, l.extinction);
    if (cookTorranceSteep(l)) mean = cookTorranceFacets(l, wo);
    return mean * microfacetAlbedo0(p);
}

PATINA_FN float lobeRoughness(CookTorranceLobe l) {
    return l.alpha;
}
