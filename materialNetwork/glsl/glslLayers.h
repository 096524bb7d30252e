#pragma once

#include "materialNetwork/cpu/programCode.h"

#include <string>
#include <vector>

namespace patina {

/// GLSL that sets lobeWeight[] where layers count what their tops send back down, for the middle of
/// a function that has set up lobes, frames, lobeAlbedo[] and `coverage` of each lobe. The same as
/// BsdfBuilder::setReturnedWeights(), unrolled.
/// @param factors  per closure: share of a mix, weight of a lobe, colour of a product
std::string glslReturnedWeights(const ProgramCode& code, const std::vector<std::string>& factors);

} // namespace patina
