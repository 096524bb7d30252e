#pragma once

#include <glm/glm.hpp>

#include <cstdint>

namespace patina {

/// Owen-scrambled Sobol points: pairs of the first two dimensions, which together are a (0,2)
/// sequence, decorrelated between pairs and pixels by a nested uniform shuffle of the index (Burley
/// 2020, Practical Hash-based Owen Scrambling; the hash of Laine and Karras 2011 with Vegdahl's
/// constants). A sample depends only on pixel, seed, sample index and set, so pixels do not depend
/// on threads or on the order of tiles.
class Sampler {
public:
    Sampler(uint32_t x, uint32_t y, uint32_t seed, uint32_t index)
        : _seed(hash(x ^ hash(y ^ hash(seed + 0x9e3779b9u)))), _index(index) {}

    /// Two numbers in [0, 1), stratified together over the samples of the pixel.
    glm::vec2 next2() {
        const uint32_t setSeed = hash(_seed ^ (0x85ebca6bu * ++_set));
        const uint32_t index = nestedUniformScramble(_index, setSeed);
        const uint32_t x = nestedUniformScramble(reverseBits(index), hash(setSeed + 0x68bc21ebu));
        const uint32_t y = nestedUniformScramble(sobol2(index), hash(setSeed + 0x02e5be93u));
        return glm::vec2(toUnit(x), toUnit(y));
    }

    /// Three numbers in [0, 1): next2(), and the third dimension of the same points.
    glm::vec3 next3() {
        const uint32_t setSeed = hash(_seed ^ (0x85ebca6bu * (_set + 1)));
        const glm::vec2 two = next2();
        const uint32_t z = nestedUniformScramble(sobol3(nestedUniformScramble(_index, setSeed)),
                                                 hash(setSeed + 0x1b56c4e9u));
        return glm::vec3(two, toUnit(z));
    }

    glm::vec4 next4() {
        const glm::vec2 a = next2(), b = next2();
        return glm::vec4(a, b);
    }

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

    static uint32_t nestedUniformScramble(uint32_t x, uint32_t seed) {
        x = reverseBits(x);
        x ^= x * 0x3d20adeau;
        x += seed;
        x *= (seed >> 16) | 1u;
        x ^= x * 0x05526c56u;
        x ^= x * 0x53a22864u;
        return reverseBits(x);
    }

    /// The second Sobol dimension: its direction numbers are rows of Pascal's triangle modulo 2.
    static uint32_t sobol2(uint32_t index) {
        uint32_t result = 0;
        for (uint32_t direction = 1u << 31; index != 0; index >>= 1, direction ^= direction >> 1)
            result ^= (index & 1u) * direction;
        return result;
    }

    /// The third: that of the primitive polynomial x^2 + x + 1 with 1, 3 (Joe and Kuo 2008).
    static uint32_t sobol3(uint32_t index) {
        uint32_t result = 0, direction = 1u << 31, next = 3u << 30;
        for (; index != 0; index >>= 1) {
            result ^= (index & 1u) * direction;
            const uint32_t after = next ^ direction ^ (direction >> 2);
            direction = next;
            next = after;
        }
        return result;
    }

    uint32_t _seed;
    uint32_t _index;
    uint32_t _set = 0;
};

} // namespace patina
