// SPDX-License-Identifier: Apache-2.0
// Colour values know the colour spaces that textures know.
#include "materialNetwork/tests/colorFixture.h"

#include "base/messages.h"
#include "materialNetwork/network/value.h"

namespace patina {

namespace {

/// A value as an input of colours reads it, or NaN where it is refused.
glm::vec3 linear(const std::string& space, glm::vec3 c, std::string& problem) {
    InputDef def;
    def.type = ValueType::Color3;
    Value value = color(c.x, c.y, c.z), out;
    value.colorSpace = space;
    std::optional<Message> found;
    const bool usable = coerceValue(value, def, out, found);
    problem = found ? found->text() : "";
    if (!usable) return glm::vec3(NAN);
    return {out.numbers[0], out.numbers[1], out.numbers[2]};
}

} // namespace

TEST(ColorValues, CurvesOfRec709AreTheClosedForms) {
    const glm::vec3 c(0.8f, 0.25f, 0.02f);
    const struct {
        double gamma; // 0: sRGB
        std::vector<const char*> names;
    } curves[] = {
        {0.0,
         {"srgb_texture", "srgb_rec709_scene", "sRGB", "srgb", "SRGB_Texture",
          "Utility - sRGB - Texture"}},
        {1.0,
         {"lin_rec709", "lin_rec709_scene", "lin_srgb", "linear", "data", "identity", "raw", "none",
          "unknown", "auto", "Auto", ""}},
        {1.8, {"g18_rec709", "g18_rec709_scene", "gamma18"}},
        {2.2, {"g22_rec709", "g22_rec709_scene", "gamma22"}},
        {2.4, {"rec709_display", "gamma24", "g24_rec709", "g24_rec709_scene"}},
    };
    for (const auto& curve : curves)
        for (const char* name : curve.names) {
            SCOPED_TRACE(name);
            glm::vec3 expected;
            for (int i = 0; i < 3; ++i)
                expected[i] = float(curve.gamma > 0.0 ? std::pow(double(c[i]), curve.gamma)
                                                      : srgbToLinear(c[i]));
            std::string problem;
            expectVector(linear(name, c, problem), expected, 1e-6f);
            EXPECT_EQ(problem, "");
        }
}

// The published matrices themselves are tested with ColorSpaces; white stays white in all but XYZ.
TEST(ColorValues, WideGamutsAreThoseOfTextures) {
    const glm::vec3 c(0.8f, 0.25f, 0.1f);
    for (const char* name :
         {"acescg", "lin_ap1", "lin_ap1_scene", "g22_ap1", "g22_ap1_scene", "srgb_ap1_scene",
          "lin_ap0_scene", "lin_displayp3", "lin_p3d65_scene", "srgb_displayp3", "srgb_p3d65_scene",
          "lin_rec2020", "lin_rec2020_scene", "lin_adobergb", "lin_adobergb_scene", "adobergb",
          "g22_adobergb_scene", "lin_ciexyzd65_scene"}) {
        SCOPED_TRACE(name);
        std::string problem;
        const glm::vec3 value = linear(name, c, problem);
        EXPECT_EQ(problem, "");
        const ColorTransformPtr transform = ColorSpaces::shared().toRec709(name);
        ASSERT_TRUE(transform);
        expectVector(value, converted(transform, c), 1e-6f);
        EXPECT_GT(glm::length(value - c), 0.01f) << "not converted";
        if (std::string(name) != "lin_ciexyzd65_scene")
            expectVector(linear(name, glm::vec3(1.0f), problem), glm::vec3(1.0f), 2e-5f);
    }
}

TEST(ColorValues, AnUnknownSpaceKeepsTheValueAndIsNamed) {
    std::string problem;
    const glm::vec3 c(0.8f, 0.25f, 0.1f);
    EXPECT_EQ(linear("camera log 7", c, problem), c);
    EXPECT_EQ(problem, "unknown colour space 'camera log 7'; the value is used as it is");

    Value red = color(0.9f, 0.1f, 0.1f);
    red.colorSpace = "camera log 7";
    for (const bool inModel : {true, false}) {
        const auto network = [&](const Value& value) {
            return inModel ? previewNetwork({{"diffuseColor", value}, {"ior", 1.0f}})
                           : lobeNetwork("ND_oren_nayar_diffuse_bsdf",
                                         {{"weight", 1.0f}, {"color", value}});
        };
        const Compiled c(network(red)), plain(network(color(0.9f, 0.1f, 0.1f)));
        EXPECT_TRUE(told(c, inModel ? "/m/surface [diffuseColor] unknown colour space"
                                    : "/m/bsdf [color] unknown colour space"));
        EXPECT_EQ(c.albedo(), plain.albedo());
    }
}

TEST(ColorValues, SpacesMayBeWrittenOut) {
    const glm::vec3 c(0.8f, 0.25f, 0.02f);
    std::string problem;
    // Rec.709 with sRGB's curve, and AP1, which is adapted from its own white.
    for (const auto& [numbers, name] :
         {std::pair("0.64 0.33 0.3 0.6 0.15 0.06 0.3127 0.329 2.4 0.055", "srgb_texture"),
          {"0.713 0.293 0.165 0.83 0.128 0.044 0.32168 0.33767 1 0", "lin_ap1_scene"}}) {
        SCOPED_TRACE(name);
        expectVector(linear(std::string("chromaticities(") + numbers + ")", c, problem),
                     linear(name, c, problem), 2e-6f);
    }
    EXPECT_EQ(problem, "");
    for (const char* numbers :
         {"", "0.64 0.33", "0.64 0.33 0.3 0.6 0.15 0.06 0.3127 0.329 2.4 x",
          "0.64 0.33 0.3 0.6 0.15 0.06 0.3127 0.329 0 0",
          "0.64 0.33 0.64 0.33 0.64 0.33 0.3 0.3 1 0", "0.64 0.33 0.3 0.6 0.15 0.06 0.3127 0 1 0",
          "nan 0 0 0 0 0 0 1 1 0"}) {
        const std::string name = std::string("chromaticities(") + numbers + ")";
        EXPECT_EQ(linear(name, c, problem), c) << name;
        EXPECT_NE(problem, "") << name;
    }
}

TEST(ColorValues, WhatACurveMakesInfiniteIsRefused) {
    std::string problem;
    EXPECT_TRUE(std::isnan(linear("g22_rec709", {1e30f, 0.0f, 0.0f}, problem).x));
    EXPECT_EQ(problem, messages::valueNotFinite().text());
}

} // namespace patina
