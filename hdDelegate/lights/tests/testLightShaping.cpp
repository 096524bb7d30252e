// SPDX-License-Identifier: Apache-2.0
// Focus, cone and IES against spot values of the documented formulas.

#include "hdDelegate/lights/lightShaping.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

using namespace patina;

namespace {

/// A direction at an angle off the axis -z, about it by phi from +x.
vec3 off(float degrees, float phi = 0.3f) {
    const float t = degrees * pi / 180.0f;
    return vec3(std::sin(t) * std::cos(phi), std::sin(t) * std::sin(phi), -std::cos(t));
}

std::string iesText(const std::string& horizontal, const std::string& vertical,
                    const std::string& candela, int h, int v, const std::string& tilt = "NONE",
                    int type = 1) {
    std::ostringstream out;
    out << "IESNA:LM-63-2002\r\n[TEST] synthetic\r\nTILT=" << tilt << "\r\n";
    if (tilt == "INCLUDE") out << "1\r\n3\r\n0 45 90\r\n1 1 1\r\n";
    out << "1 1000 2.0 " << v << ' ' << h << ' ' << type << " 2 0 0 0\r\n0.5 1.0 100\r\n"
        << vertical << "\r\n"
        << horizontal << "\r\n"
        << candela << "\r\n";
    return out.str();
}

/// A profile that is taken.
std::shared_ptr<IesProfile> profileOf(const std::string& horizontal, const std::string& vertical,
                                      const std::string& candela, int h, int v,
                                      const std::string& tilt = "NONE") {
    auto profile = std::make_shared<IesProfile>();
    std::string error;
    EXPECT_TRUE(profile->parse(iesText(horizontal, vertical, candela, h, v, tilt), error)) << error;
    return profile;
}

LightShaping shapingOf(const Light& light, std::shared_ptr<const IesProfile> profile = nullptr) {
    return LightShaping(light, mat4(1.0f), profile);
}

Light coneOf(float angle, float softness = 0.0f) {
    Light light;
    light.shapingConeAuthored = true;
    light.shapingConeAngle = angle;
    light.shapingConeSoftness = softness;
    return light;
}

} // namespace

TEST(Shaping, plainLightsAreNotShaped) {
    Light light;
    light.shapingConeAngle = 20.0f; // the API is not applied
    const LightShaping shaping = shapingOf(light);
    EXPECT_FALSE(shaping.active());
    EXPECT_EQ(shaping.factor(off(150.0f)), vec3(1.0f));
}

TEST(Shaping, cones) {
    const LightShaping hard = shapingOf(coneOf(30.0f));
    EXPECT_EQ(hard.factor(off(29.9f)), vec3(1.0f));
    EXPECT_EQ(hard.factor(off(30.1f)), vec3(0.0f));
    EXPECT_NEAR(hard.cutoff(), pi / 6.0f, 1e-6f);
    const LightShaping soft = shapingOf(coneOf(40.0f, 0.5f)); // falls from 20 to 40 degrees
    EXPECT_NEAR(soft.factor(off(19.0f)).x, 1.0f, 1e-5f);
    EXPECT_NEAR(soft.factor(off(25.0f)).x, 1.0f - 0.15625f, 1e-4f);
    EXPECT_NEAR(soft.factor(off(30.0f)).x, 0.5f, 1e-4f);
    EXPECT_NEAR(soft.factor(off(35.0f)).x, 0.15625f, 1e-4f);
    EXPECT_EQ(soft.factor(off(40.1f)).x, 0.0f);
    const LightShaping softest = shapingOf(coneOf(40.0f, 7.0f)); // clamped: from the axis on
    EXPECT_NEAR(softest.factor(off(20.0f)).x, 0.5f, 1e-4f);
}

TEST(Shaping, focusAndTint) {
    Light light;
    light.shapingFocus = 3.0f;
    const LightShaping shaping = shapingOf(light);
    EXPECT_NEAR(shaping.factor(off(60.0f)).x, 0.125f, 1e-5f);
    EXPECT_NEAR(shaping.factor(off(120.0f)).x, 0.125f, 1e-5f); // |cos|
    light.shapingFocusTint = vec3(1.0f, 0.5f, 0.0f);
    const LightShaping tinted = shapingOf(light);
    const vec3 f = tinted.factor(off(60.0f));
    EXPECT_NEAR(f.x, 1.0f, 1e-5f);
    EXPECT_NEAR(f.y, 0.5f + 0.5f * 0.125f, 1e-5f);
    EXPECT_NEAR(f.z, 0.125f, 1e-5f);
    EXPECT_LT(glm::length(tinted.factor(off(0.0f)) - vec3(1.0f)), 1e-5f);
}

TEST(Shaping, axisFollowsTheTransform) {
    const mat4 m = glm::scale(glm::rotate(mat4(1.0f), pi / 2.0f, vec3(0.0f, 1.0f, 0.0f)),
                              vec3(1.0f, 1.0f, 5.0f));
    const LightShaping shaping(coneOf(10.0f), m, nullptr);
    EXPECT_EQ(shaping.factor(vec3(-1.0f, 0.0f, 0.0f)), vec3(1.0f));
    EXPECT_EQ(shaping.factor(vec3(0.0f, 0.0f, -1.0f)), vec3(0.0f));
}

