// SPDX-License-Identifier: Apache-2.0
// Directional albedos of microfacet lobes of any alpha: those of the isotropic lobe that stands in,
// plus what anisotropy changes, from tables over the azimuth and the ratio of both alphas. Same
// quantities as in albedoTable.glsl, stored as differences.
//
// Errors over 12,000 random directions (shaders/tests/testLobeAlbedo.cpp measures some): 2.5e-3 in the
// mean and 2.5e-2 at most for a mirror, 2e-3 and 2.5e-2 for interfaces from outside, 5e-3 and 0.075 from
// inside, where glass gains 0.05 at most. Ward's lobes have tables of the same layout
// (classicAlbedo.glsl): 1e-2.

// The alpha of the isotropic lobe that stands in: what wo sees along its own azimuth, the root mean
// square when it looks straight down.
PATINA_FN float microfacetAlphaSeen(vec3 wo, vec2 alpha) {
    float x = alpha.x * wo.x;
    float y = alpha.y * wo.y;
    return min(sqrt(x * x + y * y + wo.z * wo.z * 0.5f * dot(alpha, alpha)), 1.0f);
}

// Coordinate of the ratio of alphas, smaller over larger, and back.
PATINA_FN float turnedRatioCoord(float ratio) {
    return (1.0f - sqrt(ratio)) / (1.0f - sqrt(1.0f / ALPHA_RATIO_MAX));
}

PATINA_FN float turnedRatioAt(float t) {
    return sqr(mix(1.0f, sqrt(1.0f / ALPHA_RATIO_MAX), t));
}

// Coordinate of the azimuth, and back; c: its cosine from the axis of the larger alpha. What a mirror
// reflects follows the alpha along the azimuth, which falls steeply beside the other axis.
PATINA_FN float turnedAzimuthCoord(float ratio, float c) {
    float least = sqrt(ratio);
    float along = sqrt(sqrt(c * c + ratio * ratio * (1.0f - c * c)));
    return clamp((along - least) / max(1.0f - least, TINY), 0.0f, 1.0f);
}

PATINA_FN float turnedAzimuthAt(float ratio, float t) {
    float along = sqr(mix(sqrt(ratio), 1.0f, t));
    float c2 = (along * along - ratio * ratio) / max(1.0f - ratio * ratio, TINY);
    return sqrt(clamp(c2, 0.0f, 1.0f));
}

// The same from inside. Facets that lean along one axis alone are grooves, and light keeps its part along
// them when it is refracted: where that part exceeds eta, all of it is reflected. The coordinate of that
// azimuth is TURNED_TOTAL. Beyond it the reflectance falls as the root.
PATINA_FN float turnedTotalCos(float mu, float eta) {
    return safeSqrt(1.0f - eta * eta / max(1.0f - mu * mu, TINY));
}

PATINA_FN float turnedBelowCoord(float mu, float eta, float c) {
    float total = turnedTotalCos(mu, eta);
    float beyond = sqrt(max(c - total, 0.0f) / max(1.0f - total, TINY));
    float within = TURNED_TOTAL * (1.0f - sqrt(max(1.0f - c / max(total, TINY), 0.0f)));
    return select(min(within, TURNED_TOTAL), mix(TURNED_TOTAL, 1.0f, min(beyond, 1.0f)), c < total);
}

// The share of the azimuths beyond it, at a coordinate: the cosine itself where no part exceeds eta.
PATINA_FN float turnedBeyond(float t) {
    return sqr(max(t - TURNED_TOTAL, 0.0f) / (1.0f - TURNED_TOTAL));
}

PATINA_FN float turnedBelowAt(float mu, float eta, float t) {
    float total = turnedTotalCos(mu, eta);
    float within = 1.0f - sqr(1.0f - t / TURNED_TOTAL);
    return select(total * within, mix(total, 1.0f, turnedBeyond(t)), t < TURNED_TOTAL);
}

