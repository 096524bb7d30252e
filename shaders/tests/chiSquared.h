// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "shaders/tests/lobeCase.h"

namespace patina::test {

/// Outcome of one histogram against the density that it should follow.
struct ChiSquared {
    double pValue = 1.0; ///< chance of a histogram at least as far off
    int cells = 0;       ///< cells after pooling
    double expected = 0; ///< integral of the density over the sphere
    double hits = 0;     ///< share of samples that found a non-delta direction
    bool stray = false;  ///< samples where the density is 0
};

/// Density of `lobe` at `wo`, integrated over the cells of a (cos theta, phi) grid on the sphere.
class DensityGrid {
public:
    static constexpr int rowCount = 31;
    static constexpr int columnCount = 40;

    DensityGrid(const BoundLobe& lobe, vec3 wo);

    /// Draws `count` directions from `sampler` and compares.
    ChiSquared test(const BoundLobe& sampler, vec3 wo, int count, std::uint64_t seed) const;

private:
    double _cells[rowCount * columnCount];
    double _total = 0.0;
};

} // namespace patina::test
