// SPDX-License-Identifier: Apache-2.0
// Functions shared by the lobes on microfacets, for both distributions of facet normals. With the length
// l(w) of either, Smith's masking is the same:
//   G1(o) / o.z          = 2 / (o.z + l(o))
//   G2(o, i) / (o.z i.z) = 2 / (l(o) i.z + l(i) o.z)
// Reflection and refraction use the same G2.

const int NDF_GGX = 0;
const int NDF_BECKMANN = 1;

PATINA_FN float microfacetLength(vec3 w, vec2 alpha, int ndf) {
    if (ndf == NDF_BECKMANN) return beckmannLength(w, alpha);
    return ggxLength(w, alpha);
}

// Density of facet normals m (unit) per solid angle and projected area.
PATINA_FN float microfacetD(vec3 m, vec2 alpha, int ndf) {
    if (ndf == NDF_BECKMANN) return beckmannDensity(m, alpha);
    return ggxD(m, alpha);
}

// Draws a facet normal with density G1(o) max(0, o.m) D(m) / o.z.
PATINA_FN vec3 microfacetSampleVisible(vec3 wo, vec2 alpha, vec2 u, int ndf) {
    if (ndf == NDF_BECKMANN) return beckmannSampleVisible(wo, alpha, u);
    return ggxSampleVisible(wo, alpha, u);
}

// G2 / (o.z i.z); lo and li are microfacetLength of both directions.
PATINA_FN float microfacetG2Ratio(float oz, float lo, float iz, float li) {
    return 2.0f / max(lo * iz + li * oz, TINY);
}

// G2 / G1(o): what is left of the weight after visible normal sampling. In [0, 1].
PATINA_FN float microfacetG2OverG1(float oz, float lo, float iz, float li) {
    return iz * (oz + lo) / max(lo * iz + li * oz, TINY);
}

// Both directions at a facet: light that meets facet h on its way from o (above the
// surface) to i, which lies above the surface when it reflects and below when it refracts. All
// without Fresnel. value: D G2 |o.h| / o.z dh/di, which is BSDF times |cos i|; pdf: density of i
// after visible normal sampling; c: o.h in [0, 1].
struct MicrofacetPair {
    float value;
    float pdf;
    float c;
};

// eta: ior of i's side over that of o's for refraction, 1 for reflection. The Jacobian eta^2 |i.h|
// / |o + eta i|^2 (Walter et al. 2007, eq. 17) serves both, since for reflection |o + i| = 2 o.h.
// It counts radiance without the factor 1 / eta^2 (flux form).
//
// The half vector is never normalised for D: with H = o + eta i the lengths cancel in D dh/di
// |o.h|, which saves a root and stays in range for short H. t is bounded for H = 0, where o.H = 0
// too.
PATINA_FN MicrofacetPair microfacetPair(vec3 o, vec3 i, vec2 alpha, float eta, int ndf) {
    vec3 h = o + i * eta;
    h = select(h, -h, h.z >= 0.0f);
    float oh = dot(o, h);
    float ih = dot(i, h);
    vec3 shapes;
    if (ndf == NDF_BECKMANN) {
        shapes = beckmannPair(o, i, h, alpha);
    } else {
        float a = alpha.x * alpha.y;
        float x = h.x * alpha.y;
        float y = h.y * alpha.x;
        float z = h.z * a;
        float t = a / max(x * x + y * y + z * z, TINY * TINY);
        shapes.x = INV_PI * a * (t * oh) * (t * abs(ih));
        shapes.y = ggxLength(o, alpha);
        shapes.z = ggxLength(i, alpha);
    }
    bool valid = oh > 0.0f && ih * i.z > 0.0f;
    float shape = select(shapes.x * eta * eta, 0.0f, valid);
    float oz = max(o.z, 0.0f);
    float iz = abs(i.z);
    float lo = shapes.y;
    float li = shapes.z;
    MicrofacetPair p;
    p.value = shape * iz * microfacetG2Ratio(oz, lo, iz, li);
    p.pdf = shape * 2.0f / max(oz + lo, TINY);
    float len = sqrt(max(dot(h, h), TINY));
    p.c = clamp(oh / len, 0.0f, 1.0f);
    return p;
}

// c - eta ct without cancellation for eta near 1, with ct the cosine of the refracted direction:
// that is along m microfacetShift - o.
PATINA_FN float microfacetShift(float c, float ct, float eta) {
    return (1.0f - eta) * (1.0f + eta) / max(c + eta * ct, TINY);
}

// Where light from o goes at facet m; c, eta and reflects as in microfacetBounce.
PATINA_FN vec3 microfacetDirection(vec3 o, vec3 m, float c, float eta, bool reflects) {
    float len = microfacetShift(c, cosRefracted(c, eta), eta);
    return select(m * (2.0f * c) - o, normalize(m * len - o), reflects);
}

// The same from the sampling side: o meets a facet m that was drawn from the visible normals (or z
// for a mirror). ratio: G2 / G1; pdf as above; both 1 for a mirror. valid: i is on the side where
// it should be.
struct MicrofacetBounce {
    vec3 wi;
    float ratio;
    float pdf;
    bool valid;
};

// c: o.m in [0, 1]. eta as in microfacetPair; it is not used for reflection.
PATINA_FN MicrofacetBounce microfacetBounce(vec3 o, vec3 m, float c, vec2 alpha, float eta,
                                            bool reflects, int ndf) {
    bool mirror = alpha.x == 0.0f;
    vec2 a = max(alpha, vec2(ALPHA_MIRROR));
    float ct = cosRefracted(c, eta);
    float len = microfacetShift(c, ct, eta);
    float jacobian = select(0.25f, c * eta * eta * ct / max(len * len, TINY), reflects);
    MicrofacetBounce b;
    b.wi = microfacetDirection(o, m, c, eta, reflects);
    float iz = select(b.wi.z, -b.wi.z, reflects);
    float lo = microfacetLength(o, a, ndf);
    float li = microfacetLength(b.wi, a, ndf);
    b.valid = iz > 0.0f && (reflects || ct > 0.0f);
    b.ratio = select(1.0f, microfacetG2OverG1(o.z, lo, iz, li), mirror);
    b.pdf = select(1.0f, microfacetD(m, a, ndf) * jacobian * 2.0f / max(o.z + lo, TINY), mirror);
    return b;
}
