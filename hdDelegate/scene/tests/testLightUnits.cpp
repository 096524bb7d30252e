// SPDX-License-Identifier: Apache-2.0
// The units of lights against the formulas of the UsdLux documentation.

#include "hdDelegate/scene/lightUnits.h"
#include "hdDelegate/scene/tests/prims.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace patina;

namespace {
constexpr double pi = 3.14159265358979323846;
}

TEST(LightUnits, intensityExposureAndColour) {
    Light light;
    light.intensity = 3.0f;
    light.exposure = 2.0f;
    light.color = vec3(1.0f, 0.5f, 0.25f);
    EXPECT_EQ(lightRadiance(light, mat4(1.0f)), vec3(12.0f, 6.0f, 3.0f));
    light.colorTemperature = 3000.0f; // counts only when it is enabled
    EXPECT_EQ(lightRadiance(light, mat4(1.0f)), vec3(12.0f, 6.0f, 3.0f));
    light.enableColorTemperature = true;
    EXPECT_NE(lightRadiance(light, mat4(1.0f)), vec3(12.0f, 6.0f, 3.0f));
}

TEST(LightUnits, blackbodyMatchesUsdLux) {
    // Values of UsdLux.BlackbodyTemperatureAsRgb, at knots and between them.
    const struct {
        float kelvin;
        vec3 rgb;
    } cases[] = {{1000.0f, vec3(4.305504f, 0.118358f, 0.0f)},
                 {1250.0f, vec3(3.688244f, 0.302033f, 0.0f)},
                 {2700.0f, vec3(1.935324f, 0.803566f, 0.191690f)},
                 {3200.0f, vec3(1.679905f, 0.865969f, 0.325642f)},
                 {5600.0f, vec3(1.132336f, 0.972695f, 0.880806f)},
                 {6500.0f, vec3(1.043333f, 0.983624f, 1.034613f)},
                 {7777.0f, vec3(0.958579f, 0.991070f, 1.210425f)},
                 {10000.0f, vec3(0.871841f, 0.994688f, 1.429996f)},
                 {500.0f, vec3(4.305504f, 0.118358f, 0.0f)},
                 {20000.0f, vec3(0.871841f, 0.994688f, 1.429996f)}};
    for (const auto& c : cases)
        EXPECT_LT(glm::length(blackbodyColor(c.kelvin) - c.rgb), 2e-5f) << c.kelvin;
    EXPECT_EQ(blackbodyColor(std::numeric_limits<float>::quiet_NaN()), blackbodyColor(6500.0f));
}

TEST(LightUnits, sizeFactors) {
    Light light;
    light.radius = 2.0f;
    light.width = 3.0f;
    light.height = 4.0f;
    light.length = 5.0f;
    const auto factor = [&](LightType type, const mat4& m = mat4(1.0f)) {
        light.type = type;
        return lightSizeFactor(light, m);
    };
    EXPECT_NEAR(factor(LightType::Sphere), 16.0 * pi, 1e-4);
    EXPECT_NEAR(factor(LightType::Disk), 4.0 * pi, 1e-5);
    EXPECT_NEAR(factor(LightType::Rect), 12.0, 1e-6);
    EXPECT_NEAR(factor(LightType::Cylinder), 20.0 * pi, 1e-4);
    EXPECT_EQ(factor(LightType::Dome), 1.0);
    const mat4 scale = glm::scale(mat4(1.0f), vec3(2.0f, 3.0f, 0.5f));
    EXPECT_NEAR(factor(LightType::Rect, scale), 72.0, 1e-4);
    EXPECT_NEAR(factor(LightType::Disk, scale), 24.0 * pi, 1e-4);
    // Cylinder: the ellipse of half axes 6 and 1 has perimeter 24.1817... times length 10.
    const double a = 6.0, b = 1.0, h = std::pow((a - b) / (a + b), 2.0);
    const double series = pi * (a + b) *
                          (1.0 + h / 4.0 + h * h / 64.0 + h * h * h / 256.0 +
                           25.0 * std::pow(h, 4.0) / 16384.0 + 49.0 * std::pow(h, 5.0) / 65536.0);
    EXPECT_NEAR(factor(LightType::Cylinder, scale) / (10.0 * series), 1.0, 1e-3);
    // A prolate spheroid of half axes 2, 2 and 6.
    const mat4 longer = glm::scale(mat4(1.0f), vec3(1.0f, 1.0f, 3.0f));
    const double e = std::sqrt(1.0 - 4.0 / 36.0);
    EXPECT_NEAR(factor(LightType::Sphere, longer), 2.0 * pi * 4.0 * (1.0 + 3.0 / e * std::asin(e)),
                0.02);
}

TEST(LightUnits, distantSizeFactor) {
    Light light;
    light.type = LightType::Distant;
    const auto factor = [&](float angle) {
        light.angle = angle;
        return lightSizeFactor(light, mat4(1.0f));
    };
    EXPECT_EQ(factor(0.0f), 1.0);
    EXPECT_NEAR(factor(0.53f), pi * std::pow(std::sin(0.265 * pi / 180.0), 2.0), 1e-10);
    EXPECT_NEAR(factor(180.0f), pi, 1e-6);
    EXPECT_NEAR(factor(360.0f), 2.0 * pi, 1e-6);
}

TEST(LightUnits, normalizeKeepsThePower) {
    for (const LightType type :
         {LightType::Sphere, LightType::Disk, LightType::Rect, LightType::Cylinder})
        for (const float scale : {0.01f, 1.0f, 7.0f}) {
            Light light;
            light.type = type;
            light.intensity = 5.0f;
            light.normalize = true;
            const mat4 m = scaled(scale);
            EXPECT_NEAR(lightRadiance(light, m).x * lightSizeFactor(light, m), 5.0, 1e-4);
        }
}

TEST(LightUnits, transformsAreInterpolated) {
    MotionTransform motion;
    motion.times = {0.0f, 2.0f};
    motion.values = {mat4(1.0f), translate(4.0f, 0.0f, 0.0f)};
    EXPECT_FLOAT_EQ(transformAt(motion, 0.5f)[3].x, 1.0f);
    EXPECT_FLOAT_EQ(transformAt(motion, 9.0f)[3].x, 4.0f);
}
