// SPDX-License-Identifier: Apache-2.0
// The float samplers draw from the density that the double instance states: chi-squared tests over
// the sphere. Significance 0.01 for the whole suite (Sidak over all runs), at a fixed seed. Delta
// parts are left out here; LobeDegenerate tests them.
//
// One histogram of 120000 samples finds more than two out of three of 100000 would. The statistic
// of many cells is near normal, with a mean that grows with the number of samples: where 100000
// reject with a chance of 0.5, 0.9 and 0.99, two out of three do with 0.5, 0.97 and 0.9997, and
// 120000 with 0.80, 0.99 and 0.9999 (threshold at 4.1 deviations).

#include <gtest/gtest.h>

#include "shaders/tests/chiSquared.h"
#include "shaders/tests/pearson.h"

using namespace patina;
using namespace patina::test;

namespace {

constexpr int sampleCount = 120000;
constexpr std::uint64_t seed = 11;

} // namespace

TEST(ChiSquared, TailHasTextbookValues) {
    EXPECT_NEAR(chiSquaredTail(3.841458820694124, 1), 0.05, 1e-9);
    EXPECT_NEAR(chiSquaredTail(18.307038053275146, 10), 0.05, 1e-9);
    EXPECT_NEAR(chiSquaredTail(134.64161627853573, 100), 0.012, 1e-3);
    EXPECT_NEAR(chiSquaredTail(10.0, 100), 1.0, 1e-9);
}

TEST(ChiSquared, RejectsAWrongSampler) {
    const LobeCase right =
        PATINA_LOBE_CASE("a", conductor, vec3(1.0), vec3(1.0), vec2(0.3), false, 0);
    const LobeCase wrong =
        PATINA_LOBE_CASE("b", conductor, vec3(1.0), vec3(1.0), vec2(0.31), false, 0);
    const vec3 wo = direction(0.7, 0.3);
    const DensityGrid grid(right.f64, wo);
    EXPECT_LT(grid.test(wrong.f32, wo, sampleCount, 1).pValue, 1e-6);
    EXPECT_GT(grid.test(right.f32, wo, sampleCount, 1).pValue, 1e-3);
}

TEST(LobeSampling, DrawsFromItsPdf) {
    const std::vector<LobeCase> cases = lobeCases(0);
    int runs = 0;
    for (const LobeCase& c : cases)
        runs += int(outgoing(c).size());
    const double significance = 1.0 - std::pow(1.0 - 0.01, 1.0 / runs);
    for (const LobeCase& c : cases) {
        // Narrower lobes fit into a few cells: the half vector density is the same code.
        if (c.alpha < 0.02) continue;
        for (vec3 wo : outgoing(c)) {
            const DensityGrid grid(c.f64, wo);
            const ChiSquared t = grid.test(c.f32, wo, sampleCount, seed);
            EXPECT_FALSE(t.stray) << c.name << " wo.z " << wo.z;
            EXPECT_LT(t.expected, 1.0 + 2e-3) << c.name << " wo.z " << wo.z;
            // Samples that find a direction are as many as the density says: 5 sigma.
            const double p = std::min(t.expected, 1.0);
            const double sigma = std::sqrt(p * (1.0 - p) / sampleCount);
            EXPECT_NEAR(t.hits, t.expected, 5.0 * sigma + 2e-3) << c.name << " wo.z " << wo.z;
            EXPECT_GE(t.pValue, significance) << c.name << " wo.z " << wo.z;
        }
    }
}
