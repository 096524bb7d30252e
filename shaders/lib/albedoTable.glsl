// SPDX-License-Identifier: Apache-2.0
// Directional albedo of the bare interface, isotropic, from tables that shaders/bake writes at build
// time with the functions of this dialect, one set per distribution of facets. Layout and
// coordinates stand here once: the look-ups use them forwards, the bake program backwards.
// alpha >= ALPHA_MIRROR throughout; a mirror needs no table. Anisotropic lobes read these tables at
// one alpha and add what anisotropicAlbedo.glsl holds.
//
// Moments: E[p](mu, alpha) = integral of D G2 / (4 o.z) (1 - o.h)^p over wi, the albedo of a lobe
//   whose Fresnel curve is (1 - c)^p. E[0] is stored as it is, the others as the small d in
//   E[p] = E[0] (1 - mu + d)^p, which vanishes with alpha.
// Interface (one table for eta >= 1, one for eta <= 1): two floats per (mu, alpha, eta), the mean
//   reflectance E_R / E[0] less interfaceGuess, and
//   1 - (E_R + E_T) / E[0].

const int MOMENT_COUNT = 11;
const int MOMENT_MU = 48;
const int MOMENT_ALPHA = 32;
const int INTERFACE_MU = 48;
const int INTERFACE_ALPHA = 32;
const int INTERFACE_ETA = 32;

const int MOMENT_SIZE = MOMENT_COUNT * MOMENT_MU * MOMENT_ALPHA;
const int INTERFACE_SIZE = 2 * INTERFACE_MU * INTERFACE_ALPHA * INTERFACE_ETA;
const int INTERFACE_ABOVE = MOMENT_SIZE;
const int INTERFACE_BELOW = MOMENT_SIZE + INTERFACE_SIZE;

// The share that anisotropy adds (anisotropicAlbedo.glsl).
const int TURNED_MU = 16;
const int TURNED_AZIMUTH = 9;
const float TURNED_TOTAL = 3.0f / 8.0f; // an azimuth's coordinate, of a node (turnedBelowCoord)
const int TURNED_RATIO = 5;
const int TURNED_ALPHA = 9;
const int TURNED_ETA_ALPHA = 8;
const int TURNED_ETA = 10;
const int TURNED_MOMENT_SIZE =
    MOMENT_COUNT * TURNED_MU * TURNED_AZIMUTH * TURNED_RATIO * TURNED_ALPHA;
const int TURNED_INTERFACE_SIZE =
    2 * TURNED_MU * TURNED_AZIMUTH * TURNED_RATIO * TURNED_ETA_ALPHA * TURNED_ETA;
const int TURNED_MOMENT = INTERFACE_BELOW + INTERFACE_SIZE;
const int TURNED_ABOVE = TURNED_MOMENT + TURNED_MOMENT_SIZE;
const int TURNED_BELOW = TURNED_ABOVE + TURNED_INTERFACE_SIZE;

// The tables of one distribution, then what is not of microfacets.
const int MICROFACET_SIZE = TURNED_BELOW + TURNED_INTERFACE_SIZE;
const int SHEEN_SIZE = 32 * 32; // sheenAlbedo.glsl
const int CLASSIC_MU = 32;      // classicAlbedo.glsl
const int CLASSIC_ALPHA = 32;
const int CLASSIC_TABLE = 2 * MICROFACET_SIZE + SHEEN_SIZE;
const int V_CAVITY_TABLE = CLASSIC_TABLE + 4 * CLASSIC_MU * CLASSIC_ALPHA;
const int FILM_TABLE = V_CAVITY_TABLE + MOMENT_SIZE;
const int FILM_PATHS = 1024; // methods/filmSpectrum.glsl
const int WARD_TABLE = FILM_TABLE + 6 * FILM_PATHS; // what anisotropy adds, one per form
const int WARD_SIZE = TURNED_MU * TURNED_AZIMUTH * TURNED_RATIO * TURNED_ALPHA;
const int ALBEDO_TABLE_SIZE = WARD_TABLE + 2 * WARD_SIZE;

