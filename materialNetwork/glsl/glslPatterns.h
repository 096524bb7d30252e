// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/ir/materialIr.h"

#include <functional>
#include <string>
#include <vector>

namespace patina {

/// The parts that the text of a pattern is made of.
struct GlslPatternNames {
    /// Row of input i, a vec4; only matrices have more than row 0.
    std::function<std::string(int input, int row)> input;
    /// Row of the outputs, a vec4.
    std::function<std::string(int row)> output;
    /// Number of the texture with a handle, as texel() takes it.
    std::function<int(int handle)> texture;
};

/// A statement that calls the function of a pattern and writes its outputs.
std::string glslPattern(const Instruction& instruction, const GlslPatternNames& names);

} // namespace patina
