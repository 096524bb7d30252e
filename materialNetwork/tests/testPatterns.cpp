// SPDX-License-Identifier: Apache-2.0
// Colour, shape and matrix nodes against closed forms.
#include "materialNetwork/tests/patternFixture.h"

using namespace patina;

TEST(Patterns, ColorAdjustments) {
    expectFolded("ND_contrast_float", {{"in", {0.8f}}, {"amount", {2}}, {"pivot", {0.5f}}}, {1.1f});
    expectFolded("ND_range_float",
                 {{"in", {0.35f}},
                  {"inlow", {0.1f}},
                  {"inhigh", {1.1f}},
                  {"gamma", {2}},
                  {"outlow", {1}},
                  {"outhigh", {3}}},
                 {2.0f}); // 0.25^(1/2) = 0.5
    expectFolded("ND_range_float", {{"in", {4}}, {"doclamp", {1}}}, {1.0f});
    expectFolded("ND_safepower_float", {{"in1", {-8}}, {"in2", {1.0f / 3.0f}}}, {-2.0f});
    expectFolded("ND_saturate_color3",
                 {{"in", {1, 0, 0}}, {"amount", {0.5f}}, {"lumacoeffs", {0.2f, 0.7f, 0.1f}}},
                 {0.6f, 0.1f, 0.1f});
    expectFolded("ND_hsvadjust_color3", {{"in", {1, 0, 0}}, {"amount", {1 / 3.0f, 1, 0.5f}}},
                 {0, 0.5f, 0});
    expectFolded("ND_luminance_color3", {{"in", {1, 1, 1}}}, {1, 1, 1}, 1e-6f);
    // Exposure 1 doubles, gain 0.5 halves; lift 0.5 pulls black up.
    expectFolded("ND_colorcorrect_color3",
                 {{"in", {0.2f, 0.4f, 0}}, {"exposure", {1}}, {"gain", {0.5f}}, {"lift", {0.5f}}},
                 {0.6f, 0.7f, 0.5f});
}

TEST(Patterns, Compositing) {
    const Numbers f = {0.2f, 0.4f, 0.6f, 0.7f}, b = {0.3f, 0.1f, 0.5f, 0.8f};
    const auto blend = [&](const std::string& category, float mix, const Numbers& expected) {
        expectFolded("ND_" + category + "_color4", {{"fg", f}, {"bg", b}, {"mix", {mix}}},
                     expected);
    };
    blend("over", 1, {0.29f, 0.43f, 0.75f, 0.94f});
    blend("in", 1, {0.16f, 0.32f, 0.48f, 0.56f});
    blend("out", 1, {0.04f, 0.08f, 0.12f, 0.14f});
    blend("mask", 1, {0.21f, 0.07f, 0.35f, 0.56f});
    blend("matte", 1, {0.23f, 0.31f, 0.57f, 0.94f});
    // Together more than 1: what is behind shows through what is left.
    blend("disjointover", 1,
          {0.2f + 0.3f * 0.375f, 0.4f + 0.1f * 0.375f, 0.6f + 0.5f * 0.375f, 1.0f});
    for (const char* category : {"over", "plus", "screen"})
        blend(category, 0, b);
    blend("plus", 0.5f, {0.4f, 0.3f, 0.8f, 1.15f});
    blend("minus", 1, {0.1f, -0.3f, -0.1f, 0.1f});
    blend("difference", 1, {0.1f, 0.3f, 0.1f, 0.1f});
    blend("screen", 1, {0.44f, 0.46f, 0.8f, 0.94f});
    blend("overlay", 1, {0.12f, 0.08f, 0.6f, 0.88f});
    const auto one = [](const char* id, float fg, float bg) {
        return folded(id, {{"fg", {fg}}, {"bg", {bg}}, {"mix", {0.5f}}});
    };
    expectNumbers(one("ND_burn_float", 0.6f, 0.3f), {0.06666669f});
    expectNumbers(one("ND_dodge_float", 0.6f, 0.3f), {0.525f});
    expectNumbers(one("ND_burn_float", 0.0f, 0.3f), {0.0f});
    expectNumbers(one("ND_dodge_float", 1.0f, 0.3f), {0.0f});
    expectFolded("ND_unpremult_color4", {{"in", {0.2f, 0.4f, 0.6f, 0.5f}}},
                 {0.4f, 0.8f, 1.2f, 0.5f});
    expectFolded("ND_unpremult_color4", {{"in", {0.2f, 0.4f, 0.6f, 0}}}, {0, 0, 0, 0});
    expectFolded("ND_inside_float", {{"in", {0.5f}}, {"mask", {0.2f}}}, {0.1f});
    expectFolded("ND_outside_float", {{"in", {0.5f}}, {"mask", {0.2f}}}, {0.4f});
}

