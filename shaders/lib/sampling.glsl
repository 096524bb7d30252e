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
