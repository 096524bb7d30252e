// SPDX-License-Identifier: Apache-2.0
// Microfacet interface with a generalized Schlick reflectance: MaterialX generalized_schlick_bsdf.
// Its curve and its set-up are in schlickInterface.glsl; here are its energy, and how it scatters.

#include "shaders/lib/schlickInterface.glsl"

struct SchlickEnergy {
    vec3 kr; // factor on R
    vec3 kt; // factor on T
    vec3 r;  // albedo of R with its factor
    vec3 t;
};

PATINA_FN vec3 schlickSharedInterfaceScale(vec3 r, bool sharedInterface) {
    return vec3(sharedInterfaceScale(r.x, sharedInterface),
                sharedInterfaceScale(r.y, sharedInterface),
                sharedInterfaceScale(r.z, sharedInterface));
}

// Reflectance at normal incidence.
PATINA_FN vec3 schlickNormal(SchlickLobe l) {
    if (PATINA_FILM(l.exact) || filmIsThere(l.film)) return schlickOutside(l, 1.0f);
    return l.fresnel.f0;
}

// The share that a film adds to Schlick's curve, or the reflectance of a dielectric under one.
PATINA_FN vec3 schlickSmoothPart(SchlickLobe l, float c, float eta) {
    if (PATINA_FILM(l.exact)) return schlickReflectance(l, c, eta);
    return filmReflectance(l.film, c, l.filmBase, vec3(0.0f)) - schlickBare(l.filmBase, c);
}

// Mean reflectance over the facets seen, from the tables; of Schlick's curve, from outside. The
// curve has moments of its own, however steep it is; what a film adds is smooth.
PATINA_FN vec3 schlickTabled(SchlickLobe l, MicrofacetPlace p, float eta) {
    vec3 mean = vec3(0.0f);
    if (!PATINA_FILM(l.exact)) mean = schlickMean(p, l.fresnel);
    if (PATINA_FILM(l.exact) || filmIsThere(l.film)) {
        vec3 f[6];
        for (int j = 0; j < 6; ++j)
            f[j] = schlickSmoothPart(l, curveCos(j), select(l.ior, eta, j == 5));
        mean += curveMeanAdded(p, f[0], f[1], f[2], f[3], f[4], f[5]);
    }
    return min(max(mean, vec3(0.0f)), vec3(1.0f));
}

// A curve whose transmission is no dielectric's.
PATINA_FN bool schlickOdd(SchlickLobe l) {
    SchlickFresnel s = l.fresnel;
    float dip = s.dip.x + s.dip.y + s.dip.z;
    return !PATINA_FILM(l.exact) && (dip > 0.0f || lobeMean(s.f90) < 1.0f || s.exponent != 5.0f);
}

const int ALBEDO_SEEN = 16;

// The transmission of such a curve over that of a dielectric of its ior, over all facets seen: T
// also meets those that R sends below the horizon, so that R's mean says little of it. 1 where these few facets all
// reflect, as in dielectricPasses.
PATINA_FN_RARE vec3 schlickTransmittanceRatio(SchlickLobe l, vec3 wo, float eta) {
    vec3 o = vec3(wo.x, wo.y, min(abs(wo.z), 1.0f));
    vec3 curve = vec3(0.0f);
    float bare = 0.0f;
    for (int j = 0; j < ALBEDO_SEEN; ++j) {
        float c = dot(o, visibleMicrofacet(o, l.alpha, l.ndf, j, ALBEDO_SEEN));
        curve += vec3(1.0f) - schlickReflectance(l, clamp(c, 0.0f, 1.0f), eta);
        bare += 1.0f - fresnelDielectric(clamp(c, 0.0f, 1.0f), eta);
    }
    bool passes = bare > ALBEDO_MIN * float(ALBEDO_SEEN);
    return select(curve / max(bare, ALBEDO_MIN), vec3(1.0f), passes);
}

