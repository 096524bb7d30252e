// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace patina {

/// Samples of all pixels that are blurred alike, or share photons or light. What a block shares
/// depends on its index and the seed alone, so that parts and resumed renders agree to the bit.
struct SampleBlock {
    static constexpr int samples = 16;

    /// How far light is blurred, over the first block. It shrinks such that noise and blur both go
    /// to zero (Knaus and Zwicker 2011).
    static float radius(int block) { return std::pow(float(block + 1), -1.0f / 6.0f); }
};

} // namespace patina
