// SPDX-License-Identifier: Apache-2.0
// Warps from the unit square, and small functions that several lobes need.

PATINA_FN float sqr(float x) {
    return x * x;
}

PATINA_FN float safeSqrt(float x) {
    return sqrt(max(x, 0.0f));
}

// Arc cosine on [0, 1]; absolute error below 3e-8 (Abramowitz and Stegun 1964, 4.4.46). Algebra
// only, so that it runs in lanes.
PATINA_FN float acosUnit(float x) {
    float p = -0.0012624911f;
    p = p * x + 0.0066700901f;
    p = p * x - 0.0170881256f;
    p = p * x + 0.0308918810f;
    p = p * x - 0.0501743046f;
    p = p * x + 0.0889789874f;
    p = p * x - 0.2145988016f;
    p = p * x + 1.5707963050f;
    return safeSqrt(1.0f - x) * p;
}

// Cosine weighted direction in the upper hemisphere; density z / PI.
PATINA_FN vec3 sampleCosineHemisphere(vec2 u) {
    float r = sqrt(u.x);
    float phi = TWO_PI * u.y;
    return vec3(r * cos(phi), r * sin(phi), safeSqrt(1.0f - u.x));
}

// Direction at versine (1 - cos) v from unit axis n, turned by phi about it (basis of Duff et al.
// 2017).
PATINA_FN vec3 aroundAxis(vec3 n, float v, float phi) {
    float side = select(1.0f, -1.0f, n.z >= 0.0f);
    float a = -1.0f / (side + n.z);
    float b = n.x * n.y * a;
    vec3 x = vec3(1.0f + side * n.x * n.x * a, side * b, -side * n.x);
    vec3 y = vec3(b, side + n.y * n.y * a, -n.y);
    float r = safeSqrt(v * (2.0f - v));
    return x * (r * cos(phi)) + y * (r * sin(phi)) + n * (1.0f - v);
}

// (1 - v)^e without loss for small v and large e; 0 from v = 1 on.
PATINA_FN float powFromVersine(float v, float e) {
    float ln = -v * (1.0f + v * (0.5f + v * (1.0f / 3.0f + v * 0.25f)));
    float lg = select(1.44269504f * ln, log2(max(1.0f - v, 1e-30f)), v < 0.01f);
    return select(exp2(e * lg), 0.0f, v < 1.0f);
}

// The versine of a direction whose cosine has density proportional to cos^(e - 1): cos = u^(1/e).
PATINA_FN float sampleVersine(float u, float e) {
    float y = -0.693147181f * log2(max(1.0f - u, 1e-30f)) / e;
    float small = y * (1.0f - y * (0.5f - y * (1.0f / 6.0f - y * (1.0f / 24.0f))));
    return select(small, 1.0f - exp2(-1.44269504f * y), y < 0.01f);
}
