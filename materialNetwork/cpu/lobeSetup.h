// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/cpu/programCode.h"
#include "materialNetwork/shadingPoint.h"

namespace patina {

/// Computes a lobe from its parameters.
/// @param surroundingIor,leastRoughness see ShadingPoint
void setupLobe(const LobeTemplate& lobe, const glm::vec4* registers, BsdfLobe& out,
               float surroundingIor = 1.0f, float leastRoughness = 0.0f);

/// The lobe of a program at a point.
/// @returns whether it is as the program keeps it, so that LobeTemplate::energy holds
bool setupLobeAt(const ProgramCode& code, size_t index, const glm::vec4* registers,
                 const ShadingPoint& point, BsdfLobe& out);

} // namespace patina
