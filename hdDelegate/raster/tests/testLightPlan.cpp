// SPDX-License-Identifier: Apache-2.0
// The planner's view of a sky, and of materials under lights.
#include "hdDelegate/raster/scene/rasterLightPlan.h"
#include "hdDelegate/raster/measure/measuredSky.h"
#include "materialNetwork/planner/planProbes.h"

#include <gtest/gtest.h>

namespace patina {

namespace {

MethodPlan microfacetPlan(float roughness) {
    ClosureContribution contribution;
    contribution.kind = "conductor";
    contribution.share = 1.0f;
    contribution.reflectance = 0.9f;
    contribution.roughness = roughness;
    auto places = std::make_shared<std::vector<std::vector<DirectionProbe>>>(1);
    for (float cosine : {0.125f, 0.375f, 0.625f, 0.875f})
        places->front().push_back({cosine, 0.9f, {contribution}});
    MethodPlan plan;
    plan.probes = places;
    return plan;
}

PlannedMethod chosen(const RasterLightPlan& lights, float roughness, double tolerance,
                     bool samples = false) {
    RenderSettings settings;
    settings.tolerance = tolerance;
    return lights.choose(microfacetPlan(roughness), settings, samples).front();
}

} // namespace

TEST(LightPlan, knowsTheSkiesThatRowsAreOf) {
    using measure::MeasuredSky;
    EXPECT_NEAR(peakShare(MeasuredSky::constant().map), RasterLightPlan::evenPeak, 1e-3);
    EXPECT_NEAR(peakShare(MeasuredSky::soft().map), RasterLightPlan::softPeak, 0.005);
    EXPECT_NEAR(peakShare(MeasuredSky::sun().map), RasterLightPlan::sunPeak, 0.02);
}

TEST(LightPlan, aSunIsLeftToSamples) {
    RasterLightPlan soft, sun;
    const auto clouds = measure::MeasuredSky::soft(), clear = measure::MeasuredSky::sun();
    soft.addDome(&clouds.map);
    sun.addDome(&clear.map);
    EXPECT_EQ(chosen(soft, 0.1f, 0.1).method, "prefiltered");
    EXPECT_EQ(chosen(sun, 0.3f, 0.1).method, "sampled");
}

TEST(LightPlan, largerTolerancesAreNeverSlower) {
    RasterLightPlan lights;
    const auto clouds = measure::MeasuredSky::soft();
    lights.addDome(&clouds.map);
    for (float roughness : {0.05f, 0.3f, 0.6f, 0.9f}) {
        double before = 1e30;
        for (double tolerance : {0.001, 0.01, 0.03, 0.1, 0.3}) {
            const PlannedMethod m = chosen(lights, roughness, tolerance);
            EXPECT_LE(m.ns, before);
            EXPECT_LE(m.ns, m.nsDefault);
            EXPECT_LE(m.error, 0.4 * tolerance);
            before = m.ns;
        }
    }
}

TEST(LightPlan, whatLooksAtSamplesKeepsThem) {
    RasterLightPlan lights;
    lights.addDome(nullptr);
    EXPECT_EQ(chosen(lights, 0.1f, 0.3, true).method, "sampled");
    EXPECT_NE(chosen(lights, 0.1f, 0.3).method, "sampled");
    lights.needSamples();
    EXPECT_EQ(chosen(lights, 0.1f, 0.3).method, "sampled");
}

} // namespace patina