// alpha along an azimuth; c: its cosine from the axis of the larger alpha.
PATINA_FN float turnedAlpha(float larger, float ratio, float c) {
    return max(larger * sqrt(c * c + ratio * ratio * (1.0f - c * c)), ALPHA_MIRROR);
}

// Where (wo, alpha) lies in the tables of a distribution.
struct MicrofacetPlace {
    MomentPlace moment;
    float mu;
    float alpha; // microfacetAlphaSeen
    int ndf;
    bool turned;  // anisotropic
    float larger; // what follows is for anisotropic lobes: larger alpha, smaller over larger
    float ratio;
    float c; // cosine of the azimuth from the axis of the larger alpha
    vec3 wo;
    vec2 axes; // both alphas
    int turnedBase;
    vec4 turnedAt; // fractions of mu, azimuth, ratio, alpha
};

PATINA_FN int turnedRow(int a, int r, int c, int m) {
    return ((a * TURNED_RATIO + r) * TURNED_AZIMUTH + c) * TURNED_MU + m;
}

PATINA_FN_RARE MicrofacetPlace turnedPlace(MicrofacetPlace p, vec3 wo, vec2 alpha) {
    p.larger = max(alpha.x, alpha.y);
    p.ratio = min(alpha.x, alpha.y) / p.larger;
    float across = sqrt(wo.x * wo.x + wo.y * wo.y);
    float along = abs(select(wo.x, wo.y, alpha.x >= alpha.y));
    p.c = min(along / max(across, TINY), 1.0f);
    float tm = tableMuCoord(p.mu, turnedAlpha(p.larger, p.ratio, p.c));
    float tr = turnedRatioCoord(p.ratio);
    float ta = tableAlphaCoord(p.larger);
    float tc = turnedAzimuthCoord(p.ratio, p.c);
    p.turnedBase = turnedRow(tableCell(ta, TURNED_ALPHA), tableCell(tr, TURNED_RATIO),
                             tableCell(tc, TURNED_AZIMUTH), tableCell(tm, TURNED_MU));
    p.turnedAt = vec4(tableFraction(tm, TURNED_MU), tableFraction(tc, TURNED_AZIMUTH),
                      tableFraction(tr, TURNED_RATIO), tableFraction(ta, TURNED_ALPHA));
    return p;
}

PATINA_FN MicrofacetPlace microfacetPlace(vec3 wo, vec2 alpha, int ndf) {
    MicrofacetPlace p;
    p.mu = min(abs(wo.z), 1.0f);
    p.alpha = microfacetAlphaSeen(wo, alpha);
    p.ndf = ndf;
    p.turned = alpha.x != alpha.y;
    p.moment = momentPlace(p.mu, p.alpha, ndf * MICROFACET_SIZE);
    p.larger = p.alpha;
    p.ratio = 1.0f;
    p.c = 1.0f;
    p.wo = wo;
    p.axes = alpha;
    p.turnedBase = 0;
    p.turnedAt = vec4(0.0f);
    if (p.turned) p = turnedPlace(p, wo, alpha);
    return p;
}

// Corner k of a cell with four axes: the row it is in, and its weight.
PATINA_FN int turnedCorner(int k) {
    return turnedRow((k >> 3) & 1, (k >> 2) & 1, (k >> 1) & 1, k & 1);
}

PATINA_FN float turnedWeight(int k, vec4 f) {
    return select(f.x, 1.0f - f.x, (k & 1) != 0) * select(f.y, 1.0f - f.y, (k & 2) != 0) *
           select(f.z, 1.0f - f.z, (k & 4) != 0) * select(f.w, 1.0f - f.w, (k & 8) != 0);
}

