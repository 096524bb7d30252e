// SPDX-License-Identifier: Apache-2.0
// Linear spaces in which light is added and multiplied, and networks in them.
#include "materialNetwork/tests/materialFixture.h"

#include "materialNetwork/color/colorSpaces.h"
#include "materialNetwork/network/renderingColors.h"

#include <cmath>

namespace patina {

namespace {

// Rec.709 to AP1 by Bradford's transform, as the ACES reference implementation gives it.
const glm::mat3 ap1 = glm::transpose(glm::mat3(0.613097402f, 0.339523146f, 0.047379451f,
                                               0.070193722f, 0.916353879f, 0.013452398f,
                                               0.020615593f, 0.109569773f, 0.869814634f));

void expectNear(const glm::vec3& a, const glm::vec3& b, float bound = 2e-5f) {
    EXPECT_LT(glm::length(a - b), bound * std::max(1.0f, glm::length(b)))
        << a.x << " " << a.y << " " << a.z;
}

} // namespace

TEST(RenderingSpace, LinearSpacesAreFoundByAnyOfTheirNames) {
    const RenderingSpace* aces = RenderingSpace::find("lin_ap1");
    ASSERT_TRUE(aces);
    for (const char* name : {"ACEScg", "acescg", "lin_ap1_scene", "ACES - ACEScg"})
        EXPECT_EQ(RenderingSpace::find(name), aces) << name;
    for (const char* name : {"", "lin_rec709", "lin_rec709_scene", "linear", "lin_srgb"})
        EXPECT_EQ(RenderingSpace::find(name), &RenderingSpace::rec709()) << name;
    // Signals, data and what nobody knows are none.
    for (const char* name : {"sRGB", "g22_rec709", "srgb_ap1", "raw", "none", "auto", "mine"})
        EXPECT_FALSE(RenderingSpace::find(name)) << name;
    EXPECT_TRUE(RenderingSpace::find("chromaticities(0.7 0.3 0.2 0.7 0.14 0.05 0.31 0.33 1 0)"));
    EXPECT_FALSE(RenderingSpace::find("chromaticities(0.7 0.3 0.2 0.7 0.14 0.05 0.31 0.33 2 0)"));
}

TEST(RenderingSpace, ItsMatrixIsThatOfAces) {
    const RenderingSpace& aces = *RenderingSpace::find("acescg");
    const glm::vec3 c(0.7f, 0.2f, 0.05f);
    expectNear(aces.from709(c), ap1 * c);
    expectNear(aces.to709(aces.from709(c)), c);
    EXPECT_EQ(aces.from709(glm::vec3(0.3f)), glm::vec3(0.3f)); // to the bit
    EXPECT_NEAR(aces.chromaticities[0], 0.713f, 1e-6f);
    EXPECT_NEAR(aces.chromaticities[7], 0.33767f, 1e-6f);
    const RenderingSpace& own =
        *RenderingSpace::find("chromaticities(0.68 0.32 0.265 0.69 0.15 0.06 0.3127 0.329 1 0)");
    const RenderingSpace& p3 = *RenderingSpace::find("lin_displayp3");
    for (size_t i = 0; i < 8; ++i) // from the matrix in one, of the table in the other
        EXPECT_NEAR(own.chromaticities[i], p3.chromaticities[i], 1e-4f);
}

TEST(RenderingSpace, TexturesAndDisplaysGoByWayOfRec709) {
    const ColorSpaces spaces;
    const RenderingSpace& aces = *RenderingSpace::find("acescg");
    const auto through = [](const ColorTransformPtr& transform, glm::vec3 c) {
        transform->apply(&c.x, 1, 3);
        return c;
    };
    const glm::vec3 c(0.7f, 0.2f, 0.05f);
    EXPECT_TRUE(spaces.toRendering("ACEScg", aces)->isIdentity());
    EXPECT_TRUE(spaces.toRendering("raw", aces)->isIdentity());
    EXPECT_FALSE(spaces.toRendering("mine", aces));
    expectNear(through(spaces.toRendering("linear", aces), c), ap1 * c);
    expectNear(through(spaces.toRendering("sRGB", aces), c),
               ap1 * through(spaces.toRec709("sRGB"), c));
    expectNear(through(spaces.display("", "", aces), ap1 * c), through(spaces.display(), c));
}

TEST(RenderingSpace, ColoursOfANetworkAreConverted) {
    const RenderingSpace& aces = *RenderingSpace::find("acescg");
    Network network;
    NetworkNode diffuse, metal, light, glow;
    diffuse.path = "/d";
    diffuse.id = "ND_oren_nayar_diffuse_bsdf";
    diffuse.inputs["color"] = color(0.7f, 0.2f, 0.05f);
    diffuse.inputs["roughness"] = Value::makeFloat(0.3f);
    metal.path = "/m";
    metal.id = "ND_conductor_bsdf";
    metal.inputs["ior"] = color(0.2f, 0.4f, 1.4f);
    metal.inputs["extinction"] = color(3.9f, 2.4f, 1.6f);
    light.path = "/b";
    light.id = "ND_blackbody";
    glow.path = "/g";
    glow.id = "ND_uniform_edf";
    glow.connections["color"] = {"/b", ""};
    network.nodes = {diffuse, metal, light, glow};
    network.nodes[0].inputs["color"].colorSpace = "lin_ap1";
    const Network other = inRenderingSpace(network, aces);
    const auto at = [&](const char* path, const char* input) {
        const std::vector<float>& n = other.find(path)->inputs.at(input).numbers;
        return glm::vec3(n[0], n[1], n[2]);
    };
    expectNear(at("/d", "color"), {0.7f, 0.2f, 0.05f}); // given in the space
    EXPECT_EQ(other.find("/d")->inputs.at("roughness").numbers[0], 0.3f);
    EXPECT_EQ(at("/m", "ior"), glm::vec3(0.2f, 0.4f, 1.4f)); // no colours
    EXPECT_EQ(at("/m", "extinction"), glm::vec3(3.9f, 2.4f, 1.6f));
    EXPECT_EQ(other.find("/g")->connections.at("color").node, "/b.rendering");
    EXPECT_TRUE(other.find("/b.rendering"));

    network.nodes[0].inputs["color"].colorSpace.clear();
    const Network plain = inRenderingSpace(network, aces);
    const std::vector<float>& n = plain.find("/d")->inputs.at("color").numbers;
    expectNear({n[0], n[1], n[2]}, ap1 * glm::vec3(0.7f, 0.2f, 0.05f));
    // A default that is no grey is a colour of Rec.709 as well.
    Network model;
    model.nodes.resize(1);
    model.nodes[0].path = "/o";
    model.nodes[0].id = "ND_open_pbr_surface_surfaceshader";
    const Network opened = inRenderingSpace(model, aces);
    const std::vector<float>& r = opened.find("/o")->inputs.at("subsurface_radius_scale").numbers;
    expectNear({r[0], r[1], r[2]}, ap1 * glm::vec3(1.0f, 0.5f, 0.25f));
    EXPECT_EQ(opened.find("/o")->inputs.size(), 1u);
}

TEST(RenderingSpace, AColourOfAnUnknownSpaceStaysAndIsTold) {
    Network network;
    network.nodes.resize(1);
    network.nodes[0].path = "/d";
    network.nodes[0].id = "ND_oren_nayar_diffuse_bsdf";
    Value& value = network.nodes[0].inputs["color"] = color(0.7f, 0.2f, 0.05f);
    value.colorSpace = "nobody knows";
    const Network same = inRenderingSpace(network, *RenderingSpace::find("acescg"));
    EXPECT_EQ(same.nodes[0].inputs.at("color").numbers, value.numbers);
    EXPECT_EQ(same.nodes[0].inputs.at("color").colorSpace, "nobody knows");
}

} // namespace patina
