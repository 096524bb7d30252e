// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace patina {

/// MurmurHash3_x86_32 with seed 0 (Appleby 2011, public domain).
uint32_t murmurHash3(const std::string& text);

/// The id that Cryptomatte gives a name (specification 1.2.0, "ID generation"): the hash of its
/// UTF-8 bytes, made the bits of a float that is a normal number. Never 0, which is nobody's id.
uint32_t cryptomatteId(const std::string& name);

/// Eight hexadecimal digits, as manifests have them.
std::string hexOf(uint32_t id);

} // namespace patina
