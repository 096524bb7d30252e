// SPDX-License-Identifier: Apache-2.0
// Noise. The expected numbers were computed with the shader functions of MaterialX 1.39.6
// (libraries/stdlib/genglsl), which define these nodes.
#include "materialNetwork/tests/patternFixture.h"

using namespace patina;

namespace {

const Numbers at2 = {1.3f, -2.7f};
const Numbers at3 = {1.3f, -2.7f, 4.9f};

Numbers amplitude(size_t n) {
    const Numbers all = {2, 3, 4, 5};
    return {all.begin(), all.begin() + long(n)};
}

struct Case {
    const char* id;
    Numbers expected;
};

/// Of nodes of the plane and of space at those places.
void expectAt(const Case& c, std::map<std::string, Numbers> inputs, float tolerance = 2e-6f) {
    const bool plane = std::string(c.id).find("2d") != std::string::npos;
    inputs[plane ? "texcoord" : "position"] = plane ? at2 : at3;
    expectFolded(c.id, inputs, c.expected, tolerance);
}

} // namespace

TEST(Noise, PerlinHasTheValuesOfMaterialX) {
    const Case cases[] = {
        {"ND_noise2d_float", {0.9701275f}},
        {"ND_noise2d_vector2", {0.9701275f, 2.275763f}},
        {"ND_noise2d_vector3", {0.9701275f, 2.275763f, -0.6373222f}},
        {"ND_noise2d_color3", {0.9701275f, 2.275763f, -0.6373222f}},
        {"ND_noise2d_vector4", {0.9701275f, 2.275763f, -0.6373222f, -0.3798363f}},
        {"ND_noise3d_float", {-0.1314467f}},
        {"ND_noise3d_vector2", {-0.1314467f, 0.06536388f}},
        {"ND_noise3d_vector3", {-0.1314467f, 0.06536388f, -0.179431f}},
        {"ND_noise3d_vector4", {-0.1314467f, 0.06536388f, -0.179431f, -1.358656f}},
        {"ND_noise3d_color4", {-0.1314467f, 0.06536388f, -0.179431f, -1.358656f}},
    };
    for (const Case& c : cases)
        expectAt(c, {{"amplitude", amplitude(c.expected.size())}, {"pivot", {0.5f}}});
}

TEST(Noise, OneAmplitudeForAllChannels) {
    const Numbers one = folded("ND_noise3d_vector3", {{"position", at3}});
    const Numbers twice =
        folded("ND_noise3d_vector3FA", {{"position", at3}, {"amplitude", {2.0f}}});
    expectNumbers(twice, {2 * one[0], 2 * one[1], 2 * one[2]});
}

TEST(Noise, FractalHasTheValuesOfMaterialX) {
    const Case cases[] = {
        {"ND_fractal2d_float", {-0.07186598f}},
        {"ND_fractal2d_vector2", {-0.07186598f, -2.252318f}},
        {"ND_fractal2d_vector3", {-0.07186598f, 1.699512f, 0.1793964f}},
        {"ND_fractal2d_vector4", {-0.07186598f, 1.699512f, 0.1793964f, -3.753864f}},
        {"ND_fractal3d_float", {-0.8872405f}},
        {"ND_fractal3d_vector2", {-0.8872405f, 1.164912f}},
        {"ND_fractal3d_vector3", {-0.8872405f, -0.06849562f, -1.335973f}},
        {"ND_fractal3d_vector4", {-0.8872405f, -0.06849562f, -1.335973f, 1.94152f}},
    };
    for (const Case& c : cases)
        expectAt(c,
                 {{"amplitude", amplitude(c.expected.size())},
                  {"octaves", {4}},
                  {"lacunarity", {2.1f}},
                  {"diminish", {0.6f}}},
                 4e-6f);
}

TEST(Noise, CellsAndWorleyHaveTheValuesOfMaterialX) {
    expectFolded("ND_cellnoise2d_float", {{"texcoord", at2}}, {0.2095094f});
    expectFolded("ND_cellnoise3d_float", {{"position", at3}}, {0.8639234f});
    const Case distances[] = {
        {"ND_worleynoise2d_float", {0.2324809f}},
        {"ND_worleynoise2d_vector2", {0.2324809f, 0.6152412f}},
        {"ND_worleynoise2d_vector3", {0.2324809f, 0.6152412f, 1.172621f}},
        {"ND_worleynoise3d_float", {0.3506302f}},
        {"ND_worleynoise3d_vector2", {0.3506302f, 0.731169f}},
        {"ND_worleynoise3d_vector3", {0.3506302f, 0.731169f, 0.8028945f}},
    };
    const Case solid[] = {
        {"ND_worleynoise2d_float", {0.2095094f}},
        {"ND_worleynoise2d_vector2", {0.41551f, 0.4785006f}},
        {"ND_worleynoise2d_vector3", {0.41551f, 0.4785006f, 0.835977f}},
        {"ND_worleynoise3d_float", {0.1496137f}},
        {"ND_worleynoise3d_vector2", {0.3567886f, 0.01981363f}},
        {"ND_worleynoise3d_vector3", {0.3567886f, 0.01981363f, 0.08191834f}},
    };
    for (const float style : {0.0f, 1.0f})
        for (const Case& c : style == 0.0f ? distances : solid)
            expectAt(c, {{"jitter", {0.7f}}, {"style", {style}}});
}

