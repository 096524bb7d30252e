// SPDX-License-Identifier: Apache-2.0
// Rough or smooth interface between two dielectrics: microfacet reflection (R), refraction (T) or
// both (RT) with the exact Fresnel equations. MaterialX dielectric_bsdf, without thin film.
//
// Sides: wo.z >= 0 is outside, wo.z < 0 inside; ior is inside over outside. wi lies on either side.
// Refraction is in flux form: radiance is not scaled by 1 / eta^2, so that R + T of clear glass is
// 1 from both sides (for a closed object the factors cancel anyway). Then f(o, i) n(o)^2 = f(i, o)
// n(i)^2 holds for T, with n(w) the ior on the side of w. R is reciprocal; both only when
// `compensate` is 0 and the lobe shares no interface. ior 1: no interface (nothing reflected, light
// passes straight). ior 0: Fresnel off, as MaterialX says; R and RT reflect all, T passes all.

struct DielectricLobe {
    vec3 tint;
    vec2 alpha; // 0 = mirror
    float ior;
    float invIor;
    float favg;  // hemispherical average from the thinner side
    float retro; // -1 sends reflection back to where it came from, else 1
    int mode;
    int compensate;
    int ndf;      // NDF_GGX, NDF_BECKMANN
    int albedo;   // ALBEDO_*, by dielectricMethods as the next
    int sampling; // SAMPLING_VNDF and others
    bool sharedInterface;
    bool full;    // Fresnel off, reflects everything
    bool matched; // no interface
    bool deltaT;  // refraction too narrow to evaluate
    bool known;   // kr and kt are those of the wo at hand (dielectricAt)
    float kr;     // factors on R and T, see energy.glsl
    float kt;
};

// tint: colour factor on R and T. ior: inside over outside. roughness: GGX alpha along x and y.
// scatterMode: SCATTER_*. sharedInterface: a T lobe that lies under a reflection lobe of the same
// interface. Its own loss to reflection is divided out, because the layer above accounts for it
// (sharedInterfaceScale).
PATINA_FN DielectricLobe dielectricSetup(vec3 tint, float ior, vec2 roughness, bool retroreflective,
                                         int scatterMode, bool sharedInterface, int compensate) {
    DielectricLobe l;
    bool off = !(ior > 0.0f);
    float n = select(1.0f, clamp(ior, 1.0f / IOR_MAX, IOR_MAX), off);
    l.matched = abs(n - 1.0f) < IOR_MATCHED && !(off && scatterMode != SCATTER_T);
    l.full = off && !l.matched;
    l.tint = lobeColor(tint);
    l.alpha = ggxAlpha(roughness);
    l.ior = select(1.0f, n, l.matched);
    l.invIor = 1.0f / l.ior;
    l.favg = select(1.0f, fresnelDielectricAverage(max(l.ior, l.invIor)), l.full);
    l.retro = select(-1.0f, 1.0f, retroreflective);
    l.mode = select(SCATTER_R, scatterMode, l.full);
    l.compensate = compensate;
    l.ndf = NDF_GGX;
    l.albedo = ALBEDO_TABLE;
    l.sampling = SAMPLING_VNDF;
    l.sharedInterface = sharedInterface && scatterMode == SCATTER_T;
    l.deltaT = min(l.alpha.x, l.alpha.y) * abs(l.ior - 1.0f) < REFRACTION_DELTA * max(l.ior, 1.0f);
    l.known = false;
    l.kr = 1.0f;
    l.kt = 1.0f;
    return l;
}

// The lobe with other methods (ALBEDO_*, SAMPLING_VNDF and others).
PATINA_FN DielectricLobe dielectricMethods(DielectricLobe l, int albedo, int sampling) {
    l.albedo = albedo;
    l.sampling = sampling;
    return l;
}

PATINA_FN float dielectricEta(DielectricLobe l, float z) {
    return select(l.ior, l.invIor, z >= 0.0f);
}

