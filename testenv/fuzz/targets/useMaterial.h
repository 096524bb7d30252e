// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/network/network.h"

#include <string>

namespace patina {

/// Takes a network through all of the room: program, values and samples, GLSL of both kinds, and
/// texts for people. Aborts where a value is no number, negative or without bound, and where a
/// string of the network (those that hold `fuzzMark`) is part of the GLSL text.
void useMaterial(const Network& network, const std::string& source);

/// Strings that hold this must not reach a shader.
inline constexpr const char* fuzzMark = "PWND";

} // namespace patina
