// SPDX-License-Identifier: Apache-2.0
// Points for the samples of a pixel: the sequence of Roberts (2018) in two dimensions, the golden
// ratio and the root of two for choices. Each pixel begins elsewhere, by interleaved gradient noise
// (Jimenez 2014), so that neighbours err in opposite directions and the eye averages them.
float startAt(vec2 pixel, uint dimension) {
    vec2 p = pixel + 5.588238 * float(dimension & 63u);
    return fract(52.9829189 * fract(dot(p, vec2(0.06711056, 0.00583715))));
}

// Number `index` of dimension 0, 1 (a pair), 2 or 3 of a set, in [0, 1).
float randomAt(vec2 pixel, uint index, uint dimension) {
    uint d = dimension & 3u;
    uint step = d == 0u ? 3242174889u : (d == 1u ? 2447445414u : (d == 2u ? 1779033704u : 2654435769u));
    uint start = uint(startAt(pixel, dimension) * 16777216.0) << 8u;
    return float((start + index * step) >> 8u) * (1.0 / 16777216.0);
}