PATINA_FN float dielectricFresnel(DielectricLobe l, float c, float eta) {
    return select(1.0f, fresnelDielectric(c, eta), l.full);
}

PATINA_FN bool dielectricAdds(DielectricLobe l, float z) {
    bool thinner = l.full || dielectricEta(l, z) >= 1.0f;
    return energyAdds(l.compensate, l.alpha.x > 0.0f && !l.matched, thinner, l.mode);
}

// (E of a white mirror, E of the reflection), single scattering, by methods other than the tables.
PATINA_FN vec2 dielectricChosen(DielectricLobe l, vec3 wo, float eta, int method) {
    float mu = min(abs(wo.z), 1.0f);
    vec2 e = vec2(0.0f);
    if (albedoHasMicrofacets(method)) {
        AlbedoMicrofacets a = albedoMicrofacets(wo, l.alpha, l.ndf, method);
        for (int j = 0; j < a.count; ++j) {
            vec2 microfacet = albedoMicrofacet(a, j);
            e += vec2(microfacet.y, microfacet.y * dielectricFresnel(l, microfacet.x, eta));
        }
    } else {
        vec2 ab = karisScaleBias(mu, microfacetAlphaSeen(wo, l.alpha));
        e.y = dielectricFresnel(l, 1.0f, eta) * ab.x + ab.y;
    }
    if (method == ALBEDO_KARIS) e.x = microfacetAlbedo0(microfacetPlace(wo, l.alpha, l.ndf));
    e.x = clamp(e.x, ALBEDO_MIN, 1.0f);
    return vec2(e.x, min(e.x, e.y));
}

struct DielectricEnergy {
    float kr; // factor on R
    float kt; // factor on T
    float r;  // albedo of R with its factor, without tint
    float t;
};

PATINA_FN DielectricEnergy dielectricEnergy(DielectricLobe l, vec3 wo) {
    DielectricEnergy e;
    float z = wo.z;
    float mu = abs(z);
    float eta = dielectricEta(l, z);
    float f = dielectricFresnel(l, min(mu, 1.0f), eta);
    e.kr = 1.0f;
    e.kt = sharedInterfaceScale(f, l.sharedInterface);
    e.r = f;
    e.t = (1.0f - f) * e.kt;
    if (l.alpha.x == 0.0f || l.matched) return e;
    int method = albedoMethod(l.albedo, l.alpha, l.ndf, eta);
    // Karis's curve is not exact enough to share light between R and T.
    method = select(ALBEDO_TABLE, method, method == ALBEDO_KARIS && l.mode != SCATTER_R);
    vec2 chosen = vec2(0.0f);
    if (method != ALBEDO_TABLE) chosen = dielectricChosen(l, wo, eta, method);
    float ess = chosen.x;
    float er = chosen.y;
    float et = 0.0f;
    // Transmission is the tables' alone.
    if (method == ALBEDO_TABLE || l.mode != SCATTER_R || eta < 1.0f) {
        MicrofacetPlace p = microfacetPlace(wo, l.alpha, l.ndf);
        vec2 a = microfacetInterface(p, eta);
        float white = microfacetAlbedo0(p);
        et = white * select(0.0f, a.y, l.full);
        ess = select(white, ess, method == ALBEDO_TABLE);
        er = select(white * select(1.0f, a.x, l.full), er, method == ALBEDO_TABLE);
    }
    if (dielectricAdds(l, z)) {
        e.r = er + multiLobe(vec3(l.favg), ess, l.alpha, l.ndf).color.x;
        e.t = 0.0f;
        return e;
    }
    e.kr = energyReflect(ess, l.favg, l.compensate);
    e.kt = 1.0f;
    if (PATINA_COMPENSATE(l.compensate) != COMPENSATE_NONE && !l.full) {
        float both = energyBoth(er, et);
        e.kr = select(e.kr, both, eta >= 1.0f);
        e.kt = select(energyTransmit(er, et, e.kr), both, eta >= 1.0f);
    }
    e.r = er * e.kr;
    e.kt *= sharedInterfaceScale(e.r, l.sharedInterface);
    e.t = et * e.kt;
    return e;
}

