// SPDX-License-Identifier: Apache-2.0
// Numbers and lights of a pass.
#include "shaders/raster/passBlock.glsl"
#include "shaders/raster/lights.glsl"

uint hash(uint x) { // PCG (Jarzynski and Olano 2020)
    uint s = x * 747796405u + 2891336453u;
    uint w = ((s >> ((s >> 28u) + 4u)) ^ s) * 277803737u;
    return (w >> 22u) ^ w;
}
// Owen's scrambling by a hash (Laine and Karras 2011, constants as in hdDelegate/film/sampler.h).
uint scramble(uint x, uint seed) {
    x = bitfieldReverse(x);
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return bitfieldReverse(x);
}
// Pair `set` of sample `index` of a pixel: Owen-scrambled Sobol points (Burley 2020).
vec2 randomAt(uvec2 pixel, uint index, uint set) {
    uint seed = hash(pixel.x + hash(pixel.y + hash(set + 64u * uint(passSeed))));
    uint i = scramble(index, seed);
    // The second dimension is Pascal's triangle modulo 2, a Kronecker power: five steps for 32 bits.
    uint y = i ^ (i >> 16);
    y ^= (y & 0xff00ff00u) >> 8;
    y ^= (y & 0xf0f0f0f0u) >> 4;
    y ^= (y & 0xccccccccu) >> 2;
    y ^= (y & 0xaaaaaaaau) >> 1;
    uvec2 bits = uvec2(scramble(bitfieldReverse(i), hash(seed + 0x68bc21ebu)),
                       scramble(bitfieldReverse(y), hash(seed + 0x02e5be93u)));
    return vec2(bits >> 8u) * (1.0 / 16777216.0);
}
