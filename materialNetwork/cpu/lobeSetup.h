#pragma once

#include "materialNetwork/cpu/programCode.h"

namespace patina {

/// Names of a lobe's inputs in the order of LobeTemplate::parameters; ends with null.
const char* const* lobeParameters(ClosureKind kind);

LobeKind lobeKind(ClosureKind kind);

/// Computes the lobe from its parameters.
void setupLobe(const LobeTemplate& lobe, const glm::vec4* registers, BsdfLobe& out);

} // namespace patina
