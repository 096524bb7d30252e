// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/ir/layerWeights.h"
#include "materialNetwork/glsl/closureText.h"

namespace patina {

/// GLSL that sets lobeWeight[], for the middle of a function that has set up lobes, frames,
/// lobeAlbedo[] and `coverage` of each lobe: weighLobes() in text.
std::string glslWeights(const MaterialIr& code, const GlslRegister& registers);

/// GLSL for what a lobe keeps from the base of a layer: coverOf() in text.
std::string glslCoverage(const MaterialIr& code, const std::string& fixed);

} // namespace patina