// The same from the denser side, where a dielectric of that ior lets `transmittance` through: the
// reflectance rises to 1 as that dielectric's does.
PATINA_FN vec3 schlickTabledDense(SchlickLobe l, vec3 wo, float eta, float transmittance) {
    if (schlickOdd(l))
        return vec3(1.0f) - min(schlickTransmittanceRatio(l, wo, eta) * transmittance, vec3(1.0f));
    float f0 = sqr((l.ior - 1.0f) / (l.ior + 1.0f));
    return mix(vec3(1.0f), schlickNormal(l), clamp(transmittance / (1.0f - f0), 0.0f, 1.0f));
}

// Whether the tables hold neither its mean nor its transmission: a film that waves between the cosines of
// curveMeanAdded; what is added to a curve that the film lifts or lowers beyond [0, 1]; any film from the denser
// side, where its reflectance does not rise as a bare dielectric's does; and the transmission of what is no
// dielectric and has so high an ior that little of the dielectric's is left to compare with.
const float SCHLICK_BLACK = 0.02f;
const float SCHLICK_DENSE = 3.0f;
PATINA_FN bool schlickUntabled(SchlickLobe l, bool thinner) {
    bool odd = schlickOdd(l);
    vec3 f0 = l.fresnel.f0;
    bool curve = !PATINA_FILM(l.exact);
    bool black = curve && min(f0.x, min(f0.y, f0.z)) < SCHLICK_BLACK;
    bool dense = curve && l.mode != SCATTER_R && l.ior > SCHLICK_DENSE;
    bool film = filmIsThere(l.film) && (!thinner || black || dense || filmWaves(l.film));
    return film || (odd && (dense || filmIsThere(l.film)));
}

// Its mean reflectance over the facets seen, and what it transmits; single scattering. The sums are those of a few
// facets, which a dielectric of the same ior has too: the tables know how much of it all of them send back or on.
struct SchlickSeen {
    vec3 mean;
    vec3 t;
};
PATINA_FN_RARE SchlickSeen schlickSeen(SchlickLobe l, vec3 wo, float eta, float whole) {
    vec3 o = vec3(wo.x, wo.y, min(abs(wo.z), 1.0f));
    vec3 r = vec3(0.0f);
    vec3 t = vec3(0.0f);
    float white = 0.0f;
    float bare = 0.0f;
    for (int j = 0; j < FACETS_SEEN; ++j) {
        vec3 m = visibleMicrofacet(o, l.alpha, l.ndf, j, FACETS_SEEN);
        float c = clamp(dot(o, m), 0.0f, 1.0f);
        vec2 share = facetShares(o, m, c, l.alpha, eta, l.ndf);
        vec3 f = schlickReflectance(l, c, eta);
        float f0 = fresnelDielectric(c, eta);
        r += f * share.x;
        t += (vec3(1.0f) - f) * share.y;
        white += share.x;
        bare += f0 * share.x + (1.0f - f0) * share.y;
    }
    SchlickSeen s;
    s.mean = r / max(white, ALBEDO_MIN);
    s.t = t * (whole / max(bare, ALBEDO_MIN));
    return s;
}

PATINA_FN bool schlickAdds(SchlickLobe l, float z) {
    return energyAdds(l.compensate, l.alpha.x > 0.0f, schlickEta(l, z) >= 1.0f, l.mode);
}

// E of the reflection and, last, E of a white mirror, single scattering, by methods other than the
// tables.
PATINA_FN vec4 schlickChosen(SchlickLobe l, vec3 wo, float eta, int method) {
    float mu = min(abs(wo.z), 1.0f);
    vec3 er = vec3(0.0f);
    float ess = 0.0f;
    if (albedoHasMicrofacets(method)) {
        AlbedoMicrofacets a = albedoMicrofacets(wo, l.alpha, l.ndf, method);
        for (int j = 0; j < a.count; ++j) {
            vec2 microfacet = albedoMicrofacet(a, j);
            er += schlickReflectance(l, microfacet.x, eta) * microfacet.y;
            ess += microfacet.y;
        }
    } else {
        vec2 ab = karisScaleBias(mu, microfacetAlphaSeen(wo, l.alpha));
        er = schlickNormal(l) * ab.x + l.fresnel.f90 * ab.y;
    }
    if (method == ALBEDO_KARIS) ess = microfacetAlbedo0(microfacetPlace(wo, l.alpha, l.ndf));
    ess = clamp(ess, ALBEDO_MIN, 1.0f);
    er = min(er, vec3(ess));
    return vec4(er.x, er.y, er.z, ess);
}

