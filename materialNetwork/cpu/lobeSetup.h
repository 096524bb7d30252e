// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/cpu/programCode.h"

namespace patina {

/// Computes the lobe from its parameters.
void setupLobe(const LobeTemplate& lobe, const glm::vec4* registers, BsdfLobe& out);

} // namespace patina
