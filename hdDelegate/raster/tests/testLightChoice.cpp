// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/samples/lightChoice.h"
#include "hdDelegate/raster/samples/lightSampler.h"
#include "hdDelegate/raster/tests/rasterFixture.h"
#include "hdDelegate/scene/tests/prims.h"

namespace {

using namespace patina;

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

TEST(LightChoice, smallImagesTakeMoreLightsByCoarserMaps) {
    PATINA_NEED_CONTEXT();
    SceneState state;
    for (int i = 0; i < 100; ++i) {
        auto light = makeLight("/light" + std::to_string(i), LightType::Sphere);
        light->radius = 0.1f;
        state.lights.set(light->path, light);
    }
    const RenderSettings settings;
    Diagnostics diagnostics;
    RasterInstances places(std::make_shared<Placements>(state, settings, diagnostics), 0.0f);
    LightImages images(diagnostics);
    RasterDomes domes;
    const RasterLights lights(state, settings, places, 0.0f, 4, {"sampled"}, images, domes,
                              LinkNames(state), diagnostics);
    ShadowBounds bounds;
    bounds.sceneMin = bounds.receiverMin = vec3(-1.0f);
    bounds.sceneMax = bounds.receiverMax = vec3(1.0f);
    const auto large = LightSampler(lights, {}, bounds, 1024, 1280, 0).sample();
    EXPECT_EQ(large.shadows.mapSize, 512);
    EXPECT_EQ(large.shadows.views.size(), 126u); // six of 21 lights
    EXPECT_EQ(large.taken, 21);
    const auto small = LightSampler(lights, {}, bounds, 1024, 96, 0).sample();
    EXPECT_EQ(small.shadows.mapSize, 256);
    EXPECT_EQ(small.shadows.views.size(), 510u);
    EXPECT_EQ(small.taken, 85);
}

} // namespace