// The lobe with its energy factors for one wo. Optional: a caller that evaluates and samples
// several times at the same wo saves the table look-ups.
PATINA_FN DielectricLobe dielectricAt(DielectricLobe l, vec3 wo) {
    l.known = true;
    bool bare = PATINA_COMPENSATE(l.compensate) == COMPENSATE_NONE || l.alpha.x == 0.0f;
    bool plain = bare && !l.sharedInterface;
    if (plain || l.matched || dielectricAdds(l, wo.z)) return l;
    if (l.mode == SCATTER_R && (l.full || dielectricEta(l, wo.z) >= 1.0f)) {
        float ess = albedoWhite(wo, l.alpha, l.ndf, l.albedo);
        l.kr = energyReflect(ess, l.favg, l.compensate);
        return l;
    }
    DielectricEnergy e = dielectricEnergy(l, wo);
    l.kr = e.kr;
    l.kt = e.kt;
    return l;
}

PATINA_FN LobeEval dielectricEval(DielectricLobe l, vec3 wo, vec3 wi) {
    float side = select(1.0f, -1.0f, wo.z >= 0.0f);
    bool reflects = wi.z * side > 0.0f;
    bool there = select(l.mode & SCATTER_R, l.mode & SCATTER_T, reflects) != 0;
    if (!there || l.alpha.x == 0.0f || wi.z == 0.0f || (!reflects && l.deltaT))
        return lobeEvalNone();
    float eta = dielectricEta(l, wo.z);
    float turn = select(l.retro, 1.0f, reflects);
    vec3 o = vec3(wo.x, wo.y, wo.z * side);
    vec3 i = vec3(wi.x * turn, wi.y * turn, wi.z * side);
    MicrofacetPair p = microfacetPair(o, i, l.alpha, select(1.0f, eta, reflects), l.ndf);
    float f = dielectricFresnel(l, p.c, eta);
    float share = select(f, 1.0f - f, reflects);
    if (!PATINA_ENERGY_KNOWN(l.known)) l = dielectricAt(l, wo);
    LobeEval e;
    e.value = l.tint * (p.value * share * select(l.kr, l.kt, reflects));
    int sampling = microfacetSampling(l.sampling, l.ndf, l.mode);
    e.pdf = p.pdf * select(share, 1.0f, l.mode == SCATTER_RT) *
            microfacetDensity(o, l.alpha, l.ndf, sampling);
    if (!dielectricAdds(l, wo.z)) return e;
    float ess = albedoWhite(o, l.alpha, l.ndf, l.albedo);
    MultiLobe second = multiLobe(vec3(l.favg), ess, l.alpha, l.ndf);
    second.color *= l.tint;
    return multiAdd(second, e, i.z, albedoWhite(i, l.alpha, l.ndf, l.albedo));
}

// Draws from both lobes where a second one holds the energy.
PATINA_FN LobeSample dielectricSampleBoth(DielectricLobe l, vec3 wo, vec3 u) {
    float side = select(1.0f, -1.0f, wo.z >= 0.0f);
    vec3 o = vec3(wo.x, wo.y, wo.z * side);
    float ess = albedoWhite(o, l.alpha, l.ndf, l.albedo);
    int sampling = microfacetSampling(l.sampling, l.ndf, l.mode);
    vec3 wi = multiSample(multiLobe(vec3(l.favg), ess, l.alpha, l.ndf), o, l.alpha, u, l.ndf, sampling);
    wi = vec3(wi.x * l.retro, wi.y * l.retro, wi.z * side);
    return multiSampled(wi, dielectricEval(l, wo, wi));
}

