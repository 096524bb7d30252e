// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/cpu/medium.h"
#include "materialNetwork/cpu/programCode.h"

namespace patina {

/// Fills a medium from the registers of a program. The tree is a sum of leaves: weights go down
/// from the root, and every leaf adds what it absorbs and scatters.
Medium buildMedium(const std::vector<ClosureOp>& vdf, const glm::vec4* registers);

} // namespace patina
