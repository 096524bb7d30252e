// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace patina {

/// Blanks the comments of a whole GLSL text, and what an #ifdef or #ifndef leaves out: then
/// withoutUnusedFunctions() does not keep what only that text calls.
///
/// Branches of #if and #elif stay, since no expression is evaluated here. So does what depends on
/// a name of the driver (GL_..., __VERSION__). Lines keep their numbers.
std::string withoutDeadBranches(const std::string& text);

} // namespace patina
