// SPDX-License-Identifier: Apache-2.0
// Colour spaces of textures, and of colour values, which know the same.
#include "materialNetwork/tests/colorFixture.h"

#include "base/messages.h"
#include "materialNetwork/network/value.h"

#include <cstdio>
#include <fstream>
#include <stdexcept>

#include <sys/stat.h>
#include <unistd.h>

using namespace patina;

namespace {

/// What an exception says; nothing where there is none.
template <class F> std::string thrown(const F& f) {
    try {
        f();
    } catch (const std::runtime_error& e) {
        return e.what();
    }
    return "";
}

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

TEST(ColorSpaces, SrgbIsTheClosedForm) {
    ColorSpaces spaces;
    ColorTransformPtr decode = spaces.toRec709("sRGB"), encode = spaces.fromRec709("sRGB");
    for (int i = 0; i <= 255; ++i) {
        double v = i / 255.0, linear = srgbToLinear(v);
        expectVector(converted(decode, glm::vec3(float(v))), glm::vec3(float(linear)), 1.2e-6f);
        expectVector(converted(encode, glm::vec3(float(linear))), glm::vec3(float(v)), 1.5e-5f);
    }
}

TEST(ColorSpaces, WideGamutsMapTheirPrimariesWherePublishedMatricesSay) {
    ColorSpaces spaces;
    // ACEScg to linear Rec.709 with Bradford, as the ACES reference implementation gives it
    expectVector(converted(spaces.toRec709("acescg"), {1, 0, 0}), {1.70505f, -0.13026f, -0.02400f},
                 2e-4f);
    expectVector(converted(spaces.toRec709("lin_ap1"), {0, 1, 0}), {-0.62179f, 1.14080f, -0.12897f},
                 2e-4f);
    expectVector(converted(spaces.toRec709("ACES2065-1"), {0, 0, 1}),
                 {-0.38756f, -0.09624f, 1.16835f}, 2e-4f);
    // Display P3 red, as CSS Color 4 tabulates it
    expectVector(converted(spaces.toRec709("lin_displayp3"), {1, 0, 0}),
                 {1.22494f, -0.04206f, -0.01964f}, 1e-4f);
    expectVector(converted(spaces.toRec709("lin_adobergb"), {1, 0, 0}), {1.39836f, 0, 0}, 1e-4f);
    expectVector(converted(spaces.toRec709("lin_rec2020"), {0, 1, 0}),
                 {-0.58764f, 1.13290f, -0.10058f}, 1e-4f);
    expectVector(converted(spaces.toRec709("lin_ciexyzd65"), {0.95046f, 1.0f, 1.08906f}), {1, 1, 1},
                 1e-4f);
}

TEST(ColorSpaces, WhiteStaysWhiteAndEveryWayIsAWayBack) {
    ColorSpaces spaces;
    for (const std::string& name : spaces.names()) {
        ColorTransformPtr to = spaces.toRec709(name), from = spaces.fromRec709(name);
        ASSERT_TRUE(to && from) << name;
        if (name != "lin_ciexyzd65") expectVector(converted(to, {1, 1, 1}), {1, 1, 1}, 2e-5f);
        expectVector(converted(from, converted(to, {0.2f, 0.5f, 0.8f})), {0.2f, 0.5f, 0.8f}, 2e-5f);
    }
}

// Other names are tested with ColorValues.
TEST(ColorSpaces, NamesOfDataChangeNothing) {
    const ColorSpaces spaces;
    for (const char* data : {"raw", "RAW", "none", "Non-Color", "data", "identity", "", "unknown",
                             "lin_rec709", "Linear Rec.709 (sRGB)"}) {
        ASSERT_TRUE(spaces.toRec709(data)) << data;
        EXPECT_TRUE(spaces.toRec709(data)->isIdentity()) << data;
    }
    EXPECT_FALSE(spaces.toRec709("no such space"));
}

TEST(ColorSpaces, TransformsLeaveWhatFollowsTheColour) {
    ColorSpaces spaces;
    float pixels[] = {0.5f, 0.5f, 0.5f, 0.25f, 9.0f, 0.5f, 0.5f, 0.5f, 0.75f, 7.0f};
    spaces.toRec709("sRGB")->apply(pixels, 2, 5);
    EXPECT_NEAR(pixels[0], srgbToLinear(0.5), 1e-6);
    EXPECT_NEAR(pixels[7], srgbToLinear(0.5), 1e-6);
    EXPECT_EQ(pixels[3], 0.25f);
    EXPECT_EQ(pixels[4], 9.0f);
    EXPECT_EQ(pixels[9], 7.0f);
}

TEST(ColorSpaces, DefaultDisplayIsSrgbWithoutToneCurve) {
    ColorSpaces spaces;
    ColorTransformPtr display = spaces.display();
    for (int i = 0; i <= 255; ++i) {
        double v = i / 255.0;
        expectVector(converted(display, glm::vec3(float(srgbToLinear(v)))), glm::vec3(float(v)),
                     1.5e-5f);
    }
    EXPECT_GT(converted(display, glm::vec3(4))[0], 1.5f);
    EXPECT_TRUE(spaces.display("sRGB", "Raw")->isIdentity());
    const std::string unknown = thrown([&] { spaces.display("Cinema"); });
    EXPECT_TRUE(has(unknown, "Cinema"));
    EXPECT_TRUE(has(unknown, "sRGB"));
    EXPECT_THROW(spaces.display("sRGB", "Filmic"), std::runtime_error);
}

TEST(ColorSpaces, AConfigurationOfTheUsersComesFirstAndIsBridged) {
    const std::string file = testing::TempDir() + "patinaConfig.ocio";
    // Its scene_linear is ACEScg; one space is its own, and "sRGB" is not defined by it at all.
    std::ofstream(file)
        << "ocio_profile_version: 2\n"
           "roles: {aces_interchange: AP0, scene_linear: Working, default: AP0}\n"
           "file_rules: [!<Rule> {name: Default, colorspace: AP0}]\n"
           "displays:\n  Mine:\n    - !<View> {name: Plain, colorspace: Working}\n"
           "colorspaces:\n"
           "  - !<ColorSpace> {name: AP0}\n"
           "  - !<ColorSpace>\n    name: Working\n"
           "    to_scene_reference: !<BuiltinTransform> {style: ACEScg_to_ACES2065-1}\n"
           "  - !<ColorSpace>\n    name: Twice\n"
           "    to_scene_reference: !<MatrixTransform> {matrix: [2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, "
           "0, 0, 0, 0, 1]}\n";
    ColorSpaces user(file), builtin;
    std::remove(file.c_str());
    ASSERT_TRUE(user.toRec709("Twice"));
    glm::vec3 c(0.2f, 0.4f, 0.6f);
    expectVector(converted(user.toRec709("Twice"), c),
                 2.0f * converted(builtin.toRec709("lin_ap0"), c), 1e-4f);
    expectVector(converted(user.toRec709("Working"), c), converted(builtin.toRec709("acescg"), c),
                 1e-4f);
    ASSERT_TRUE(user.toRec709("sRGB"));
    expectVector(converted(user.toRec709("sRGB"), c), converted(builtin.toRec709("sRGB"), c),
                 1e-6f);
    EXPECT_EQ(user.displays(), std::vector<std::string>{"Mine"});
    expectVector(converted(user.display(), c), converted(builtin.fromRec709("acescg"), c), 1e-4f);
}

TEST(ColorSpaces, AConfigurationIsARegularFileThatIsThere) {
    const std::string pipe = testing::TempDir() + "patinaConfigPipe";
    ::unlink(pipe.c_str());
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    for (const std::string& name : {pipe, std::string("/dev/zero"), std::string("/")})
        EXPECT_TRUE(has(thrown([&] { ColorSpaces spaces(name); }), "not a regular file")) << name;
    ::unlink(pipe.c_str());
    const std::string missing = "/no/such/config.ocio";
    EXPECT_TRUE(has(thrown([&] { ColorSpaces spaces(missing); }), missing));
}

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
