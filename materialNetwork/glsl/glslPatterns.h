// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/ir/materialIr.h"

#include <functional>
#include <string>
#include <vector>

namespace patina {

/// The parts that the text of a pattern is made of.
struct GlslPatternNames {
    /// Text of a row of input i, a vec4; only matrices have more than row 0.
    std::function<std::string(int input, int row)> input;
    /// Name of the function that reads the texture of a handle.
    std::function<std::string(int handle)> texture;
};

struct GlslPattern {
    std::vector<std::string> outputs; ///< an expression per register; empty where there is no GLSL
    bool rare = false;                ///< needs shaders/raster/moreNodes.glsl
};

GlslPattern glslPattern(const Instruction& instruction, const GlslPatternNames& names);

} // namespace patina
