// The GGX microfacet distribution (Walter et al. 2007), anisotropic, with height-correlated Smith
// masking-shadowing (Heitz 2014, "Understanding the Masking-Shadowing Function", eq. 86 and 99) and
// visible normal sampling by spherical caps (Dupuy and Benyoub 2023). alpha: roughness along x and
// y, in [ALPHA_MIRROR, 1]. Directions are above the surface.
//
// With l(w) = sqrt(ax^2 x^2 + ay^2 y^2 + z^2), Lambda = (l / z - 1) / 2. Everything below is
// written in l, where the cosines cancel and grazing angles stay finite:
//   G1(o) / o.z          = 2 / (o.z + l(o))
//   G2(o, i) / (o.z i.z) = 2 / (l(o) i.z + l(i) o.z)
// Reflection and refraction use the same G2.

// Clamps MaterialX roughness inputs to usable alphas; x and y are left below ALPHA_MIRROR only when
// both are (a mirror).
PATINA_FN vec2 ggxAlpha(vec2 roughness) {
    vec2 a = min(max(roughness, vec2(0.0f)), vec2(1.0f));
    bool mirror = max(a.x, a.y) < ALPHA_MIRROR;
    return select(vec2(0.0f), max(a, vec2(ALPHA_MIRROR)), mirror);
}

PATINA_FN float ggxLength(vec3 w, vec2 alpha) {
    float x = alpha.x * w.x;
    float y = alpha.y * w.y;
    return sqrt(x * x + y * y + w.z * w.z);
}

// Density of facet normals m (unit) per solid angle and projected area.
PATINA_FN float ggxD(vec3 m, vec2 alpha) {
    float a = alpha.x * alpha.y;
    float x = m.x * alpha.y;
    float y = m.y * alpha.x;
    float z = m.z * a;
    float t = a / (x * x + y * y + z * z);
    return INV_PI * a * t * t;
}

// G2 / (o.z i.z); lo and li are ggxLength of both directions.
PATINA_FN float ggxG2Ratio(float oz, float lo, float iz, float li) {
    return 2.0f / max(lo * iz + li * oz, TINY);
}

// G2 / G1(o): what is left of the weight after visible normal sampling. In [0, 1].
PATINA_FN float ggxG2OverG1(float oz, float lo, float iz, float li) {
    return iz * (oz + lo) / max(lo * iz + li * oz, TINY);
}

// Draws a facet normal with density G1(o) max(0, o.m) D(m) / o.z.
PATINA_FN vec3 ggxSampleVisible(vec3 wo, vec2 alpha, vec2 u) {
    vec3 o = normalize(vec3(alpha.x * wo.x, alpha.y * wo.y, wo.z));
    float phi = TWO_PI * u.x;
    float z = (1.0f - u.y) * (1.0f + o.z) - o.z;
    float r = safeSqrt(1.0f - z * z);
    vec3 h = vec3(r * cos(phi), r * sin(phi), z) + o;
    // h.z = (1 - u.y)(1 + o.z) is above 0 for u.y < 1; the bound only guards rounding.
    return normalize(vec3(alpha.x * h.x, alpha.y * h.y, max(h.z, NORMAL_Z_MIN)));
}

// Isotropic alphas that stand in for the anisotropic one where tables are read. For the
// reflectance: what wo sees along its own azimuth, the root mean square when it looks straight
// down. Errors of the albedo are then below 2e-2 outside glass, 9e-2 inside.
PATINA_FN float ggxAlphaSeen(vec3 wo, vec2 alpha) {
    float x = alpha.x * wo.x;
    float y = alpha.y * wo.y;
    return min(sqrt(x * x + y * y + wo.z * wo.z * 0.5f * dot(alpha, alpha)), 1.0f);
}

// For the light that single scattering loses: facets lean over in all directions, so rough lobes
// tend to the root mean square whatever the azimuth. The albedo of white metal is met within 9e-2
// (alpha 0.1 by 0.4), 0.15 (0.3 by 0.9).
PATINA_FN float ggxAlphaLoss(vec3 wo, vec2 alpha) {
    float rms = sqrt(0.5f * dot(alpha, alpha));
    return mix(ggxAlphaSeen(wo, alpha), rms, min(2.0f * rms, 1.0f));
}

// What the lobes on this distribution share: light that meets facet h on its way from o (above the
// surface) to i, which lies above the surface when it reflects and below when it refracts. All
// without Fresnel. value: D G2 |o.h| / o.z dh/di, which is BSDF times |cos i|; pdf: density of i
// after visible normal sampling; c: o.h in [0, 1].
struct GgxPair {
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
PATINA_FN GgxPair ggxPair(vec3 o, vec3 i, vec2 alpha, float eta) {
    vec3 h = o + i * eta;
    h = select(h, -h, h.z >= 0.0f);
    float oh = dot(o, h);
    float ih = dot(i, h);
    float a = alpha.x * alpha.y;
    float x = h.x * alpha.y;
    float y = h.y * alpha.x;
    float z = h.z * a;
    float t = a / max(x * x + y * y + z * z, TINY * TINY);
    bool valid = oh > 0.0f && ih * i.z > 0.0f;
    float shape = INV_PI * a * eta * eta * (t * oh) * (t * abs(ih));
    shape = select(shape, 0.0f, valid);
    float oz = max(o.z, 0.0f);
    float iz = abs(i.z);
    float lo = ggxLength(o, alpha);
    float li = ggxLength(i, alpha);
    GgxPair p;
    p.value = shape * iz * ggxG2Ratio(oz, lo, iz, li);
    p.pdf = shape * 2.0f / max(oz + lo, TINY);
    p.c = clamp(oh / sqrt(max(dot(h, h), TINY)), 0.0f, 1.0f);
    return p;
}

// The same from the sampling side: o meets a facet m that was drawn from the visible normals (or z
// for a mirror). ratio: G2 / G1; pdf as above; both 1 for a mirror. valid: i is on the side where
// it should be.
struct GgxBounce {
    vec3 wi;
    float ratio;
    float pdf;
    bool valid;
};

// c: o.m in [0, 1]. eta as in ggxPair; it is not used for reflection.
PATINA_FN GgxBounce ggxBounce(vec3 o, vec3 m, float c, vec2 alpha, float eta, bool reflects) {
    bool mirror = alpha.x == 0.0f;
    vec2 a = max(alpha, vec2(ALPHA_MIRROR));
    float ct = cosRefracted(c, eta);
    // c - eta ct without cancellation for eta near 1; m len - o is along the refracted direction.
    float len = (1.0f - eta) * (1.0f + eta) / max(c + eta * ct, TINY);
    float jacobian = select(0.25f, c * eta * eta * ct / max(len * len, TINY), reflects);
    GgxBounce b;
    b.wi = select(m * (2.0f * c) - o, normalize(m * len - o), reflects);
    float iz = select(b.wi.z, -b.wi.z, reflects);
    float lo = ggxLength(o, a);
    float li = ggxLength(b.wi, a);
    b.valid = iz > 0.0f && (reflects || ct > 0.0f);
    b.ratio = select(1.0f, ggxG2OverG1(o.z, lo, iz, li), mirror);
    b.pdf = select(1.0f, ggxD(m, a) * jacobian * 2.0f / max(o.z + lo, TINY), mirror);
    return b;
}