// Exponents of the moment table; 5, 6 and 7 (Schlick and its dip) are entries.
PATINA_FN float momentExponent(int i) {
    float e = select(0.0f, 1.0f, i == 0);
    e = select(1.7f, e, i == 2);
    e = select(2.5f, e, i == 3);
    e = select(3.5f, e, i == 4);
    e = select(float(i), e, i >= 5);
    e = select(10.0f, e, i == 8);
    e = select(20.0f, e, i == 9);
    return select(50.0f, e, i == 10);
}

// The entry at or below exponent e, at least 1.
PATINA_FN int momentCell(float e) {
    int i = select(2, 1, e >= 1.7f);
    i = select(3, i, e >= 2.5f);
    i = select(4, i, e >= 3.5f);
    i = select(5, i, e >= 5.0f);
    i = select(6, i, e >= 6.0f);
    i = select(7, i, e >= 7.0f);
    i = select(8, i, e >= 10.0f);
    return select(9, i, e >= 20.0f);
}

// Coordinates in [0, 1] and back.
PATINA_FN float tableAlphaCoord(float alpha) {
    float a0 = sqrt(ALPHA_MIRROR);
    return (sqrt(alpha) - a0) / (1.0f - a0);
}

PATINA_FN float tableAlphaAt(float t) {
    float a0 = sqrt(ALPHA_MIRROR);
    return sqr(a0 + t * (1.0f - a0));
}

const float MU_WIDTH = 0.3f;
const float BLUR_WIDTH = 0.5f;

// Grazing features are as wide as alpha, so mu is spaced logarithmically above that width.
PATINA_FN float tableMuCoord(float mu, float alpha) {
    float w = MU_WIDTH * alpha;
    return log2(1.0f + mu / w) / log2(1.0f + 1.0f / w);
}

PATINA_FN float tableMuAt(float t, float alpha) {
    float w = MU_WIDTH * alpha;
    return min((exp2(t * log2(1.0f + 1.0f / w)) - 1.0f) * w, 1.0f);
}

// x = |eta - 1| / (eta + 1); the features at grazing angles move like its root.
PATINA_FN float tableEtaCoord(float eta) {
    return sqrt(abs(eta - 1.0f) / (eta + 1.0f));
}

// Backwards for eta >= 1; the other table has the inverse.
PATINA_FN float tableEtaAt(float t) {
    float x = min(t * t, 0.99f);
    return (1.0f + x) / (1.0f - x);
}

// For eta < 1 the features lie around the critical angle (mu = muC) and are again as wide as alpha:
// coordinate 1/2, logarithmic on both sides.
PATINA_FN float tableMuCritical(float eta) {
    return safeSqrt(1.0f - eta * eta);
}

PATINA_FN float tableMuBelowCoord(float mu, float muC, float alpha) {
    bool right = mu >= muC;
    float range = max(select(1.0f - muC, muC, right), TINY);
    float t = tableMuCoord(min(abs(mu - muC) / range, 1.0f), alpha / range);
    return 0.5f + 0.5f * select(t, -t, right);
}

PATINA_FN float tableMuBelowAt(float t, float muC, float alpha) {
    bool right = t >= 0.5f;
    float range = max(select(1.0f - muC, muC, right), TINY);
    float d = range * tableMuAt(abs(2.0f * t - 1.0f), alpha / range);
    return clamp(muC + select(d, -d, right), 0.0f, 1.0f);
}

// Cell and fraction of coordinate t on an axis of n nodes.
PATINA_FN int tableCell(float t, int n) {
    return int(clamp(t * float(n - 1), 0.0f, float(n - 2)));
}

PATINA_FN float tableFraction(float t, int n) {
    return clamp(t * float(n - 1) - float(tableCell(t, n)), 0.0f, 1.0f);
}

