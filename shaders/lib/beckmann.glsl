// SPDX-License-Identifier: Apache-2.0
// The Beckmann microfacet distribution (Beckmann and Spizzichino 1963), anisotropic, with Smith's
// masking in its exact form (Walter et al. 2007; Heitz 2014) and visible normal sampling after Heitz
// and d'Eon 2014 ("Importance Sampling Microfacet-Based BSDFs using the Distribution of Visible
// Normals"). alpha as in ggx.glsl: root mean square slope times sqrt(2).
//
// With s the length of (ax x, ay y) and a = z / s, Lambda = (l / z - 1) / 2 for the length
// l = z erf(a) + s exp(-a^2) / sqrt(PI), which stays finite at grazing angles.

const float INV_SQRT_PI = 0.564189584f;

// Smallest squared z of a half vector; guards the division where exp() is long 0.
const float BECKMANN_Z2_MIN = 1e-18f;

// Newton steps of the sampler at most, and the error at which it stops earlier.
const int BECKMANN_STEPS = 8;
const float BECKMANN_MISS = 1e-7f;

PATINA_FN float beckmannExp(float x) {
    return select(exp2(-1.44269504f * x), 0.0f, x < 80.0f);
}

// Error function within 1.5e-7 (Abramowitz and Stegun 1964, 7.1.26). e: exp(-x^2).
PATINA_FN float beckmannErf(float x, float e) {
    float t = 1.0f / (1.0f + 0.3275911f * abs(x));
    float p = t * (0.254829592f +
                   t * (-0.284496736f +
                        t * (1.421413741f + t * (-1.453152027f + t * 1.061405429f))));
    float y = 1.0f - p * e;
    return select(y, -y, x >= 0.0f);
}

// Its inverse on (-1, 1), relative error below 1e-6 (Giles 2010, "Approximating the erfinv
// function"). x and one minus its magnitude, which the caller may know to more digits.
PATINA_FN float beckmannErfInv(float x) {
    float w = -0.693147181f * log2(max((1.0f - x) * (1.0f + x), 1e-12f));
    float a = w - 2.5f;
    float p = 2.81022636e-08f;
    p = 3.43273939e-07f + p * a;
    p = -3.5233877e-06f + p * a;
    p = -4.39150654e-06f + p * a;
    p = 0.00021858087f + p * a;
    p = -0.00125372503f + p * a;
    p = -0.00417768164f + p * a;
    p = 0.246640727f + p * a;
    p = 1.50140941f + p * a;
    float b = sqrt(max(w, 5.0f)) - 3.0f;
    float q = -0.000200214257f;
    q = 0.000100950558f + q * b;
    q = 0.00134934322f + q * b;
    q = -0.00367342844f + q * b;
    q = 0.00573950773f + q * b;
    q = -0.0076224613f + q * b;
    q = 0.00943887047f + q * b;
    q = 1.00167406f + q * b;
    q = 2.83297682f + q * b;
    return x * select(p, q, w < 5.0f);
}

PATINA_FN_RARE float beckmannLength(vec3 w, vec2 alpha) {
    float x = alpha.x * w.x;
    float y = alpha.y * w.y;
    float s = sqrt(x * x + y * y);
    float z = abs(w.z);
    float a = min(z / max(s, TINY), 10.0f);
    float e = beckmannExp(a * a);
    return z * beckmannErf(a, e) + s * e * INV_SQRT_PI;
}

// exp(-slope^2), slope in units of alpha. xy, z2: of an unnormalised normal.
PATINA_FN float beckmannExponent(vec2 xy, vec2 alpha, float z2) {
    float x = xy.x / alpha.x;
    float y = xy.y / alpha.y;
    return beckmannExp(min((x * x + y * y) / z2, 1e4f));
}

// Density of facet normals m (unit) per solid angle and projected area.
PATINA_FN_RARE float beckmannDensity(vec3 m, vec2 alpha) {
    float z2 = max(m.z * m.z, BECKMANN_Z2_MIN);
    return INV_PI * beckmannExponent(vec2(m.x, m.y), alpha, z2) / (alpha.x * alpha.y) / z2 / z2;
}

// Draws a facet normal with density G1(o) max(0, o.m) D(m) / o.z. Slopes are drawn as wo sees them
// on a surface stretched to alpha 1. Across wo they are Gaussian. Along it their distribution
// function is F(x) = z (1 + erf(x)) / 2 + s exp(-x^2) / (2 sqrt(PI)), up to x = z / s; it is
// inverted in y = erf(x), where it is concave.
PATINA_FN_RARE vec3 beckmannSampleVisible(vec3 wo, vec2 alpha, vec2 u) {
    vec3 o = normalize(vec3(alpha.x * wo.x, alpha.y * wo.y, max(wo.z, 0.0f)));
    float s = sqrt(o.x * o.x + o.y * o.y);
    float a = min(o.z / max(s, TINY), 10.0f);
    float e = beckmannExp(a * a);
    float top = beckmannErf(a, e);
    float goal = u.x * (o.z + o.z * top + s * e * INV_SQRT_PI);
    float lo = -1.0f;
    float hi = top;
    float v = 1.0f - pow(1.0f - u.x, mix(0.5f, 1.0f, o.z));
    float y = -1.0f + (1.0f + top) * v;
    float x = 0.0f;
    for (int i = 0; i < BECKMANN_STEPS; ++i) {
        y = select(y, 0.5f * (lo + hi), y > lo && y < hi);
        x = beckmannErfInv(y);
        float miss = o.z * (1.0f + y) + s * beckmannExp(x * x) * INV_SQRT_PI - goal;
        if (abs(miss) < BECKMANN_MISS) break;
        lo = select(y, lo, miss <= 0.0f);
        hi = select(y, hi, miss >= 0.0f);
        y -= miss / max(o.z - x * s, 1e-6f);
    }
    float across = beckmannErfInv(clamp(2.0f * u.y - 1.0f, -0.9999999f, 0.9999999f));
    x = min(x, a);
    bool upright = s < 1e-6f;
    float c = select(1.0f, o.x / max(s, TINY), upright);
    float d = select(0.0f, o.y / max(s, TINY), upright);
    return normalize(vec3(-alpha.x * (c * x - d * across), -alpha.y * (d * x + c * across), 1.0f));
}

// x: D |o.h| |i.h| over |h|^4 for an unnormalised h; y, z: the lengths of both directions.
PATINA_FN_RARE vec3 beckmannPair(vec3 o, vec3 i, vec3 h, vec2 alpha) {
    float z2 = max(h.z * h.z, BECKMANN_Z2_MIN);
    float e = beckmannExponent(vec2(h.x, h.y), alpha, z2);
    float shape = INV_PI * e / (alpha.x * alpha.y) * (dot(o, h) / z2) * (abs(dot(i, h)) / z2);
    return vec3(shape, beckmannLength(o, alpha), beckmannLength(i, alpha));
}