TEST(Patterns, Shapes) {
    const auto inside = [](const char* id, float u, float v) {
        return folded(id, {{"texcoord", {u, v}}, {"center", {0.5f, 0.5f}}, {"radius", {0.2f}}})[0];
    };
    EXPECT_EQ(inside("ND_circle_float", 0.5f, 0.69f), 1.0f);
    EXPECT_EQ(inside("ND_circle_float", 0.65f, 0.65f), 0.0f);
    // Sides at +-0.2 in u, corners at +-0.2 * 2/sqrt(3) in v.
    EXPECT_EQ(inside("ND_hexagon_float", 0.69f, 0.5f), 1.0f);
    EXPECT_EQ(inside("ND_hexagon_float", 0.71f, 0.5f), 0.0f);
    EXPECT_EQ(inside("ND_hexagon_float", 0.5f, 0.725f), 1.0f);
    EXPECT_EQ(inside("ND_hexagon_float", 0.5f, 0.735f), 0.0f);
    // Leaves lie on the axes at half the radius.
    EXPECT_EQ(inside("ND_cloverleaf_float", 0.5f, 0.69f), 1.0f);
    EXPECT_EQ(inside("ND_cloverleaf_float", 0.59f, 0.59f), 1.0f);
    EXPECT_EQ(inside("ND_cloverleaf_float", 0.66f, 0.66f), 0.0f);
    const auto line = [](float u, float v) {
        return folded("ND_line_float", {{"texcoord", {u, v}},
                                        {"radius", {0.1f}},
                                        {"point1", {0.2f, 0.5f}},
                                        {"point2", {0.8f, 0.5f}}})[0];
    };
    EXPECT_EQ(line(0.5f, 0.59f), 1.0f);
    EXPECT_EQ(line(0.5f, 0.61f), 0.0f);
    EXPECT_EQ(line(0.87f, 0.5f), 1.0f);
    EXPECT_EQ(line(0.87f, 0.59f), 0.0f);
    const auto checker = [](float u, float v) {
        return folded("ND_checkerboard_color3", {{"texcoord", {u, v}}, {"uvtiling", {2, 2}}})[0];
    };
    EXPECT_EQ(checker(0.1f, 0.1f), checker(0.6f, 0.6f));
    EXPECT_NE(checker(0.1f, 0.1f), checker(0.6f, 0.1f));
    EXPECT_EQ(checker(-0.1f, 0.1f), checker(0.6f, 0.1f));
    const auto grid = [](float u, float v, float staggered) {
        return folded("ND_grid_color3",
                      {{"texcoord", {u, v}}, {"thickness", {0.2f}}, {"staggered", {staggered}}})[0];
    };
    EXPECT_NE(grid(0.5f, 0.5f, 0), grid(0.95f, 0.5f, 0));
    EXPECT_EQ(grid(0.5f, 1.5f, 0), grid(0.5f, 0.5f, 0));
    EXPECT_NE(grid(0.5f, 1.5f, 1), grid(0.5f, 0.5f, 1));
}

TEST(Patterns, RampsAndSplits) {
    const Numbers uv = {0.25f, 0.75f};
    expectFolded("ND_ramplr_float", {{"valuel", {1}}, {"valuer", {3}}, {"texcoord", uv}}, {1.5f});
    expectFolded("ND_ramptb_float", {{"valuet", {1}}, {"valueb", {3}}, {"texcoord", uv}}, {1.5f});
    expectFolded(
        "ND_ramp4_float",
        {{"valuetl", {1}}, {"valuetr", {2}}, {"valuebl", {3}}, {"valuebr", {4}}, {"texcoord", uv}},
        {0.75f * 1.25f + 0.25f * 3.25f});
    expectFolded("ND_splitlr_float", {{"valuel", {1}}, {"valuer", {3}}, {"texcoord", uv}}, {1});
    expectFolded("ND_splittb_float", {{"valuet", {1}}, {"valueb", {3}}, {"texcoord", uv}}, {1});
    const auto ramp = [](float u, float type, float interpolation, float count) {
        return folded("ND_ramp", {{"texcoord", {u, 0.5f}},
                                  {"type", {type}},
                                  {"interpolation", {interpolation}},
                                  {"num_intervals", {count}},
                                  {"interval1", {0.2f}},
                                  {"color1", {1, 0, 0, 1}},
                                  {"interval2", {0.6f}},
                                  {"color2", {0, 1, 0, 1}},
                                  {"interval3", {0.8f}},
                                  {"color3", {0, 0, 1, 1}}});
    };
    expectNumbers(ramp(0.1f, 0, 0, 3), {1, 0, 0, 1});
    expectNumbers(ramp(0.3f, 0, 0, 3), {0.75f, 0.25f, 0, 1});
    expectNumbers(ramp(0.3f, 0, 1, 3), {1 - 0.15625f, 0.15625f, 0, 1}); // smoothstep(0.25)
    expectNumbers(ramp(0.3f, 0, 2, 3), {1, 0, 0, 1});
    expectNumbers(ramp(0.7f, 0, 0, 3), {0, 0.5f, 0.5f, 1}, 1e-5f);
    expectNumbers(ramp(0.9f, 0, 0, 3), {0, 0, 1, 1});
    expectNumbers(ramp(0.9f, 0, 0, 2), {0, 1, 0, 1});        // the third stop is not in use
    expectNumbers(ramp(0.8f, 3, 0, 3), {0, 1, 0, 1}, 1e-5f); // a square's distance of 0.6
}