// Where (mu, alpha) lies in the moment table that begins at `table`.
struct MomentPlace {
    int base;
    float fm;
    float fa;
};

PATINA_FN MomentPlace momentPlace(float mu, float alpha, int table) {
    float tm = tableMuCoord(mu, alpha);
    float ta = tableAlphaCoord(alpha);
    int row = tableCell(ta, MOMENT_ALPHA) * MOMENT_MU + tableCell(tm, MOMENT_MU);
    MomentPlace p;
    p.base = table + row * MOMENT_COUNT;
    p.fm = tableFraction(tm, MOMENT_MU);
    p.fa = tableFraction(ta, MOMENT_ALPHA);
    return p;
}

PATINA_FN float momentEntry(MomentPlace p, int i) {
    int k = p.base + i;
    int stepA = MOMENT_COUNT * MOMENT_MU;
    float a = mix(albedoTableFetch(k), albedoTableFetch(k + MOMENT_COUNT), p.fm);
    float b = mix(albedoTableFetch(k + stepA), albedoTableFetch(k + stepA + MOMENT_COUNT), p.fm);
    return mix(a, b, p.fa);
}

// A first guess of the mean reflectance: for eta >= 1 the reflectance at mu. For eta < 1 the same with
// the kink at the critical angle rounded over the width of the lobe, since a kink that moves with
// mu cannot be interpolated.
PATINA_FN float interfaceGuess(float mu, float alpha, float eta) {
    float n = min(eta, 1.0f);
    float muC2 = (1.0f - n) * (1.0f + n);
    float x = mu * mu - muC2;
    float w = BLUR_WIDTH * alpha * sqrt(muC2) * n;
    float root = sqrt(x * x + w * w);
    float ramp = 0.5f * select(x + root, w * w / max(root - x, TINY), x >= 0.0f);
    float rounded = fresnelFromCosines(sqrt(muC2 + ramp), sqrt(ramp), n);
    return select(fresnelDielectric(mu, eta), rounded, eta >= 1.0f);
}

PATINA_FN vec2 interfaceFetch(int index) {
    return vec2(albedoTableFetch(index), albedoTableFetch(index + 1));
}

PATINA_FN vec2 interfaceBilinear(int i, float fm, float fa) {
    int stepA = 2 * INTERFACE_MU;
    vec2 a = interfaceFetch(i) * (1.0f - fm) + interfaceFetch(i + 2) * fm;
    vec2 b = interfaceFetch(i + stepA) * (1.0f - fm) + interfaceFetch(i + stepA + 2) * fm;
    return a * (1.0f - fa) + b * fa;
}

// The two floats of the interface table.
PATINA_FN vec2 interfaceEntry(float mu, float alpha, float eta, int ndf) {
    bool above = eta >= 1.0f;
    float muC = tableMuCritical(min(eta, 1.0f));
    float tm = select(tableMuCoord(mu, alpha), tableMuBelowCoord(mu, muC, alpha), above);
    float ta = tableAlphaCoord(alpha);
    float te = tableEtaCoord(eta);
    int cell = tableCell(te, INTERFACE_ETA) * INTERFACE_ALPHA + tableCell(ta, INTERFACE_ALPHA);
    int i = ndf * MICROFACET_SIZE + select(INTERFACE_ABOVE, INTERFACE_BELOW, above) +
            2 * (cell * INTERFACE_MU + tableCell(tm, INTERFACE_MU));
    float fm = tableFraction(tm, INTERFACE_MU);
    float fa = tableFraction(ta, INTERFACE_ALPHA);
    float fe = tableFraction(te, INTERFACE_ETA);
    vec2 a = interfaceBilinear(i, fm, fa);
    vec2 b = interfaceBilinear(i + 2 * INTERFACE_MU * INTERFACE_ALPHA, fm, fa);
    return a * (1.0f - fe) + b * fe;
}
