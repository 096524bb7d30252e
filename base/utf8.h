// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace patina {

/// Names in damaged files, and messages that quote them, are bytes of any kind; what is told is
/// UTF-8.
/// @returns the text, U+FFFD in the place of each byte that belongs to no character
std::string validUtf8(const std::string& text);

} // namespace patina
