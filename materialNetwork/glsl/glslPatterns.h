#pragma once

#include "materialNetwork/cpu/programCode.h"

#include <functional>
#include <string>
#include <vector>

namespace patina {

/// GLSL expressions of a pattern's outputs, one per output register.
/// @param input text of input i, a vec4
/// @param sampler name of the sampler of a texture handle
/// @returns empty when the pattern has no GLSL
std::vector<std::string> glslPattern(const Instruction& instruction,
                                     const std::function<std::string(int)>& input,
                                     const std::function<std::string(int)>& sampler);

} // namespace patina
