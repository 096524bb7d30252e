#pragma once

#include "materialNetwork/cpu/programCode.h"

namespace patina {

/// Inputs of a lobe that are numbers, in the order of LobeTemplate::parameters.
const std::vector<std::string>& lobeParameters(LobeKind kind);
/// Its first boolean input, the flag of LobeTemplate; empty when there is none.
const std::string& lobeFlag(LobeKind kind);

/// Computes the lobe from its parameters.
void setupLobe(const LobeTemplate& lobe, const glm::vec4* registers, BsdfLobe& out);

} // namespace patina