TEST(Patterns, Matrices) {
    const Numbers m = {2, 0, 0, 0, 3, 0, 5, 7, 1}; // scales, then moves by (5, 7)
    expectFolded("ND_transformmatrix_vector2M3", {{"in", {1, 1}}, {"mat", m}}, {7, 10});
    expectFolded("ND_transformmatrix_vector3", {{"in", {1, 1, 1}}, {"mat", m}}, {7, 10, 1});
    expectFolded("ND_determinant_matrix33", {{"in", m}}, {6});
    expectFolded("ND_transpose_matrix33", {{"in", m}}, {2, 0, 5, 0, 3, 7, 0, 0, 1});
    expectFolded("ND_invertmatrix_matrix33", {{"in", m}},
                 {0.5f, 0, 0, 0, 1 / 3.0f, 0, -2.5f, -7 / 3.0f, 1});
    expectFolded("ND_multiply_matrix33", {{"in1", {1, 2, 3, 4, 5, 6, 7, 8, 9}}, {"in2", m}},
                 {17, 27, 3, 38, 57, 6, 59, 87, 9});
    expectFolded("ND_divide_matrix33", {{"in1", m}, {"in2", m}}, {1, 0, 0, 0, 1, 0, 0, 0, 1});
    expectFolded("ND_add_matrix33FA", {{"in1", m}, {"in2", {1}}}, {3, 1, 1, 1, 4, 1, 6, 8, 2});
    expectFolded("ND_extract_matrix33", {{"in", m}, {"index", {2}}}, {5, 7, 1});
    expectFolded("ND_creatematrix_vector3_matrix44", {{"in4", {1, 2, 3}}},
                 {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 2, 3, 1});
    expectFolded("ND_ifgreater_matrix33", {{"value1", {0}}, {"in2", m}}, m);
    expectFolded("ND_switch_matrix33", {{"which", {2}}, {"in3", m}}, m);
    // No inverse: nothing explodes.
    expectFolded("ND_invertmatrix_matrix44", {{"in", Numbers(16, 1.0f)}},
                 {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
}

TEST(Patterns, ChoicesAndWaves) {
    expectFolded("ND_ifgreater_boolean", {{"value1", {2}}, {"value2", {1}}}, {1});
    expectFolded("ND_ifequal_booleanI", {{"value1", {2}}, {"value2", {1}}}, {0});
    expectFolded("ND_switch_float", {{"which", {-3}}, {"in1", {5}}}, {5});
    expectFolded("ND_switch_float", {{"which", {10}}, {"in10", {5}}}, {0});
    for (const auto& [x, y] :
         {std::pair{0.25f, 0.25f}, {0.75f, 0.25f}, {-1.5f, 0.5f}, {2.0f, 0.0f}})
        expectFolded("ND_trianglewave_float", {{"in", {x}}}, {y});
    expectFolded("ND_maxcomponent_vector3", {{"in", {-3, -1, -2}}}, {-1});
    expectFolded("ND_mincomponent_vector4", {{"in", {3, 1, 2, 0}}}, {0});
    // Rows times matrices: a quarter turn about z takes x to -y.
    expectFolded("ND_rotate3d_vector3", {{"in", {1, 0, 0}}, {"amount", {90}}, {"axis", {0, 0, 2}}},
                 {0, -1, 0});
    expectFolded("ND_reflect_vector3", {{"in", {1, -1, 0}}, {"normal", {0, 1, 0}}}, {1, 1, 0});
    // Snell: the sine of 30 degrees by 1.5.
    expectFolded("ND_refract_vector3",
                 {{"in", {0.5f, -0.8660254f, 0}}, {"normal", {0, 1, 0}}, {"ior", {1 / 1.5f}}},
                 {1 / 3.0f, -std::sqrt(8.0f) / 3.0f, 0});
    expectFolded("ND_refract_vector3",
                 {{"in", {0.8f, -0.6f, 0}}, {"normal", {0, 1, 0}}, {"ior", {1.5f}}}, {0, 0, 0});
    // At 6504 K the Planckian locus passes (0.3135, 0.3236); luminance is 1 everywhere.
    const Numbers white = folded("ND_blackbody", {{"temperature", {6504}}});
    expectNumbers(white, {1.0431f, 0.9837f, 1.0353f}, 5e-3f);
    for (const float t : {800.0f, 2000.0f, 10000.0f, 25000.0f}) {
        const Numbers c = folded("ND_blackbody", {{"temperature", {t}}});
        if (t >= 2000.0f) {
            EXPECT_NEAR(0.2126f * c[0] + 0.7152f * c[1] + 0.0722f * c[2], 1.0f, 2e-3f) << t;
        }
    }
}
