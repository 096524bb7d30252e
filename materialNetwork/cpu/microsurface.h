// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/cpu/bsdf.h"
#include "base/hashedNumbers.h"

namespace patina {

/// The choice point energyCompensation, method randomWalk: light bounces between the facets of a
/// Smith surface until it leaves (Heitz, Hanika, d'Eon and Dachsbacher 2016, "Multiple-Scattering
/// Microfacet BSDFs with the Smith Model"; GGX and Beckmann, uniform heights). Reflection and
/// transmission share one walk: each of these lobes is the light that leaves on its side.
///
/// The value has no formula. An evaluation gives a random one whose mean is right. The density is
/// an estimate that is never 0 where the value is not. It may weigh strategies against each other,
/// but must not divide.

/// @returns whether this lobe can be walked: an interface or a metal that is rough, and refracts
/// measurably where it transmits
bool canWalkMicrosurface(const BsdfLobe& lobe);

/// Single scattering exactly, and an estimate of the rest. Directions are in the lobe's frame.
sh::LobeEval microsurfaceEval(const BsdfLobe& lobe, const glm::vec3& wo, const glm::vec3& wi,
                              HashedNumbers& random);

/// @returns the density that microsurfaceEval() and microsurfaceSample() state; no random numbers
float microsurfaceDensity(const BsdfLobe& lobe, const glm::vec3& wo, const glm::vec3& wi);

/// Walks. The weight is the share of light that is left. Walks that leave on a side which the lobe
/// does not have give no sample.
/// @param u the first facet, and whether it reflects
sh::LobeSample microsurfaceSample(const BsdfLobe& lobe, const glm::vec3& wo, const glm::vec3& u,
                                  HashedNumbers& random);

} // namespace patina
