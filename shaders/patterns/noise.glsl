// SPDX-License-Identifier: Apache-2.0
// Lattice noise of MaterialX 1.39, whose values are those of OSL's noise(): improved Perlin noise
// (Perlin 2002) over the lookup3 hash (Jenkins 2006, public domain).

struct NoiseBits {
    uint a;
    uint b;
    uint c;
};

PATINA_FN NoiseBits noiseBits(uint a, uint b, uint c) {
    NoiseBits s;
    s.a = a;
    s.b = b;
    s.c = c;
    return s;
}

PATINA_FN uint noiseRotate(uint x, int k) {
    return (x << k) | (x >> (32 - k));
}

// State of lookup3 for a key of so many words.
PATINA_FN NoiseBits noiseSeed(uint words) {
    uint v = 0xdeadbeefu + (words << 2u) + 13u;
    return noiseBits(v, v, v);
}

// lookup3's mix(), between blocks of three words.
PATINA_FN NoiseBits noiseMix(NoiseBits s) {
    s.a = (s.a - s.c) ^ noiseRotate(s.c, 4);
    s.c = s.c + s.b;
    s.b = (s.b - s.a) ^ noiseRotate(s.a, 6);
    s.a = s.a + s.c;
    s.c = (s.c - s.b) ^ noiseRotate(s.b, 8);
    s.b = s.b + s.a;
    s.a = (s.a - s.c) ^ noiseRotate(s.c, 16);
    s.c = s.c + s.b;
    s.b = (s.b - s.a) ^ noiseRotate(s.a, 19);
    s.a = s.a + s.c;
    s.c = (s.c - s.b) ^ noiseRotate(s.b, 4);
    s.b = s.b + s.a;
    return s;
}

// lookup3's final(), of which c is the hash.
PATINA_FN uint noiseFinal(NoiseBits s) {
    s.c = (s.c ^ s.b) - noiseRotate(s.b, 14);
    s.a = (s.a ^ s.c) - noiseRotate(s.c, 11);
    s.b = (s.b ^ s.a) - noiseRotate(s.a, 25);
    s.c = (s.c ^ s.b) - noiseRotate(s.b, 16);
    s.a = (s.a ^ s.c) - noiseRotate(s.c, 4);
    s.b = (s.b ^ s.a) - noiseRotate(s.a, 14);
    return (s.c ^ s.b) - noiseRotate(s.b, 24);
}

PATINA_FN uint noiseHash2(int x, int y) {
    NoiseBits s = noiseSeed(2u);
    return noiseFinal(noiseBits(s.a + uint(x), s.b + uint(y), s.c));
}

PATINA_FN uint noiseHash3(int x, int y, int z) {
    NoiseBits s = noiseSeed(3u);
    return noiseFinal(noiseBits(s.a + uint(x), s.b + uint(y), s.c + uint(z)));
}

PATINA_FN uint noiseHash4(int x, int y, int z, int w) {
    NoiseBits s = noiseSeed(4u);
    s = noiseMix(noiseBits(s.a + uint(x), s.b + uint(y), s.c + uint(z)));
    return noiseFinal(noiseBits(s.a + uint(w), s.b, s.c));
}

PATINA_FN uint noiseHash5(int x, int y, int z, int w, int v) {
    NoiseBits s = noiseSeed(5u);
    s = noiseMix(noiseBits(s.a + uint(x), s.b + uint(y), s.c + uint(z)));
    return noiseFinal(noiseBits(s.a + uint(w), s.b + uint(v), s.c));
}

// A hash as a number in [0, 1].
PATINA_FN float noiseUnit(uint bits) {
    return float(bits) * (1.0f / 4294967296.0f);
}

// The lattice cell of a coordinate. Numbers beyond all integers stay in the last cell.
PATINA_FN int noiseCell(float x) {
    return int(floor(clamp(x, -2147483520.0f, 2147483520.0f)));
}

PATINA_FN float noiseFade(float t) {
    return t * t * t * (t * (t * 6.0f - 15.0f) + 10.0f);
}

PATINA_FN float noiseSigned(float x, uint negative) {
    return select(-x, x, negative != 0u);
}

// Slopes (+-1, +-2) and (+-2, +-1).
PATINA_FN float noiseSlope2(uint h, float x, float y) {
    bool low = (h & 7u) < 4u;
    return noiseSigned(select(x, y, low), h & 1u) + 2.0f * noiseSigned(select(y, x, low), h & 2u);
}

