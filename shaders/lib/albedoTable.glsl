// Directional albedo of the bare GGX interface, from tables that shaders/bake writes at build time
// with the functions of this dialect. Layout and coordinates stand here once: the look-ups use them
// forwards, the bake program backwards.
//
// Moment table: E[p](mu, alpha) = integral of D G2 / (4 o.z) (1 - o.h)^p over wi, the albedo of a
// lobe whose Fresnel curve is (1 - c)^p.
//   p = 0 is the single scattering albedo of a perfect mirror.
// Dielectric tables (one for eta >= 1, one for eta <= 1): per (mu, alpha, eta) two floats, the
// reflected albedo and what is missing from
//   reflected + transmitted to 1 (light that single scattering loses).

const int MOMENT_COUNT = 12;
const int MOMENT_MU = 32;
const int MOMENT_ALPHA = 32;
const int INTERFACE_MU = 32;
const int INTERFACE_ALPHA = 24;
const int INTERFACE_ETA = 24;

const int MOMENT_SIZE = MOMENT_COUNT * MOMENT_MU * MOMENT_ALPHA;
const int INTERFACE_SIZE = 2 * INTERFACE_MU * INTERFACE_ALPHA * INTERFACE_ETA;
const int INTERFACE_ABOVE = MOMENT_SIZE;
const int INTERFACE_BELOW = MOMENT_SIZE + INTERFACE_SIZE;
const int ALBEDO_TABLE_SIZE = MOMENT_SIZE + 2 * INTERFACE_SIZE;

// Exponents of the moment table. Exponent e lies in cell momentCell(e).
PATINA_FN float momentExponent(int i) {
    float e = float(i);
    e = select(10.0f, e, i == 8);
    e = select(16.0f, e, i == 9);
    e = select(32.0f, e, i == 10);
    return select(100.0f, e, i == 11);
}

PATINA_FN int momentCell(float e) {
    int i = int(min(e, 7.0f));
    i = select(8, i, e >= 10.0f);
    i = select(9, i, e >= 16.0f);
    return select(10, i, e >= 32.0f);
}

// Coordinates in [0, 1].
PATINA_FN float tableAlphaCoord(float alpha) {
    return sqrt(alpha);
}
PATINA_FN float tableAlphaAt(float s) {
    return s * s;
}
PATINA_FN float tableMuCoord(float mu) {
    return sqrt(mu);
}
PATINA_FN float tableMuAt(float t) {
    return t * t;
}

// x = |eta - 1| / (eta + 1); the features at grazing angles move like its root.
PATINA_FN float tableEtaCoord(float eta) {
    return sqrt(abs(eta - 1.0f) / (eta + 1.0f));
}
// Backwards for eta >= 1; the other table has the inverse.
PATINA_FN float tableEtaAt(float s) {
    float x = min(s * s, 0.99f);
    return (1.0f + x) / (1.0f - x);
}

// For eta < 1 the critical angle (mu = muC) always falls on coordinate 1/2, with a root on both
// sides, as the reflectance has.
PATINA_FN float tableMuCritical(float eta) {
    return safeSqrt(1.0f - eta * eta);
}
PATINA_FN float tableMuBelowCoord(float mu, float muC) {
    float inside = safeSqrt((muC - mu) / max(muC, TINY));
    float outside = safeSqrt((mu - muC) / max(1.0f - muC, TINY));
    return 0.5f + 0.5f * select(outside, -inside, mu >= muC);
}
PATINA_FN float tableMuBelowAt(float t, float muC) {
    float d = 2.0f * t - 1.0f;
    return clamp(muC + select(d * d * (1.0f - muC), -d * d * muC, d >= 0.0f), 0.0f, 1.0f);
}

// Cell and fraction of coordinate t on an axis of n nodes.
PATINA_FN int tableCell(float t, int n) {
    return int(clamp(t * float(n - 1), 0.0f, float(n - 2)));
}
PATINA_FN float tableFraction(float t, int n) {
    return clamp(t * float(n - 1) - float(tableCell(t, n)), 0.0f, 1.0f);
}

