// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <cstring>

namespace patina {

/// Random numbers for methods that need more of them than a sample has dimensions. They follow from
/// what they were made of, so that a render stays a function of its seed.
class HashedNumbers {
public:
    explicit HashedNumbers(uint32_t seed) : _state(seed) {}

    /// Takes the bits of a vector into the seed.
    HashedNumbers& mix(const glm::vec3& v) {
        for (int c = 0; c < 3; ++c) {
            uint32_t bits;
            std::memcpy(&bits, &v[c], sizeof bits);
            _state = scramble(_state ^ bits);
        }
        return *this;
    }

    /// In [0, 1).
    float next() { return float(scramble(_state += 0x9e3779b97f4a7c15u) >> 40) * 0x1p-24f; }
    glm::vec2 next2() {
        const float a = next();
        return {a, next()};
    }
    glm::vec3 next3() {
        const glm::vec2 a = next2();
        return {a, next()};
    }
    uint32_t bits() { return uint32_t(scramble(_state += 0x9e3779b97f4a7c15u) >> 32); }

private:
    /// The finaliser of splitmix64 (Steele, Lea and Flood 2014, "Fast Splittable Pseudorandom
    /// Number Generators").
    static uint64_t scramble(uint64_t x) {
        x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
        x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
        return x ^ (x >> 31);
    }

    uint64_t _state;
};

} // namespace patina
