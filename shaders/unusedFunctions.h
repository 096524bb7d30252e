// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace patina {

/// Removes from the GLSL of one stage the text that drivers would parse and copy for nothing:
/// comments, and functions that neither `main` nor text outside of functions reaches by any chain
/// of names. Names are told apart by spelling alone. So overloads stay or go together, and a
/// macro's body needs all names in it.
///
/// Lines keep their numbers. Text whose braces do not match is returned unchanged.
/// @param callers more text, whose names count like those outside of functions
std::string withoutUnusedFunctions(const std::string& text, const std::string& callers = "");

} // namespace patina