PATINA_FN float momentBilinear(int base, float fm, float fa) {
    int stepA = MOMENT_COUNT * MOMENT_MU;
    float a = mix(albedoTableFetch(base), albedoTableFetch(base + MOMENT_COUNT), fm);
    float b =
        mix(albedoTableFetch(base + stepA), albedoTableFetch(base + stepA + MOMENT_COUNT), fm);
    return mix(a, b, fa);
}

PATINA_FN int momentBase(float mu, float alpha) {
    int im = tableCell(tableMuCoord(mu), MOMENT_MU);
    int ia = tableCell(tableAlphaCoord(alpha), MOMENT_ALPHA);
    return (ia * MOMENT_MU + im) * MOMENT_COUNT;
}

// E[p] for one of the tabulated exponents, p = momentExponent(i).
PATINA_FN float momentAlbedoAt(float mu, float alpha, int i) {
    float fm = tableFraction(tableMuCoord(mu), MOMENT_MU);
    float fa = tableFraction(tableAlphaCoord(alpha), MOMENT_ALPHA);
    return momentBilinear(momentBase(mu, alpha) + i, fm, fa);
}

// E[p] for any exponent: geometric interpolation between tabulated ones, between which the moments
// fall almost exponentially.
PATINA_FN float momentAlbedo(float mu, float alpha, float exponent) {
    float fm = tableFraction(tableMuCoord(mu), MOMENT_MU);
    float fa = tableFraction(tableAlphaCoord(alpha), MOMENT_ALPHA);
    int i = momentCell(exponent);
    int base = momentBase(mu, alpha) + i;
    float e0 = momentExponent(i);
    float f = (exponent - e0) / (momentExponent(i + 1) - e0);
    float a = max(momentBilinear(base, fm, fa), TINY);
    float b = max(momentBilinear(base + 1, fm, fa), TINY);
    return select(a, a * exp2(f * log2(b / a)), f <= 0.0f);
}

PATINA_FN vec2 interfaceFetch(int index) {
    return vec2(albedoTableFetch(index), albedoTableFetch(index + 1));
}

// x: reflected albedo of the dielectric interface; y: the part that single scattering loses.
// Transmitted is 1 - x - y.
PATINA_FN vec2 interfaceAlbedo(float mu, float alpha, float eta) {
    bool above = eta >= 1.0f;
    float tm =
        select(tableMuCoord(mu), tableMuBelowCoord(mu, tableMuCritical(min(eta, 1.0f))), above);
    float ta = tableAlphaCoord(alpha);
    float te = tableEtaCoord(eta);
    int im = tableCell(tm, INTERFACE_MU);
    int ia = tableCell(ta, INTERFACE_ALPHA);
    int ie = tableCell(te, INTERFACE_ETA);
    float fm = tableFraction(tm, INTERFACE_MU);
    float fa = tableFraction(ta, INTERFACE_ALPHA);
    float fe = tableFraction(te, INTERFACE_ETA);
    int stepA = 2 * INTERFACE_MU;
    int stepE = stepA * INTERFACE_ALPHA;
    int i = select(INTERFACE_ABOVE, INTERFACE_BELOW, above) + ie * stepE + ia * stepA + 2 * im;
    vec2 c00 = interfaceFetch(i) * (1.0f - fm) + interfaceFetch(i + 2) * fm;
    vec2 c10 = interfaceFetch(i + stepA) * (1.0f - fm) + interfaceFetch(i + stepA + 2) * fm;
    i += stepE;
    vec2 c01 = interfaceFetch(i) * (1.0f - fm) + interfaceFetch(i + 2) * fm;
    vec2 c11 = interfaceFetch(i + stepA) * (1.0f - fm) + interfaceFetch(i + stepA + 2) * fm;
    vec2 c0 = c00 * (1.0f - fa) + c10 * fa;
    vec2 c1 = c01 * (1.0f - fa) + c11 * fa;
    return c0 * (1.0f - fe) + c1 * fe;
}