// How T's albedo follows from the dielectric tables: the kernel of T is that of the dielectric with
// the same ior, and its mean reflectance is taken as that of R where the curve is much like it.
PATINA_FN SchlickEnergy schlickEnergy(SchlickLobe l, vec3 wo) {
    SchlickEnergy e;
    float z = wo.z;
    float mu = abs(z);
    float eta = schlickEta(l, z);
    e.kr = vec3(1.0f);
    e.r = schlickReflectance(l, mu, eta);
    e.kt = schlickSharedInterfaceScale(e.r, l.sharedInterface);
    e.t = (vec3(1.0f) - e.r) * e.kt;
    if (l.alpha.x == 0.0f) return e;
    bool thinner = eta >= 1.0f;
    bool reflectsOnly = l.mode == SCATTER_R && thinner;
    int method = albedoMethod(l.albedo, l.alpha, l.ndf, eta);
    bool untabled = schlickUntabled(l, thinner);
    // Karis's curve is not exact enough to share light between R and T.
    method = select(ALBEDO_TABLE, method, method == ALBEDO_KARIS && !reflectsOnly);
    bool tabled = method == ALBEDO_TABLE;
    vec4 chosen = vec4(0.0f, 0.0f, 0.0f, 1.0f);
    if (!tabled) chosen = schlickChosen(l, wo, eta, method);
    float ess = chosen.w;
    float white = ess;
    vec3 mean = vec3(chosen.x, chosen.y, chosen.z) / ess;
    vec2 a = vec2(0.0f, 1.0f);
    SchlickSeen seen;
    seen.mean = mean;
    seen.t = vec3(0.0f);
    if (tabled || !reflectsOnly) {
        MicrofacetPlace p = microfacetPlace(wo, l.alpha, l.ndf);
        white = microfacetAlbedo0(p);
        ess = select(white, ess, tabled);
        if (!reflectsOnly) a = microfacetInterface(p, eta);
        if (untabled)
            seen = schlickSeen(l, wo, eta, white * (a.x + a.y));
        else if (tabled && thinner)
            seen.mean = schlickTabled(l, p, eta);
        else if (tabled)
            seen.mean = schlickTabledDense(l, wo, eta, 1.0f - a.x);
        mean = select(mean, seen.mean, !tabled);
    }
    if (schlickAdds(l, z)) {
        e.r = mean * ess + multiLobe(l.favg, ess, l.alpha, l.ndf).color;
        return e;
    }
    bool compensates = PATINA_COMPENSATE(l.compensate) != COMPENSATE_NONE;
    vec3 gain = select(l.favg, vec3(0.0f), compensates);
    e.kr = vec3(1.0f) + gain * ((1.0f - ess) / max(ess, ALBEDO_MIN));
    e.r = mean * e.kr * ess;
    if (reflectsOnly) return e;
    vec3 er = mean * ess;
    vec3 et = (vec3(1.0f) - mean) * min(white * a.y / max(1.0f - a.x, ALBEDO_MIN), 1.0f);
    if (untabled)
        et = min(seen.t, vec3(1.0f));
    else if (schlickOdd(l))
        et = min(schlickTransmittanceRatio(l, wo, eta) * (white * a.y), vec3(1.0f));
    et = min(et, max(vec3(1.0f) - er, vec3(0.0f)));
    if (compensates) {
        vec3 both = vec3(1.0f) / max(er + et, vec3(ALBEDO_MIN));
        vec3 rest = max(vec3(1.0f) - er * e.kr, vec3(0.0f)) / max(et, vec3(ALBEDO_MIN));
        e.kr = select(e.kr, both, thinner);
        e.kt = select(rest, both, thinner);
    } else
        e.kt = vec3(1.0f);
    e.r = er * e.kr;
    e.kt *= schlickSharedInterfaceScale(e.r, l.sharedInterface);
    e.t = et * e.kt;
    return e;
}