TEST(Noise, FlakesHaveTheValuesOfMaterialX) {
    const std::map<std::string, Numbers> inputs = {
        {"size", {0.5f}},      {"roughness", {0.3f}},  {"coverage", {0.6f}},    {"texcoord", at2},
        {"normal", {0, 0, 1}}, {"tangent", {1, 0, 0}}, {"bitangent", {0, 1, 0}}};
    expectNumbers(folded("ND_flake2d", inputs, 0), {2610565});
    expectNumbers(folded("ND_flake2d", inputs, 1), {0.1556019f});
    expectNumbers(folded("ND_flake2d", inputs, 2), {0.0680031f});
    expectNumbers(folded("ND_flake2d", inputs, 3), {-0.05207004f, 0.1143477f, 0.9920753f});
}

TEST(Noise, UnifiedNodesAreTheOthersInARange) {
    const auto unified = [&](float type, float jitter) {
        return folded("ND_unifiednoise2d_float", {{"texcoord", {0.65f, -1.35f}},
                                                  {"freq", {2, 2}},
                                                  {"outmin", {1}},
                                                  {"outmax", {3}},
                                                  {"clampoutput", {0}},
                                                  {"jitter", {jitter}},
                                                  {"type", {type}}});
    };
    expectNumbers(unified(0, 1), {1 + 2 * (0.5f + 0.5f * (0.9701275f - 0.5f) / 2)});
    expectNumbers(unified(1, 1), {1 + 2 * 0.2095094f});
    expectNumbers(unified(2, 0.7f), {1 + 2 * 0.2324809f});
    // A jitter of 0.7 turns the plane by 270 degrees times 100, which is a whole number of turns.
    expectNumbers(unified(1, 0.7f), unified(1, 1));
}

TEST(Noise, RandomNumbersAreCells) {
    const Numbers u = folded("ND_cellnoise2d_float", {{"texcoord", {3, 8}}});
    expectFolded("ND_randomfloat_integer", {{"in", {3}}, {"seed", {8}}, {"min", {1}}, {"max", {5}}},
                 {1 + 4 * u[0]});
    // Hue free, saturation and value at 1: at least one channel is 1 and one is 0.
    for (float i = 0; i < 20; ++i) {
        const Numbers c = folded("ND_randomcolor_integer",
                                 {{"in", {i}}, {"saturationlow", {1}}, {"saturationhigh", {1}}});
        EXPECT_NEAR(std::max({c[0], c[1], c[2]}), 1.0f, 1e-6f);
        EXPECT_NEAR(std::min({c[0], c[1], c[2]}), 0.0f, 1e-6f);
    }
}

TEST(Noise, FarAndBrokenPlacesGiveNumbers) {
    for (const float x : {1e9f, -1e9f, 1e38f, INFINITY, -INFINITY, NAN}) {
        for (const char* id : {"ND_cellnoise3d_float", "ND_worleynoise3d_float"})
            EXPECT_TRUE(std::isfinite(folded(id, {{"position", {x, x, x}}})[0]) || !(x == x)) << id;
        const Numbers n = folded("ND_noise3d_float", {{"position", {x, x, x}}});
        EXPECT_EQ(n.size(), 1u);
    }
    // Numbers that are none select the first of a list; those beyond it nothing.
    for (const float x : {1e38f, -1e38f, INFINITY, -INFINITY, NAN}) {
        const Numbers v = folded("ND_unifiednoise3d_float", {{"position", at3}, {"type", {x}}});
        EXPECT_EQ(v,
                  x == x ? Numbers{0.0f} : folded("ND_unifiednoise3d_float", {{"position", at3}}));
        EXPECT_EQ(folded("ND_extract_vector3", {{"in", {1, 2, 3}}, {"index", {x}}})[0],
                  x > 0 ? 3.0f : 1.0f);
    }
    // Octaves without end come to one.
    EXPECT_EQ(folded("ND_fractal3d_float", {{"position", at3}, {"octaves", {2e9f}}}).size(), 1u);
}