TEST(Ies, axiallySymmetric) {
    // multiplier 2, ballast factor 0.5: candela as they stand
    const auto profile = profileOf("0", "0 45 90", "100 50 0", 1, 3);
    EXPECT_NEAR(profile->candela(0.0f, 1.0f), 100.0f, 1e-3f);
    EXPECT_NEAR(profile->candela(22.5f * pi / 180.0f, 4.0f), 75.0f, 1e-2f);
    EXPECT_NEAR(profile->candela(67.5f * pi / 180.0f, -2.0f), 25.0f, 1e-2f);
    EXPECT_EQ(profile->candela(2.0f, 0.0f), 0.0f);
    EXPECT_EQ(profile->peak(), 100.0f);
}

TEST(Ies, symmetries) {
    struct Value {
        float phi, candela, tolerance = 1e-3f; ///< degrees
    };
    const struct {
        const char *name, *horizontal, *candela;
        int count;
        std::vector<Value> values;
    } cases[] = {
        {"quadrant",
         "0 45 90",
         "1 1 2 2 3 3",
         3,
         {{90, 3}, {270, 3}, {-90, 3}, {45, 2}, {135, 2}, {225, 2}, {315, 2}, {180, 1}}},
        {"half", "0,90,180", "1 1 2 2 5 5", 3, {{270, 2}, {180, 5}, {225, 3.5f, 1e-2f}}},
        {"full", "0 90 180 270 360", "1 1 2 2 3 3 4 4 1 1", 5, {{270, 4}, {315, 2.5f, 1e-2f}}},
        {"turned", "90 180 270", "1 1 2 2 5 5", 3, {{90, 1}, {0, 2}, {315, 3.5f, 1e-2f}}}};
    for (const auto& c : cases) {
        const auto profile = profileOf(c.horizontal, "0 90", c.candela, c.count, 2);
        for (const Value& v : c.values)
            EXPECT_NEAR(profile->candela(pi / 4.0f, v.phi * pi / 180.0f), v.candela, v.tolerance)
                << c.name << " " << v.phi;
    }
}

TEST(Ies, powerAndNormalization) {
    const auto sphere = profileOf("0", "0 90 180", "7 7 7", 1, 3);
    EXPECT_NEAR(sphere->mean(), 7.0f, 1e-4f);
    EXPECT_NEAR(profileOf("0", "0 90", "7 7", 1, 2)->mean(), 7.0f, 1e-4f); // a hemisphere
    // The mean over the hemisphere of 1 - 2 t / pi is 1 - 2 / pi.
    EXPECT_NEAR(profileOf("0", "0 90", "1 0", 1, 2)->mean(), 1.0f - 2.0f / pi, 1e-4f);
    Light light;
    EXPECT_NEAR(shapingOf(light, sphere).factor(off(50.0f)).x, 7.0f, 1e-3f);
    light.iesNormalize = true;
    EXPECT_NEAR(shapingOf(light, sphere).factor(off(50.0f)).x, 1.0f, 1e-4f);
}

TEST(Ies, angleScale) {
    EXPECT_FLOAT_EQ(IesProfile::scaledTheta(1.0f, 0.0f), 1.0f);
    EXPECT_FLOAT_EQ(IesProfile::scaledTheta(1.0f, 2.0f), 0.5f);
    EXPECT_FLOAT_EQ(IesProfile::scaledTheta(2.0f, 0.5f), pi); // clamped
    EXPECT_FLOAT_EQ(IesProfile::scaledTheta(1.0f, -2.0f), (1.0f - pi) / 2.0f + pi);
    EXPECT_FLOAT_EQ(IesProfile::scaledTheta(1.0f, -0.5f), 0.0f); // clamped
}

TEST(Ies, tiltData) {
    EXPECT_NEAR(profileOf("0", "0 90", "4 4", 1, 2, "INCLUDE")->candela(0.5f, 0.0f), 4.0f, 1e-4f);
}

TEST(Ies, badFilesSayWhy) {
    const std::string bad[] = {"",
                               "not an IES file",
                               "TILT=NONE",
                               iesText("0", "0 90", "4", 1, 2),
                               iesText("0", "90 0", "4 4", 1, 2),
                               iesText("0", "0 90", "4 4", 1, 2, "NONE", 2),
                               iesText("0 77", "0 90", "1 1 1 1", 2, 2),
                               iesText("0", "0", "1", 1, 1),
                               "TILT=NONE\n1 1 1 99999999 99999999 1 1 0 0 0 1 1 1",
                               "TILT=NONE\n1 1 1 nan 1 1",
                               "TILT=NONE\n1 1 1 -3 1 1 1 0 0 0 1 1 1 0 0"};
    for (const std::string& text : bad) {
        IesProfile profile;
        std::string error;
        EXPECT_FALSE(profile.parse(text, error)) << text;
        EXPECT_FALSE(error.empty());
        EXPECT_TRUE(profile.empty());
        EXPECT_EQ(profile.candela(0.5f, 0.5f), 0.0f);
    }
    IesProfile profile;
    std::string error;
    EXPECT_FALSE(profile.load("/no/such/file.ies", error));
    EXPECT_FALSE(error.empty());
}
