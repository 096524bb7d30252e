// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/embree/caustics/causticCasters.h"
#include "hdDelegate/embree/caustics/photonMap.h"

namespace patina {

/// Caustics that paths find while a block of samples is taken.
struct PhotonPass {
    static constexpr int samples = 16; ///< that share photons
    /// Width of a pixel's cone at the surface, in the first block.
    static constexpr float firstRadius = 2.0f;

    int block = 0;
    PhotonMap map;
    float radius = 0.0f; ///< in which photons count, over that width

    /// Shrinks such that noise and blur both go to zero (Knaus and Zwicker 2011).
    static float radiusOf(int block);
};

} // namespace patina
