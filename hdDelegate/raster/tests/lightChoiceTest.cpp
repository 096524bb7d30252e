#include "hdDelegate/raster/lightChoice.h"

#include <gtest/gtest.h>

#include <numeric>

namespace {

using patina::chooseLights;

TEST(LightChoice, takesAllWhereThereIsRoom) {
    const auto chosen = chooseLights({1.0f, 0.0f, 3.0f}, 3, 0.7f);
    ASSERT_EQ(chosen.size(), 3u);
    for (size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(chosen[i].index, i);
        EXPECT_EQ(chosen[i].share, 1.0f);
    }
}

TEST(LightChoice, countsEveryLightOnceInTheMean) {
    // Strong lights are sure, the weak share the rest; u runs over an even grid, so that the mean
    // is the expectation up to the grid's step.
    std::vector<float> weights = {100.0f, 50.0f};
    for (int i = 0; i < 40; ++i)
        weights.push_back(0.1f + 0.05f * float(i));
    const int steps = 20000;
    std::vector<double> mean(weights.size(), 0.0);
    for (int k = 0; k < steps; ++k) {
        const auto chosen = chooseLights(weights, 7, (float(k) + 0.5f) / float(steps));
        EXPECT_LE(chosen.size(), 7u);
        for (const auto& c : chosen)
            mean[c.index] += double(c.share) / steps;
    }
    for (double m : mean)
        EXPECT_NEAR(m, 1.0, 0.02);
    const auto chosen = chooseLights(weights, 7, 0.1f);
    EXPECT_EQ(chosen[0].share, 1.0f);
    EXPECT_EQ(chosen[1].share, 1.0f);
}

TEST(LightChoice, survivesWeightsThatSumToNothing) {
    EXPECT_TRUE(chooseLights({0.0f, 0.0f, 0.0f}, 1, 0.5f).empty());
    EXPECT_TRUE(chooseLights({1.0f, 2.0f}, 0, 0.5f).empty());
}

} // namespace
