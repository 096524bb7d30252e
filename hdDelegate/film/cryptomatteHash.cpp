// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/film/cryptomatteHash.h"

#include <cstdio>
#include <cstring>

namespace patina {

namespace {

uint32_t rotated(uint32_t x, int bits) {
    return (x << bits) | (x >> (32 - bits));
}

uint32_t scrambled(uint32_t block) {
    return rotated(block * 0xcc9e2d51u, 15) * 0x1b873593u;
}

/// Little-endian, whatever the machine is.
uint32_t blockOf(const unsigned char* bytes, size_t count) {
    uint32_t block = 0;
    for (size_t i = 0; i < count; ++i)
        block |= uint32_t(bytes[i]) << (8 * i);
    return block;
}

} // namespace

uint32_t murmurHash3(const std::string& text) {
    const auto* bytes = reinterpret_cast<const unsigned char*>(text.data());
    uint32_t h = 0;
    size_t i = 0;
    for (; i + 4 <= text.size(); i += 4)
        h = rotated(h ^ scrambled(blockOf(bytes + i, 4)), 13) * 5u + 0xe6546b64u;
    if (i < text.size()) h ^= scrambled(blockOf(bytes + i, text.size() - i));
    h ^= uint32_t(text.size());
    h = (h ^ (h >> 16)) * 0x85ebca6bu;
    h = (h ^ (h >> 13)) * 0xc2b2ae35u;
    return h ^ (h >> 16);
}

uint32_t cryptomatteId(const std::string& name) {
    const uint32_t hash = murmurHash3(name), exponent = hash >> 23 & 255u;
    // Zero, subnormal numbers, infinities and NaN do not come through every program.
    return exponent == 0u || exponent == 255u ? hash ^ (1u << 23) : hash;
}

std::string hexOf(uint32_t id) {
    char text[9];
    std::snprintf(text, sizeof text, "%08x", unsigned(id));
    return text;
}

} // namespace patina
