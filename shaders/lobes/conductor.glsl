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
    int facets; // FACETS_*, FACETS_GGX unless the caller sets another
    bool known; // k is that of the wo at hand (conductorAt)
    vec3 k;     // factor for multiple scattering
};

// ior, extinction: complex ior per channel, relative to the medium outside; not negative.
// roughness: GGX alpha along x and y.
PATINA_FN ConductorLobe conductorSetup(vec3 ior, vec3 extinction, vec2 roughness,
                                       bool retroreflective, int compensate) {
    ConductorLobe l;
    l.ior = min(max(ior, vec3(0.0f)), vec3(IOR_MAX));
    l.extinction = min(max(extinction, vec3(0.0f)), vec3(IOR_MAX));
    l.favg = conductorAverage(l.ior, l.extinction);
    l.alpha = ggxAlpha(roughness);
    l.film = makeFilm(0.0f, 1.0f);
    l.retro = select(-1.0f, 1.0f, retroreflective);
    l.compensate = compensate;
    l.facets = FACETS_GGX;
    l.known = false;
    l.k = vec3(1.0f);
    return l;
}

// The lobe under a film (makeFilm).
PATINA_FN ConductorLobe conductorFilm(ConductorLobe l, float thickness, float ior) {
    l.film = makeFilm(thickness, ior);
    if (l.film.thickness > 0.0f) l.favg = filmAverage(l.film, l.ior, l.extinction);
    return l;
}

PATINA_FN vec3 conductorReflectance(ConductorLobe l, float c) {
    if (l.film.thickness > 0.0f) return filmReflectance(l.film, c, l.ior, l.extinction);
    return fresnelConductor(c, l.ior, l.extinction);
}

// The lobe with its energy factor for one wo. Optional: a caller that evaluates and samples several
// times at the same wo saves the table look-up.
PATINA_FN ConductorLobe conductorAt(ConductorLobe l, vec3 wo) {
    l.known = true;
    if (l.compensate == 0 || l.alpha.x == 0.0f) return l;
    float ess = facetAlbedo0(facetPlace(wo, l.alpha, l.facets));
    l.k = vec3(1.0f) + l.favg * ((1.0f - ess) / max(ess, ALBEDO_MIN));
    return l;
}

PATINA_FN LobeEval conductorEval(ConductorLobe l, vec3 wo, vec3 wi) {
    if (l.alpha.x == 0.0f || wo.z < 0.0f || wi.z <= 0.0f) return lobeEvalNone();
    FacetPair p = facetPair(wo, vec3(wi.x * l.retro, wi.y * l.retro, wi.z), l.alpha, 1.0f, l.facets);
    if (!l.known) l = conductorAt(l, wo);
    LobeEval e;
    e.value = conductorReflectance(l, p.c) * l.k * p.value;
    e.pdf = p.pdf;
    return e;
}

PATINA_FN LobeSample conductorSample(ConductorLobe l, vec3 wo, vec3 u) {
    if (wo.z < 0.0f) return lobeSampleNone();
    bool mirror = l.alpha.x == 0.0f;
    vec3 m = vec3(0.0f, 0.0f, 1.0f);
    if (!mirror) m = facetSampleVisible(wo, l.alpha, vec2(u.x, u.y), l.facets);
    float c = clamp(dot(wo, m), 0.0f, 1.0f);
    FacetBounce b = facetBounce(wo, m, c, l.alpha, 1.0f, true, l.facets);
    if (!b.valid) return lobeSampleNone();
    if (!l.known) l = conductorAt(l, wo);
    LobeSample s;
    s.wi = vec3(b.wi.x * l.retro, b.wi.y * l.retro, b.wi.z);
    s.weight = conductorReflectance(l, c) * l.k * b.ratio;
    s.pdf = b.pdf;
    s.event = select(LOBE_REFLECT + LOBE_DELTA, LOBE_REFLECT, mirror);
    s.eta = 1.0f;
    return s;
}

PATINA_FN vec3 conductorAlbedo(ConductorLobe l, vec3 wo) {
    if (wo.z < 0.0f) return vec3(0.0f);
    if (l.alpha.x == 0.0f) return conductorReflectance(l, min(wo.z, 1.0f));
    FacetPlace p = facetPlace(wo, l.alpha, l.facets);
    vec3 mean = conductorMean(p, l.ior, l.extinction);
    if (l.film.thickness > 0.0f) mean = filmMean(p, l.film, l.ior, l.extinction);
    return mean * conductorAt(l, wo).k * facetAlbedo0(p);
}