// The addition of anisotropy to entry i of the moments.
PATINA_FN_RARE float turnedEntry(MicrofacetPlace p, int i) {
    float e = 0.0f;
    int table = p.ndf * MICROFACET_SIZE + TURNED_MOMENT + i;
    for (int k = 0; k < 16; ++k) {
        int row = p.turnedBase + turnedCorner(k);
        e += turnedWeight(k, p.turnedAt) * albedoTableFetch(table + row * MOMENT_COUNT);
    }
    return e;
}

PATINA_FN float microfacetEntry(MicrofacetPlace p, int i) {
    float e = momentEntry(p.moment, i);
    if (p.turned) e += turnedEntry(p, i);
    return e;
}

// E[0]: the albedo of a perfect mirror, single scattering.
PATINA_FN float microfacetAlbedo0(MicrofacetPlace p) {
    return clamp(microfacetEntry(p, 0), ALBEDO_MIN, 1.0f);
}

// E[p] / E[0]: the mean of (1 - c)^exponent over the facets seen.
PATINA_FN float microfacetMean(MicrofacetPlace p, float exponent) {
    int i = momentCell(exponent);
    float e0 = momentExponent(i);
    float f = clamp((exponent - e0) / (momentExponent(i + 1) - e0), 0.0f, 1.0f);
    float d = mix(microfacetEntry(p, i), microfacetEntry(p, i + 1), f);
    return powSchlick(clamp(1.0f - p.mu + d, 0.0f, 1.0f), exponent);
}

// The addition of anisotropy to the two floats of the interface.
PATINA_FN_RARE vec2 turnedInterface(MicrofacetPlace p, float eta) {
    vec2 e = vec2(0.0f);
    bool above = eta >= 1.0f;
    float muC = tableMuCritical(min(eta, 1.0f));
    float tc = select(turnedAzimuthCoord(p.ratio, p.c), turnedBelowCoord(p.mu, eta, p.c), above);
    float width = turnedAlpha(p.larger, p.ratio, select(p.c, turnedBeyond(tc), above));
    float tm = select(tableMuCoord(p.mu, width), tableMuBelowCoord(p.mu, muC, width), above);
    float tr = turnedRatioCoord(p.ratio);
    float ta = tableAlphaCoord(p.larger);
    float te = tableEtaCoord(eta);
    int base = turnedRow(tableCell(ta, TURNED_ETA_ALPHA), tableCell(tr, TURNED_RATIO),
                         tableCell(tc, TURNED_AZIMUTH), tableCell(tm, TURNED_MU));
    vec4 at = vec4(tableFraction(tm, TURNED_MU), tableFraction(tc, TURNED_AZIMUTH),
                   tableFraction(tr, TURNED_RATIO), tableFraction(ta, TURNED_ETA_ALPHA));
    // Below the first node, from inside, the critical angle runs to the horizon: nothing is between these nodes.
    float fe = select(1.0f, tableFraction(te, TURNED_ETA), !above && tableCell(te, TURNED_ETA) == 0);
    int stepE = 2 * turnedRow(TURNED_ETA_ALPHA, 0, 0, 0);
    int table = p.ndf * MICROFACET_SIZE + select(TURNED_ABOVE, TURNED_BELOW, above) +
                tableCell(te, TURNED_ETA) * stepE;
    for (int k = 0; k < 16; ++k) {
        int i = table + 2 * (base + turnedCorner(k));
        float w = turnedWeight(k, at);
        e += interfaceFetch(i) * (w * (1.0f - fe)) + interfaceFetch(i + stepE) * (w * fe);
    }
    return e;
}

// x: E_R / E[0], the mean reflectance over the facets seen; y: E_T / E[0]. Both not negative.
PATINA_FN vec2 microfacetInterface(MicrofacetPlace p, float eta) {
    vec2 e = interfaceEntry(p.mu, p.alpha, eta, p.ndf);
    if (p.turned) e += turnedInterface(p, eta);
    float r = clamp(e.x + interfaceGuess(p.mu, p.alpha, eta), 0.0f, 1.0f);
    return vec2(r, max(1.0f - r - e.y, 0.0f));
}
