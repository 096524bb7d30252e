// SPDX-License-Identifier: Apache-2.0
// Rough or smooth metal: microfacet reflection with the exact Fresnel equations of a complex ior.
// MaterialX conductor_bsdf. One-sided: no light for wo or wi at or below the
// horizon. Reciprocal when `compensate` is 0.

struct ConductorLobe {
    vec3 ior;
    vec3 extinction;
    vec3 favg;
    vec2 alpha; // 0 = mirror
    Film film;
    float retro; // -1 sends the lobe back to where it came from, else 1
    int compensate;
    int ndf;      // NDF_GGX, NDF_BECKMANN
    int albedo;   // ALBEDO_*, by conductorMethods as the next
    int sampling; // SAMPLING_VNDF and others
    bool known; // k is that of the wo at hand (conductorAt)
    vec3 k;     // factor for multiple scattering
};

// ior, extinction: complex ior per channel, relative to the medium outside; not negative.
// roughness: GGX alpha along x and y.
PATINA_FN ConductorLobe conductorSetup(vec3 ior, vec3 extinction, vec2 roughness,
                                       bool retroreflective, int compensate) {
    ConductorLobe l;
    l.ior = min(max(ior, vec3(0.0f)), vec3(METAL_IOR_MAX));
    l.extinction = min(max(extinction, vec3(0.0f)), vec3(METAL_IOR_MAX));
    l.favg = conductorAverage(l.ior, l.extinction);
    l.alpha = ggxAlpha(roughness);
    l.film = makeFilm(0.0f, 1.0f);
    l.retro = select(-1.0f, 1.0f, retroreflective);
    l.compensate = compensate;
    l.ndf = NDF_GGX;
    l.albedo = ALBEDO_TABLE;
    l.sampling = SAMPLING_VNDF;
    l.known = false;
    l.k = vec3(1.0f);
    return l;
}

// The lobe with other methods (ALBEDO_*, SAMPLING_VNDF and others, FILM_*), after its film.
PATINA_FN ConductorLobe conductorMethods(ConductorLobe l, int albedo, int sampling, int film) {
    l.albedo = albedo;
    l.sampling = sampling;
    l.film.method = film;
    return l;
}

// The lobe under a film (makeFilm).
PATINA_FN ConductorLobe conductorFilm(ConductorLobe l, float thickness, float ior) {
    l.film = makeFilm(thickness, ior);
    if (filmIsThere(l.film)) l.favg = filmAverage(l.film, l.ior, l.extinction);
    return l;
}

PATINA_FN vec3 conductorReflectance(ConductorLobe l, float c) {
    if (filmIsThere(l.film)) return filmReflectance(l.film, c, l.ior, l.extinction);
    return fresnelConductor(c, l.ior, l.extinction);
}

PATINA_FN bool conductorAdds(ConductorLobe l) {
    return energyAdds(l.compensate, l.alpha.x > 0.0f, true, SCATTER_R);
}

// The lobe with its energy factor for one wo. Optional: a caller that evaluates and samples several
// times at the same wo saves the table look-up.
PATINA_FN ConductorLobe conductorAt(ConductorLobe l, vec3 wo) {
    l.known = true;
    if (PATINA_COMPENSATE(l.compensate) == COMPENSATE_NONE || l.alpha.x == 0.0f || conductorAdds(l))
        return l;
    float ess = albedoWhite(wo, l.alpha, l.ndf, l.albedo);
    l.k = vec3(1.0f) + l.favg * ((1.0f - ess) / max(ess, ALBEDO_MIN));
    return l;
}

PATINA_FN LobeEval conductorEval(ConductorLobe l, vec3 wo, vec3 wi) {
    if (l.alpha.x == 0.0f || wo.z < 0.0f || wi.z <= 0.0f) return lobeEvalNone();
    vec3 i = vec3(wi.x * l.retro, wi.y * l.retro, wi.z);
    MicrofacetPair p = microfacetPair(wo, i, l.alpha, 1.0f, l.ndf);
    if (!PATINA_ENERGY_KNOWN(l.known)) l = conductorAt(l, wo);
    LobeEval e;
    e.value = conductorReflectance(l, p.c) * l.k * p.value;
    int sampling = microfacetSampling(l.sampling, l.ndf, SCATTER_R);
    e.pdf = p.pdf * microfacetDensity(wo, l.alpha, l.ndf, sampling);
    if (!conductorAdds(l)) return e;
    float ess = albedoWhite(wo, l.alpha, l.ndf, l.albedo);
    return multiAdd(multiLobe(l.favg, ess, l.alpha, l.ndf), e, i.z,
                    albedoWhite(i, l.alpha, l.ndf, l.albedo));
}

