// SPDX-License-Identifier: Apache-2.0
// Where a blur looks at its input: one tap in each of 5 x 5 cells of a square of width 1 around the
// point. The cells of a Gaussian hold the same share each of a normal distribution of deviation 0.2,
// cut off at the square.

const int BLUR_TAPS = 5; // along each axis

// The inverse of the error function for |x| < 0.99 (Giles 2010), relative error 3e-7.
PATINA_FN float blurInverseErf(float x) {
    float w = -0.69314718f * log2((1.0f - x) * (1.0f + x)) - 2.5f;
    float p = 2.81022636e-08f;
    p = 3.43273939e-07f + p * w;
    p = -3.5233877e-06f + p * w;
    p = -4.39150654e-06f + p * w;
    p = 0.00021858087f + p * w;
    p = -0.00125372503f + p * w;
    p = -0.00417768164f + p * w;
    p = 0.246640727f + p * w;
    p = 1.50140941f + p * w;
    return p * x;
}

PATINA_FN float blurOffset(float share, bool gaussian) {
    if (!gaussian) return share - 0.5f;
    // 0.9876 is the share of a normal distribution within 2.5 deviations.
    return 0.28284271f * blurInverseErf(0.98758067f * (2.0f * share - 1.0f));
}

PATINA_FN float blurRandom(uint seed, int blur, int key) {
    NoiseBits s = noiseSeed(3u);
    uint h = noiseFinal(noiseBits(s.a + seed, s.b + uint(blur), s.c + uint(key)));
    return float(h >> 8u) * (1.0f / 16777216.0f);
}

// seed: other places in the cells; 0 for their middles. blur: number of the node, so that blurs of
// blurs move apart. tap: of BLUR_TAPS * BLUR_TAPS.
PATINA_FN vec2 patternBlurTap(uint seed, int blur, int tap, bool gaussian) {
    vec2 u = vec2(0.5f);
    if (seed != 0u) u = vec2(blurRandom(seed, blur, 2 * tap), blurRandom(seed, blur, 2 * tap + 1));
    int y = tap / BLUR_TAPS;
    int x = tap - y * BLUR_TAPS;
    float width = 1.0f / float(BLUR_TAPS);
    return vec2(blurOffset((float(x) + u.x) * width, gaussian),
                blurOffset((float(y) + u.y) * width, gaussian));
}
