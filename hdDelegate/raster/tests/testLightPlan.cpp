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

std::string domeMethod(const RasterLightPlan& lights, float roughness, double tolerance) {
    RenderSettings settings;
    settings.tolerance = tolerance;
    return lights.choose(microfacetPlan(roughness), settings, false).front().method;
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
    EXPECT_EQ(domeMethod(soft, 0.1f, 0.1), "prefiltered");
    EXPECT_EQ(domeMethod(sun, 0.3f, 0.1), "sampled");
}

TEST(LightPlan, largerTolerancesAreNeverSlower) {
    RasterLightPlan lights;
    const auto clouds = measure::MeasuredSky::soft();
    lights.addDome(&clouds.map);
    for (float roughness : {0.05f, 0.3f, 0.6f, 0.9f}) {
        double before = 1e30;
        for (double tolerance : {0.001, 0.01, 0.03, 0.1, 0.3}) {
            RenderSettings settings;
            settings.tolerance = tolerance;
            const PlannedMethod m =
                lights.choose(microfacetPlan(roughness), settings, false).front();
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
    RenderSettings settings;
    settings.tolerance = 0.3;
    EXPECT_EQ(lights.choose(microfacetPlan(0.1f), settings, true).front().method, "sampled");
    EXPECT_NE(lights.choose(microfacetPlan(0.1f), settings, false).front().method, "sampled");
    lights.needSamples();
    EXPECT_EQ(lights.choose(microfacetPlan(0.1f), settings, false).front().method, "sampled");
}

} // namespace patina
