// SPDX-License-Identifier: Apache-2.0
// Mean reflectance of a conductor over the facets that wo sees. The exact reflectance, read at six
// cosines, is written as a sum of (1 - c)^p, p = 0, 1.7, 2.5, 5, 10, 20, whose albedos the moment
// table has. The matrix is the inverse of that basis at those cosines, printed by
// shaders/bake/conductorBasis.py. The sum meets the exact curve within 3e-3 for metals (mean 3e-4);
// below ior 1 with little k, and above that of metals, it does not (conductorSteepIor).

const vec3 CONDUCTOR_COS = vec3(0.0894427191f, 0.252982213f, 0.464758002f);
const float CONDUCTOR_COS3 = 0.715541753f;

// f0 to f5: the reflectance at cosine 0, those of CONDUCTOR_COS, and 1; or what is added to one.
PATINA_FN vec3 curveMeanAdded(MicrofacetPlace p, vec3 f0, vec3 f1, vec3 f2, vec3 f3, vec3 f4, vec3 f5) {
    vec3 a1 = f0 * 0.0815740987f - f1 * 0.591924183f + f2 * 3.18853164f - f3 * 11.5559072f +
              f4 * 29.4486774f - f5 * 20.5709518f;
    vec3 a2 = f0 * -0.249220068f + f1 * 1.80723127f - f2 * 9.67758793f + f3 * 33.7002491f -
              f4 * 59.6968442f + f5 * 34.1161717f;
    vec3 a3 = f0 * 0.60982512f - f1 * 4.39676627f + f2 * 22.3056752f - f3 * 48.906629f +
              f4 * 54.7062346f - f5 * 24.3183397f;
    vec3 a4 = f0 * -1.42570575f + f1 * 9.81425453f - f2 * 27.6821868f + f3 * 40.6904254f -
              f4 * 35.1275446f + f5 * 13.7307572f;
    vec3 a5 = f0 * 1.9835266f - f1 * 6.63279535f + f2 * 11.8655679f - f3 * 13.9281384f +
              f4 * 10.6694767f - f5 * 3.95763754f;
    return f5 + a1 * microfacetMean(p, 1.7f) + a2 * microfacetMean(p, 2.5f) + a3 * microfacetMean(p, 5.0f) +
           a4 * microfacetMean(p, 10.0f) + a5 * microfacetMean(p, 20.0f);
}

// A "metal" that refracts: close below a critical angle the reflectance jumps, which no sum of
// smooth curves follows. Where there is hardly an interface, it rises to 1 at the horizon alone, and the
// dip of an index far above that of metals lies beside the horizon too.
const float CONDUCTOR_DIPS = 10.0f;
PATINA_FN bool conductorSteepChannel(float n, float k) {
    bool refracts = n < 1.0f && k < 0.5f && n * n - k * k > -0.1f;
    return refracts || (abs(n - 1.0f) < 0.01f && k < 0.01f) || max(n, k) > CONDUCTOR_DIPS;
}

PATINA_FN bool conductorSteepIor(vec3 n, vec3 k) {
    return conductorSteepChannel(n.x, k.x) || conductorSteepChannel(n.y, k.y) ||
           conductorSteepChannel(n.z, k.z);
}

// Its cosines. Films are evaluated in loops over them: drivers copy the text of a function to wherever it is
// called, and a dozen copies of a film took one two minutes to compile.
PATINA_FN float curveCos(int j) {
    float low = select(select(CONDUCTOR_COS.y, CONDUCTOR_COS.x, j == 2), 0.0f, j >= 1);
    return select(select(select(1.0f, CONDUCTOR_COS3, j == 5), CONDUCTOR_COS.z, j >= 4), low, j >= 3);
}

// Gauss's rule with three points in the squared cosine.
PATINA_FN float gaussCos(int j) {
    return select(select(0.941965145f, 0.707106781f, j == 2), 0.335710687f, j >= 1);
}
PATINA_FN float gaussShare(int j) {
    return select(8.0f / 18.0f, 5.0f / 18.0f, j == 1);
}

PATINA_FN vec3 curveMean(MicrofacetPlace p, vec3 f0, vec3 f1, vec3 f2, vec3 f3, vec3 f4, vec3 f5) {
    return min(max(curveMeanAdded(p, f0, f1, f2, f3, f4, f5), vec3(0.0f)), vec3(1.0f));
}

PATINA_FN vec3 conductorMean(MicrofacetPlace p, vec3 n, vec3 k) {
    return curveMean(p, vec3(1.0f), fresnelConductor(CONDUCTOR_COS.x, n, k),
                     fresnelConductor(CONDUCTOR_COS.y, n, k),
                     fresnelConductor(CONDUCTOR_COS.z, n, k),
                     fresnelConductor(CONDUCTOR_COS3, n, k), fresnelConductor(1.0f, n, k));
}

// Facets that stand for all that wo sees of a film, or of a curve that no table has: within 2e-2.
const int FACETS_SEEN = 24;

// The mean of a film that waves between those six cosines, where their sum is up to 0.1 off.
PATINA_FN_RARE vec3 filmSeenMean(MicrofacetPlace p, Film film, vec3 n, vec3 k) {
    vec3 o = vec3(p.wo.x, p.wo.y, p.mu);
    vec3 sum = vec3(0.0f);
    float white = 0.0f;
    for (int j = 0; j < FACETS_SEEN; ++j) {
        vec3 m = visibleMicrofacet(o, p.axes, p.ndf, j, FACETS_SEEN);
        float c = clamp(dot(o, m), 0.0f, 1.0f);
        float share = facetShares(o, m, c, p.axes, 1.0f, p.ndf).x;
        sum += filmReflectance(film, c, n, k) * share;
        white += share;
    }
    return sum / max(white, ALBEDO_MIN);
}

// The same of a conductor under a film, within 2e-2.
PATINA_FN vec3 filmMean(MicrofacetPlace p, Film film, vec3 n, vec3 k) {
    if (filmWaves(film)) return filmSeenMean(p, film, n, k);
    vec3 f[6];
    for (int j = 1; j < 6; ++j)
        f[j] = filmReflectance(film, curveCos(j), n, k);
    return curveMean(p, vec3(1.0f), f[1], f[2], f[3], f[4], f[5]);
}

PATINA_FN vec3 filmAverage(Film film, vec3 n, vec3 k) {
    vec3 sum = vec3(0.0f);
    for (int j = 0; j < 3; ++j)
        sum += filmReflectance(film, gaussCos(j), n, k) * gaussShare(j);
    return sum;
}

// Hemispherical average of the reflectance: three point Gauss rule in c^2, within 1e-2.
PATINA_FN vec3 conductorAverage(vec3 n, vec3 k) {
    return (fresnelConductor(0.335710687f, n, k) + fresnelConductor(0.941965145f, n, k)) *
               (5.0f / 18.0f) +
           fresnelConductor(0.707106781f, n, k) * (8.0f / 18.0f);
}