// The lobe with its energy factors for one wo, as dielectricAt.
PATINA_FN SchlickLobe schlickAt(SchlickLobe l, vec3 wo) {
    l.known = true;
    bool bare = PATINA_COMPENSATE(l.compensate) == COMPENSATE_NONE || l.alpha.x == 0.0f;
    bool plain = bare && !l.sharedInterface;
    if (plain || schlickAdds(l, wo.z)) return l;
    SchlickEnergy e = schlickEnergy(l, wo);
    l.kr = e.kr;
    l.kt = e.kt;
    return l;
}

// Chance of choosing R at a facet, in RT. A steep curve may be so near 0 that no float divides by it.
PATINA_FN float schlickChance(SchlickLobe l, vec3 f) {
    float mean = lobeMean(f);
    mean = select(mean, 0.0f, mean > TINY);
    return select(mean, select(1.0f, 0.0f, l.mode == SCATTER_R), l.mode == SCATTER_RT);
}

PATINA_FN LobeEval schlickEval(SchlickLobe l, vec3 wo, vec3 wi) {
    float side = select(1.0f, -1.0f, wo.z >= 0.0f);
    bool reflects = wi.z * side > 0.0f;
    bool there = select(l.mode & SCATTER_R, l.mode & SCATTER_T, reflects) != 0;
    if (!there || l.alpha.x == 0.0f || wi.z == 0.0f || (!reflects && l.deltaT))
        return lobeEvalNone();
    float eta = schlickEta(l, wo.z);
    float turn = select(l.retro, 1.0f, reflects);
    vec3 o = vec3(wo.x, wo.y, wo.z * side);
    vec3 i = vec3(wi.x * turn, wi.y * turn, wi.z * side);
    MicrofacetPair p = microfacetPair(o, i, l.alpha, select(1.0f, eta, reflects), l.ndf);
    vec3 f = schlickReflectance(l, p.c, eta);
    float chance = schlickChance(l, f);
    if (!PATINA_ENERGY_KNOWN(l.known)) l = schlickAt(l, wo);
    LobeEval e;
    e.value = l.tint * select(f * l.kr, (vec3(1.0f) - f) * l.kt, reflects) * p.value;
    int sampling = microfacetSampling(l.sampling, l.ndf, l.mode);
    e.pdf = p.pdf * select(chance, 1.0f - chance, reflects) *
            microfacetDensity(o, l.alpha, l.ndf, sampling);
    if (!schlickAdds(l, wo.z)) return e;
    float ess = albedoWhite(o, l.alpha, l.ndf, l.albedo);
    MultiLobe second = multiLobe(l.favg, ess, l.alpha, l.ndf);
    second.color *= l.tint;
    return multiAdd(second, e, i.z, albedoWhite(i, l.alpha, l.ndf, l.albedo));
}

// Draws from both lobes where a second one holds the energy.
PATINA_FN LobeSample schlickSampleBoth(SchlickLobe l, vec3 wo, vec3 u) {
    float side = select(1.0f, -1.0f, wo.z >= 0.0f);
    vec3 o = vec3(wo.x, wo.y, wo.z * side);
    float ess = albedoWhite(o, l.alpha, l.ndf, l.albedo);
    int sampling = microfacetSampling(l.sampling, l.ndf, l.mode);
    vec3 wi = multiSample(multiLobe(l.favg, ess, l.alpha, l.ndf), o, l.alpha, u, l.ndf, sampling);
    wi = vec3(wi.x * l.retro, wi.y * l.retro, wi.z * side);
    return multiSampled(wi, schlickEval(l, wo, wi));
}

