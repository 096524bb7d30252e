// SPDX-License-Identifier: Apache-2.0
// Points for the samples of a pixel: the sequence of Roberts (2018) in two dimensions, the golden
// ratio and the root of two for choices. Each pixel and each dimension begins elsewhere, by a hash.
uint startAt(vec2 pixel, uint dimension) {
    uint h = uint(int(pixel.x)) * 2654435761u ^ uint(int(pixel.y)) * 2246822519u ^ dimension * 3266489917u;
    h = (h ^ (h >> 15u)) * 739982445u;
    h = (h ^ (h >> 12u)) * 695872825u;
    return h ^ (h >> 15u);
}

// Number `index` of dimension 0, 1 (a pair), 2 or 3 of a set, in [0, 1).
float randomAt(vec2 pixel, uint index, uint dimension) {
    uint d = dimension & 3u;
    uint step = d == 0u ? 3242174889u : (d == 1u ? 2447445414u : (d == 2u ? 1779033704u : 2654435769u));
    return float((startAt(pixel, dimension) + index * step) >> 8u) * (1.0 / 16777216.0);
}
