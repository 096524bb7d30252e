// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace patina {

/// Leaves out of one stage's GLSL what drivers would parse and copy for nothing: functions that no
/// chain of names leads to from `main` or from what stands outside of functions, and comments.
/// Names are told apart by spelling alone, so overloads stay or go together, and a macro's body
/// needs all that it names.
///
/// Lines keep their numbers. Text whose braces do not match is returned as it is.
/// @param callers more text, whose names count like those outside of functions
std::string withoutUnusedFunctions(const std::string& text, const std::string& callers = "");

} // namespace patina