PATINA_FN LobeSample schlickSample(SchlickLobe l, vec3 wo, vec3 u) {
    if (schlickAdds(l, wo.z)) return schlickSampleBoth(l, wo, u);
    float side = select(1.0f, -1.0f, wo.z >= 0.0f);
    float eta = schlickEta(l, wo.z);
    bool mirror = l.alpha.x == 0.0f;
    int sampling = microfacetSampling(l.sampling, l.ndf, l.mode);
    vec3 o = vec3(wo.x, wo.y, wo.z * side);
    vec3 m = vec3(0.0f, 0.0f, 1.0f);
    if (!mirror) m = microfacetSample(o, l.alpha, vec2(u.x, u.y), l.ndf, sampling);
    float c = clamp(dot(o, m), 0.0f, 1.0f);
    vec3 f = schlickReflectance(l, c, eta);
    float chance = schlickChance(l, f);
    bool reflects = u.z < chance;
    MicrofacetBounce b = microfacetBounce(o, m, c, l.alpha, eta, reflects, l.ndf);
    float p = select(chance, 1.0f - chance, reflects);
    if (!b.valid || p <= 0.0f) return lobeSampleNone();
    float density = 1.0f;
    if (!mirror) density = microfacetDensity(o, l.alpha, l.ndf, sampling);
    if (!PATINA_ENERGY_KNOWN(l.known)) l = schlickAt(l, wo);
    bool isDelta = mirror || (!reflects && l.deltaT);
    float turn = select(l.retro, 1.0f, reflects);
    LobeSample s;
    s.wi = vec3(b.wi.x * turn, b.wi.y * turn, b.wi.z * side);
    s.weight =
        l.tint * select(f * l.kr, (vec3(1.0f) - f) * l.kt, reflects) * (b.ratio / (p * density));
    s.pdf = select(1.0f, b.pdf * density, isDelta) * p;
    s.event = select(LOBE_REFLECT, LOBE_TRANSMIT, reflects) + select(LOBE_DELTA, 0, isDelta);
    s.eta = select(1.0f, 1.0f / eta, reflects);
    return s;
}

PATINA_FN vec3 schlickAlbedo(SchlickLobe l, vec3 wo) {
    SchlickEnergy e = schlickEnergy(l, wo);
    return l.tint * (select(e.r, vec3(0.0f), (l.mode & SCATTER_R) != 0) +
                     select(e.t, vec3(0.0f), (l.mode & SCATTER_T) != 0));
}

// lobeFix() where the energy of wo is known.
PATINA_FN vec3 schlickWith(PATINA_INOUT(SchlickLobe) l, SchlickEnergy e, PATINA_OUT(vec3) albedo) {
    l.known = true;
    l.kr = e.kr;
    l.kt = e.kt;
    vec3 coverage = select(e.r, vec3(0.0f), (l.mode & SCATTER_R) != 0) +
                    select(e.t, vec3(0.0f), (l.mode & SCATTER_T) != 0);
    albedo = l.tint * coverage;
    return select(coverage, vec3(1.0f), l.mode != SCATTER_T);
}

PATINA_FN vec3 lobeFix(PATINA_INOUT(SchlickLobe) l, vec3 wo, PATINA_OUT(vec3) albedo) {
    return schlickWith(l, schlickEnergy(l, wo), albedo);
}

PATINA_FN float lobePasses(SchlickLobe l, float z) {
    float c = min(abs(z), 1.0f);
    return 1.0f - lobeMean(schlickReflectance(l, c, schlickEta(l, z)));
}

PATINA_FN bool lobeIsDelta(SchlickLobe l) {
    return !(l.alpha.x > 0.0f) || (l.mode == SCATTER_T && l.deltaT);
}

PATINA_FN float lobeRoughness(SchlickLobe l) {
    return 0.5f * (l.alpha.x + l.alpha.y);
}
