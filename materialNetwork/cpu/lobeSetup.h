// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/cpu/programCode.h"

namespace patina {

/// Computes the lobe from its parameters.
/// @param surroundingIor see ShadingPoint; only dielectrics have an ior that it divides
void setupLobe(const LobeTemplate& lobe, const glm::vec4* registers, BsdfLobe& out,
               float surroundingIor = 1.0f);

} // namespace patina