// Draws from both lobes where a second one holds the energy.
PATINA_FN LobeSample conductorSampleBoth(ConductorLobe l, vec3 wo, vec3 u) {
    float ess = albedoWhite(wo, l.alpha, l.ndf, l.albedo);
    int sampling = microfacetSampling(l.sampling, l.ndf, SCATTER_R);
    vec3 wi = multiSample(multiLobe(l.favg, ess, l.alpha, l.ndf), wo, l.alpha, u, l.ndf, sampling);
    wi = vec3(wi.x * l.retro, wi.y * l.retro, wi.z);
    return multiSampled(wi, conductorEval(l, wo, wi));
}

PATINA_FN LobeSample conductorSample(ConductorLobe l, vec3 wo, vec3 u) {
    if (wo.z < 0.0f) return lobeSampleNone();
    if (conductorAdds(l)) return conductorSampleBoth(l, wo, u);
    bool mirror = l.alpha.x == 0.0f;
    int sampling = microfacetSampling(l.sampling, l.ndf, SCATTER_R);
    vec3 m = vec3(0.0f, 0.0f, 1.0f);
    if (!mirror) m = microfacetSample(wo, l.alpha, vec2(u.x, u.y), l.ndf, sampling);
    float c = clamp(dot(wo, m), 0.0f, 1.0f);
    MicrofacetBounce b = microfacetBounce(wo, m, c, l.alpha, 1.0f, true, l.ndf);
    if (!b.valid) return lobeSampleNone();
    if (!PATINA_ENERGY_KNOWN(l.known)) l = conductorAt(l, wo);
    LobeSample s;
    s.wi = vec3(b.wi.x * l.retro, b.wi.y * l.retro, b.wi.z);
    float density = 1.0f;
    if (!mirror) density = microfacetDensity(wo, l.alpha, l.ndf, sampling);
    s.weight = conductorReflectance(l, c) * l.k * (b.ratio / density);
    s.pdf = b.pdf * density;
    s.event = select(LOBE_REFLECT + LOBE_DELTA, LOBE_REFLECT, mirror);
    s.eta = 1.0f;
    return s;
}

PATINA_FN vec3 conductorAlbedo(ConductorLobe l, vec3 wo) {
    if (wo.z < 0.0f) return vec3(0.0f);
    if (l.alpha.x == 0.0f) return conductorReflectance(l, min(wo.z, 1.0f));
    int method = albedoMethod(l.albedo, l.alpha, l.ndf, 1.0f);
    float ess = albedoWhite(wo, l.alpha, l.ndf, l.albedo);
    vec3 k = conductorAt(l, wo).k;
    vec3 extra = vec3(0.0f);
    if (conductorAdds(l)) extra = multiLobe(l.favg, ess, l.alpha, l.ndf).color;
    if (method == ALBEDO_KARIS) {
        vec2 ab = karisScaleBias(min(wo.z, 1.0f), microfacetAlphaSeen(wo, l.alpha));
        vec3 er = conductorReflectance(l, 1.0f) * ab.x + vec3(ab.y);
        return min(er, vec3(ess)) * k + extra;
    }
    bool steep = method == ALBEDO_TABLE && conductorSteepIor(l.ior, l.extinction);
    if (albedoHasMicrofacets(method) || steep) {
        AlbedoMicrofacets a = albedoMicrofacets(wo, l.alpha, l.ndf, method);
        if (steep) a.count = ALBEDO_STEEP_FACETS;
        vec3 er = vec3(0.0f);
        float white = 0.0f;
        for (int j = 0; j < a.count; ++j) {
            vec2 microfacet = albedoMicrofacet(a, j);
            er += conductorReflectance(l, microfacet.x) * microfacet.y;
            white += microfacet.y;
        }
        return er * (k * select(ess / max(white, ALBEDO_MIN), 1.0f, steep)) + extra;
    }
    MicrofacetPlace p = microfacetPlace(wo, l.alpha, l.ndf);
    vec3 mean = conductorMean(p, l.ior, l.extinction);
    if (filmIsThere(l.film)) mean = filmMean(p, l.film, l.ior, l.extinction);
    return mean * ess * k + extra;
}

PATINA_FN vec3 lobeFix(PATINA_INOUT(ConductorLobe) l, vec3 wo, PATINA_OUT(vec3) albedo) {
    l = conductorAt(l, wo);
    albedo = conductorReflectance(l, clamp(wo.z, 0.0f, 1.0f));
    return vec3(1.0f);
}

PATINA_FN bool lobeIsDelta(ConductorLobe l) {
    return !(l.alpha.x > 0.0f);
}

PATINA_FN float lobeRoughness(ConductorLobe l) {
    return 0.5f * (l.alpha.x + l.alpha.y);
}
