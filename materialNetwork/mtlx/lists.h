// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace patina {

/// The parts of a text between commas, without the spaces around them.
std::vector<std::string> splitList(const std::string& text);

/// Reads numbers between commas or spaces; one alone stands for all components.
/// @returns false where the text is anything else, or numbers of another count
bool readNumbers(std::string text, size_t components, std::vector<float>& out);

} // namespace patina
