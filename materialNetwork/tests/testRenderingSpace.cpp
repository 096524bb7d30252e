// SPDX-License-Identifier: Apache-2.0
// Linear spaces in which light is added and multiplied, and networks in them.
#include "materialNetwork/tests/colorFixture.h"

#include "materialNetwork/network/renderingColors.h"

using namespace patina;

namespace {

// Rec.709 to AP1 by Bradford's transform, as the ACES reference implementation gives it.
const glm::mat3 ap1 =
    glm::transpose(glm::mat3(0.613097402f, 0.339523146f, 0.047379451f, 0.070193722f, 0.916353879f,
                             0.013452398f, 0.020615593f, 0.109569773f, 0.869814634f));

void expectNear(const glm::vec3& a, const glm::vec3& b) {
    expectVector(a, b, 2e-5f);
}

/// A colour of a node's input.
glm::vec3 colorAt(const Network& network, const std::string& path, const char* input) {
    const std::vector<float>& n = network.find("/m/" + path)->inputs.at(input).numbers;
    return {n[0], n[1], n[2]};
}

const glm::vec3 orange(0.7f, 0.2f, 0.05f);

/// A diffuse node "d", of whose colour that is the space.
NetworkNode diffuseIn(const char* space) {
    Value value = color(orange.x, orange.y, orange.z);
    value.colorSpace = space;
    return makeNode("d", "ND_oren_nayar_diffuse_bsdf", {{"color", value}, {"roughness", 0.3f}});
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
    const glm::vec3& c = orange;
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
    const glm::vec3& c = orange;
    EXPECT_TRUE(spaces.toRendering("ACEScg", aces)->isIdentity());
    EXPECT_TRUE(spaces.toRendering("raw", aces)->isIdentity());
    EXPECT_FALSE(spaces.toRendering("mine", aces));
    expectNear(converted(spaces.toRendering("linear", aces), c), ap1 * c);
    expectNear(converted(spaces.toRendering("sRGB", aces), c),
               ap1 * converted(spaces.toRec709("sRGB"), c));
    expectNear(converted(spaces.display("", "", aces), ap1 * c), converted(spaces.display(), c));
}

TEST(RenderingSpace, ColoursOfANetworkAreConverted) {
    const RenderingSpace& aces = *RenderingSpace::find("acescg");
    const Network other = inRenderingSpace(
        makeNetwork(
            {diffuseIn("lin_ap1"),
             makeNode("m", "ND_conductor_bsdf",
                      {{"ior", color(0.2f, 0.4f, 1.4f)}, {"extinction", color(3.9f, 2.4f, 1.6f)}}),
             makeNode("b", "ND_blackbody"), makeNode("g", "ND_uniform_edf", {}, {{"color", "b"}})}),
        aces);
    expectNear(colorAt(other, "d", "color"), orange); // given in the space
    EXPECT_EQ(other.find("/m/d")->inputs.at("roughness").numbers[0], 0.3f);
    EXPECT_EQ(colorAt(other, "m", "ior"), glm::vec3(0.2f, 0.4f, 1.4f)); // no colours
    EXPECT_EQ(colorAt(other, "m", "extinction"), glm::vec3(3.9f, 2.4f, 1.6f));
    EXPECT_EQ(other.find("/m/g")->connections.at("color").node, "/m/b.rendering");
    EXPECT_TRUE(other.find("/m/b.rendering"));

    const Network plain = inRenderingSpace(makeNetwork({diffuseIn("")}), aces);
    expectNear(colorAt(plain, "d", "color"), ap1 * orange);
    // A default that is no grey is a colour of Rec.709 as well.
    const Network opened =
        inRenderingSpace(modelNetwork("ND_open_pbr_surface_surfaceshader"), aces);
    expectNear(colorAt(opened, "surface", "subsurface_radius_scale"),
               ap1 * glm::vec3(1.0f, 0.5f, 0.25f));
    EXPECT_EQ(opened.find("/m/surface")->inputs.size(), 1u);
}

TEST(RenderingSpace, AColourOfAnUnknownSpaceStaysAndIsTold) {
    const Network same =
        inRenderingSpace(makeNetwork({diffuseIn("nobody knows")}), *RenderingSpace::find("acescg"));
    EXPECT_EQ(colorAt(same, "d", "color"), orange);
    EXPECT_EQ(same.nodes[0].inputs.at("color").colorSpace, "nobody knows");
}
