// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace patina {

/// The most that input may ask for, see limits.def.
enum class Limit {
#define LIMIT(name, ...) name,
#include "base/limits.def"
#undef LIMIT
};

/// The value that holds in this process. Thread safe.
uint64_t limitOf(Limit limit);

/// A limit as messages name it: "200000 (--limit nodes)".
std::string limitText(Limit limit);

/// Gives limits values; all others have their defaults again, or what PATINA_LIMITS says. For the
/// start of a process or a command: what was read before stays.
/// @returns an empty text, or why nothing was changed
std::string setLimits(const std::map<std::string, uint64_t>& values);

} // namespace patina