// Slopes to the middles of a cube's edges.
PATINA_FN float noiseSlope3(uint hash, float x, float y, float z) {
    uint h = hash & 15u;
    float u = select(x, y, h < 8u);
    float v = select(y, select(x, z, h == 12u || h == 14u), h < 4u);
    return noiseSigned(u, h & 1u) + noiseSigned(v, h & 2u);
}

// shift: which byte of the hash picks the slopes; 0, 8 and 16 are the channels of a vector.
PATINA_FN float noisePerlin2(vec2 p, int shift) {
    int x = noiseCell(p.x);
    int y = noiseCell(p.y);
    float fx = p.x - float(x);
    float fy = p.y - float(y);
    float s = noiseFade(fx);
    float a = mix(noiseSlope2(noiseHash2(x, y) >> shift, fx, fy),
                  noiseSlope2(noiseHash2(x + 1, y) >> shift, fx - 1.0f, fy), s);
    float b = mix(noiseSlope2(noiseHash2(x, y + 1) >> shift, fx, fy - 1.0f),
                  noiseSlope2(noiseHash2(x + 1, y + 1) >> shift, fx - 1.0f, fy - 1.0f), s);
    return 0.6616f * mix(a, b, noiseFade(fy));
}

// One z layer of the lattice.
PATINA_FN float noiseLayer3(int x, int y, int z, vec3 f, int shift) {
    float s = noiseFade(f.x);
    float a = mix(noiseSlope3(noiseHash3(x, y, z) >> shift, f.x, f.y, f.z),
                  noiseSlope3(noiseHash3(x + 1, y, z) >> shift, f.x - 1.0f, f.y, f.z), s);
    float b =
        mix(noiseSlope3(noiseHash3(x, y + 1, z) >> shift, f.x, f.y - 1.0f, f.z),
            noiseSlope3(noiseHash3(x + 1, y + 1, z) >> shift, f.x - 1.0f, f.y - 1.0f, f.z), s);
    return mix(a, b, noiseFade(f.y));
}

PATINA_FN float noisePerlin3(vec3 p, int shift) {
    int x = noiseCell(p.x);
    int y = noiseCell(p.y);
    int z = noiseCell(p.z);
    vec3 f = vec3(p.x - float(x), p.y - float(y), p.z - float(z));
    return 0.9820f * mix(noiseLayer3(x, y, z, f, shift),
                         noiseLayer3(x, y, z + 1, vec3(f.x, f.y, f.z - 1.0f), shift),
                         noiseFade(f.z));
}

PATINA_FN float noiseCell2(vec2 p) {
    return noiseUnit(noiseHash2(noiseCell(p.x), noiseCell(p.y)));
}

PATINA_FN float noiseCell3(vec3 p) {
    return noiseUnit(noiseHash3(noiseCell(p.x), noiseCell(p.y), noiseCell(p.z)));
}

// Three numbers for a cell of the plane, and of space.
PATINA_FN vec3 noiseCellTriple2(vec2 p) {
    int x = noiseCell(p.x);
    int y = noiseCell(p.y);
    return vec3(noiseUnit(noiseHash3(x, y, 0)), noiseUnit(noiseHash3(x, y, 1)),
                noiseUnit(noiseHash3(x, y, 2)));
}

PATINA_FN vec3 noiseCellTriple3(vec3 p) {
    int x = noiseCell(p.x);
    int y = noiseCell(p.y);
    int z = noiseCell(p.z);
    return vec3(noiseUnit(noiseHash4(x, y, z, 0)), noiseUnit(noiseHash4(x, y, z, 1)),
                noiseUnit(noiseHash4(x, y, z, 2)));
}

// Sum of octaves of Perlin noise; each has lacunarity times the frequency and diminish times the
// amplitude of the one before. More octaves than 32 add nothing that a float could hold.
PATINA_FN float noiseFractal2(vec2 p, int octaves, float lacunarity, float diminish, int shift) {
    float sum = 0.0f;
    float amplitude = 1.0f;
    int count = min(octaves, 32);
    for (int i = 0; i < count; ++i) {
        sum += amplitude * noisePerlin2(p, shift);
        amplitude *= diminish;
        p = p * lacunarity;
    }
    return sum;
}

PATINA_FN float noiseFractal3(vec3 p, int octaves, float lacunarity, float diminish, int shift) {
    float sum = 0.0f;
    float amplitude = 1.0f;
    int count = min(octaves, 32);
    for (int i = 0; i < count; ++i) {
        sum += amplitude * noisePerlin3(p, shift);
        amplitude *= diminish;
        p = p * lacunarity;
    }
    return sum;
}