PATINA_FN LobeSample dielectricSample(DielectricLobe l, vec3 wo, vec3 u) {
    if (dielectricAdds(l, wo.z)) return dielectricSampleBoth(l, wo, u);
    float side = select(1.0f, -1.0f, wo.z >= 0.0f);
    float eta = dielectricEta(l, wo.z);
    bool mirror = l.alpha.x == 0.0f;
    int sampling = select(SAMPLING_VNDF, microfacetSampling(l.sampling, l.ndf, l.mode), l.matched);
    vec3 o = vec3(wo.x, wo.y, wo.z * side);
    vec3 m = vec3(0.0f, 0.0f, 1.0f);
    if (!mirror) m = microfacetSample(o, l.alpha, vec2(u.x, u.y), l.ndf, sampling);
    float c = clamp(dot(o, m), 0.0f, 1.0f);
    float f = dielectricFresnel(l, c, eta);
    float chance = select(f, select(1.0f, 0.0f, l.mode == SCATTER_R), l.mode == SCATTER_RT);
    bool reflects = u.z < chance;
    MicrofacetBounce b = microfacetBounce(o, m, c, l.alpha, eta, reflects, l.ndf);
    float share = select(f, 1.0f - f, reflects);
    float density = 1.0f;
    if (!mirror) density = microfacetDensity(o, l.alpha, l.ndf, sampling);
    bool both = l.mode == SCATTER_RT;
    bool never = both && share <= 0.0f; // R or T alone is drawn with its whole density, where it is 0 too
    if (!b.valid || never) return lobeSampleNone();
    if (!PATINA_ENERGY_KNOWN(l.known)) l = dielectricAt(l, wo);
    bool isDelta = mirror || (!reflects && l.deltaT);
    float ratio = select(1.0f, b.ratio / density, l.matched);
    float turn = select(l.retro, 1.0f, reflects);
    LobeSample s;
    s.wi = vec3(b.wi.x * turn, b.wi.y * turn, b.wi.z * side);
    s.weight = l.tint * (ratio * select(l.kr, l.kt, reflects) * select(1.0f, share, both));
    s.pdf = select(1.0f, b.pdf * density, isDelta) * select(share, 1.0f, both);
    s.event = select(LOBE_REFLECT, LOBE_TRANSMIT, reflects) + select(LOBE_DELTA, 0, isDelta);
    s.eta = select(1.0f, 1.0f / eta, reflects);
    return s;
}

PATINA_FN vec3 dielectricAlbedo(DielectricLobe l, vec3 wo) {
    DielectricEnergy e = dielectricEnergy(l, wo);
    return l.tint * (select(e.r, 0.0f, (l.mode & SCATTER_R) != 0) +
                     select(e.t, 0.0f, (l.mode & SCATTER_T) != 0));
}

// lobeFix() where the energy of wo is known.
PATINA_FN vec3 dielectricWith(PATINA_INOUT(DielectricLobe) l, DielectricEnergy e, PATINA_OUT(vec3) albedo) {
    l.known = true;
    l.kr = e.kr;
    l.kt = e.kt;
    float coverage = select(e.r, 0.0f, (l.mode & SCATTER_R) != 0) +
                    select(e.t, 0.0f, (l.mode & SCATTER_T) != 0);
    albedo = l.tint * coverage;
    return select(vec3(coverage), vec3(1.0f), l.mode != SCATTER_T);
}

PATINA_FN vec3 lobeFix(PATINA_INOUT(DielectricLobe) l, vec3 wo, PATINA_OUT(vec3) albedo) {
    return dielectricWith(l, dielectricEnergy(l, wo), albedo);
}

PATINA_FN float lobePasses(DielectricLobe l, float z) {
    float c = min(abs(z), 1.0f);
    return 1.0f - dielectricFresnel(l, c, dielectricEta(l, z));
}

PATINA_FN bool lobeIsDelta(DielectricLobe l) {
    return !(l.alpha.x > 0.0f) || (l.mode == SCATTER_T && l.deltaT);
}

PATINA_FN float lobeRoughness(DielectricLobe l) {
    return 0.5f * (l.alpha.x + l.alpha.y);
}
