// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include <cstdint>

namespace patina {

/// Directions of the third and fourth Sobol dimension (primitive polynomials x^2 + x + 1 with 1, 3
/// and x^3 + x + 1 with 1, 3, 1; Joe and Kuo 2008), summed up for all values of each byte.
struct SobolBytes {
    uint32_t sums[2][4][256] = {};

    constexpr SobolBytes() {
        uint32_t directions[2][32] = {{1u << 31, 3u << 30}, {1u << 31, 3u << 30, 1u << 29}};
        for (int k = 2; k < 32; ++k)
            directions[0][k] =
                directions[0][k - 1] ^ directions[0][k - 2] ^ (directions[0][k - 2] >> 2);
        for (int k = 3; k < 32; ++k)
            directions[1][k] =
                directions[1][k - 2] ^ directions[1][k - 3] ^ (directions[1][k - 3] >> 3);
        for (int d = 0; d < 2; ++d)
            for (int byte = 0; byte < 4; ++byte)
                for (int value = 0; value < 256; ++value)
                    for (int bit = 0; bit < 8; ++bit)
                        if ((value >> bit & 1) != 0)
                            sums[d][byte][value] ^= directions[d][byte * 8 + bit];
    }
};
inline constexpr SobolBytes sobolBytes;

/// Owen-scrambled Sobol points in sets of up to four dimensions, which are decorrelated between
/// sets and pixels by a nested uniform shuffle of the index (Burley 2020, Practical Hash-based Owen
/// Scrambling; the hash of Laine and Karras 2011 with Vegdahl's constants). The first two
/// dimensions of a set are a (0,2) sequence. A sample depends only on pixel, seed, sample index and
/// set, so pixels do not depend on threads or on the order of tiles.
class Sampler {
public:
    Sampler(uint32_t x, uint32_t y, uint32_t seed, uint32_t index)
        : _seed(hash(x ^ hash(y ^ hash(seed + 0x9e3779b9u)))), _index(index) {}

    /// A set of which every sample of the pixel takes `count` points, stratified all together.
    class Set {
    public:
        glm::vec2 point2(uint32_t i = 0) const { return plane(shuffled(i)); }
        glm::vec4 point4(uint32_t i = 0) const {
            const uint32_t reversed = shuffled(i), index = reverseBits(reversed);
            return glm::vec4(plane(reversed), scrambled(sobol(0, index), hash(_seed + 0x1b56c4e9u)),
                             scrambled(sobol(1, index), hash(_seed + 0x7c3a91b5u)));
        }

    private:
        friend class Sampler;
        Set(uint32_t seed, uint32_t first) : _seed(seed), _first(first) {}

        /// The index of a point after the shuffle, its bits reversed.
        uint32_t shuffled(uint32_t i) const { return laineKarras(reverseBits(_first + i), _seed); }
        glm::vec2 plane(uint32_t reversed) const {
            return glm::vec2(
                toUnit(reverseBits(laineKarras(reverseBits(reversed), hash(_seed + 0x68bc21ebu)))),
                scrambled(pascal(reversed), hash(_seed + 0x02e5be93u)));
        }

        uint32_t _seed, _first;
    };
    Set nextSet(uint32_t count = 1) {
        return Set(hash(_seed ^ (0x85ebca6bu * ++_set)), _index * count);
    }

    /// Numbers in [0, 1), stratified together over the samples of the pixel.
    glm::vec2 next2() { return nextSet().point2(); }
    glm::vec3 next3() { return glm::vec3(nextSet().point4()); }
    glm::vec4 next4() { return nextSet().point4(); }

    /// One of `count` samples that go on in place of this one, stratified all together.
    void split(uint32_t i, uint32_t count) { _index = _index * count + i; }

    /// A number that is not stratified, for decisions that are rarely taken.
    float random() { return toUnit(randomBits()); }

    /// A seed for further numbers.
    uint32_t randomBits() { return hash(hash(_seed ^ (0x27d4eb2fu * ++_set)) ^ hash(_index)); }

    static uint32_t hash(uint32_t x) {
        // lowbias32 by Chris Wellons.
        x ^= x >> 16;
        x *= 0x7feb352du;
        x ^= x >> 15;
        x *= 0x846ca68bu;
        x ^= x >> 16;
        return x;
    }

private:
    static float toUnit(uint32_t bits) { return float(bits >> 8) * 0x1p-24f; }

    static uint32_t reverseBits(uint32_t x) {
        x = __builtin_bswap32(x);
        x = ((x & 0x0f0f0f0fu) << 4) | ((x >> 4) & 0x0f0f0f0fu);
        x = ((x & 0x33333333u) << 2) | ((x >> 2) & 0x33333333u);
        return ((x & 0x55555555u) << 1) | ((x >> 1) & 0x55555555u);
    }

    /// A nested uniform scramble of reversed bits.
    static uint32_t laineKarras(uint32_t x, uint32_t seed) {
        x ^= x * 0x3d20adeau;
        x += seed;
        x *= (seed >> 16) | 1u;
        x ^= x * 0x05526c56u;
        return x ^ x * 0x53a22864u;
    }
    static float scrambled(uint32_t x, uint32_t seed) {
        return toUnit(reverseBits(laineKarras(reverseBits(x), seed)));
    }

    /// The second Sobol dimension: its direction numbers are rows of Pascal's triangle modulo 2,
    /// which is a Kronecker power of ((1, 1), (0, 1)) (Lucas).
    static uint32_t pascal(uint32_t reversed) {
        uint32_t x = reversed;
        x ^= (x << 1) & 0xaaaaaaaau;
        x ^= (x << 2) & 0xccccccccu;
        x ^= (x << 4) & 0xf0f0f0f0u;
        x ^= (x << 8) & 0xff00ff00u;
        return x ^ (x << 16);
    }

    static uint32_t sobol(int dimension, uint32_t index) {
        const auto& bytes = sobolBytes.sums[dimension];
        return bytes[0][index & 255u] ^ bytes[1][index >> 8 & 255u] ^ bytes[2][index >> 16 & 255u] ^
               bytes[3][index >> 24];
    }

    uint32_t _seed;
    uint32_t _index;
    uint32_t _set = 0;
};

} // namespace patina
