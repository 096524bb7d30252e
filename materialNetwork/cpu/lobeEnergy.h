// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/cpu/bsdf.h"
#include "materialNetwork/ir/energyCurve.h"

namespace patina {

/// The values of an EnergyCurve, by the lobe's own method. For dielectric, Schlick and conductor
/// lobes.
EnergyCurve::Energy lobeEnergy(const BsdfLobe& lobe, const glm::vec3& wo);

} // namespace patina
