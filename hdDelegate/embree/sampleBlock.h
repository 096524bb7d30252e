// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace patina {

/// Samples of all pixels that share photons or light. What a block shares depends on its index and
/// the seed alone, so that parts and resumed renders agree to the bit.
struct SampleBlock {
    static constexpr int samples = 16;

    /// How far light is blurred, over the first block. It shrinks such that noise and blur both go
    /// to zero (Knaus and Zwicker 2011).
    static float radius(int block) {
        constexpr float alpha = 2.0f / 3.0f;
        float square = 1.0f;
        for (int k = 1; k <= block; ++k)
            square *= (float(k) + alpha) / (float(k) + 1.0f);
        return std::sqrt(square);
    }
};

} // namespace patina
