// SPDX-License-Identifier: Apache-2.0
// Simple materials that look like others.
#include "materialNetwork/glsl/glslMaterial.h"
#include "materialNetwork/tests/materialFixture.h"

using namespace patina;

namespace {

Compiled standInOf(const Network& network) {
    return Compiled(makeStandInNetwork(*Compiled(network).program));
}

float distance(const glm::vec3& a, const glm::vec3& b) {
    return glm::length(glm::sqrt(a) - glm::sqrt(b)); // about as lightness goes (Hunter 1948)
}

/// "image", over the default coordinates.
std::vector<NetworkNode> textureNodes() {
    return {makeNode("image", "UsdUVTexture", {{"file", "a.png"}}, {{"st", "st.result"}}),
            makeNode("st", "UsdPrimvarReader_float2", {{"varname", "st"}})};
}

std::vector<std::pair<const char*, Network>> opaqueCases() {
    return {
        {"plastic", previewNetwork({{"diffuseColor", color(0.6f, 0.1f, 0.05f)}})},
        {"white", previewNetwork({{"diffuseColor", grey(1.0f)}})},
        {"black", previewNetwork({{"diffuseColor", grey(0.0f)}, {"roughness", 0.0f}})},
        {"metal",
         previewNetwork(
             {{"diffuseColor", color(0.9f, 0.6f, 0.2f)}, {"metallic", 1.0f}, {"roughness", 0.2f}})},
        {"half metal",
         previewNetwork({{"diffuseColor", color(0.2f, 0.4f, 0.8f)}, {"metallic", 0.5f}})},
        {"mirror", lobeNetwork("ND_conductor_bsdf", {{"roughness", pair(0.0f)}})},
        {"cloth", lobeNetwork("ND_oren_nayar_diffuse_bsdf", {{"color", color(0.1f, 0.3f, 0.7f)}})},
    };
}

} // namespace

TEST(StandIn, LooksMoreLikeTheMaterialThanDisplayColorDoes) {
    const glm::vec3 grey = Compiled(makeDisplayColorNetwork()).albedo();
    for (const auto& [name, network] : opaqueCases()) {
        SCOPED_TRACE(name);
        const Compiled standIn = standInOf(network);
        const glm::vec3 wanted = Compiled(network).albedo(), shown = standIn.albedo();
        EXPECT_LT(distance(shown, wanted), 0.25f * distance(grey, wanted))
            << shown.x << " " << shown.y << " " << shown.z << " in place of " << wanted.x << " "
            << wanted.y << " " << wanted.z;
        EXPECT_TRUE(standIn->isOpaque());
        EXPECT_TRUE(standIn->primvars().empty());
        EXPECT_TRUE(nothingTold(standIn));
    }
}

TEST(StandIn, TakesTexturesByTheirMean) {
    const glm::vec3 shown =
        standInOf(previewNetwork({}, {{"diffuseColor", "image.rgb"}}, textureNodes())).albedo();
    const glm::vec3 mean = Compiled(previewNetwork({{"diffuseColor", grey(0.5f)}})).albedo();
    EXPECT_LT(glm::length(shown - mean), 5.0f / 255.0f);
}

TEST(StandIn, IsHalfTransparentForGlass) {
    const Compiled standIn = standInOf(
        lobeNetwork("ND_dielectric_bsdf", {{"scatter_mode", "RT"}, {"roughness", pair(0.0f)}}));
    EXPECT_NEAR(standIn->opacity(ShadingPoint()), 0.5f, 0.1f);
    EXPECT_FALSE(standIn->hasTransmission());
}

TEST(StandIn, IsThereForSurfacesThatShowNoPrimvars) {
    EXPECT_TRUE(hasStandIn(*Compiled(previewNetwork()).program));
    EXPECT_FALSE(hasStandIn(*Compiled(makeDisplayColorNetwork()).program));
    Network fog =
        modelNetwork("ND_volume", {}, {{"vdf", "vdf"}},
                     {makeNode("vdf", "ND_absorption_vdf", {{"absorption", grey(1.0f)}})});
    fog.terminals = {{"volume", fog.terminals["surface"]}};
    EXPECT_FALSE(hasStandIn(*Compiled(fog).program));
}

TEST(StandIn, LeavesOutLight) {
    const Network glowing =
        edfNetwork({makeNode("edf", "ND_uniform_edf", {{"color", grey(2.0f)}})});
    EXPECT_FALSE(standInOf(glowing)->hasEmission());
}

// Else each material would have a program of its own again.
TEST(StandIn, HasOneTextForAll) {
    const auto textOf = [](const Network& network) {
        const GlslMaterial glsl = makeGlslMaterial(standInOf(network)->ir());
        return glsl.text + (glsl.presence ? "// present" : "");
    };
    const std::string first = textOf(opaqueCases().front().second);
    EXPECT_FALSE(first.empty());
    for (const auto& [name, network] : opaqueCases())
        EXPECT_EQ(textOf(network), first) << name;
    const Network glass = lobeNetwork("ND_dielectric_bsdf", {{"scatter_mode", "RT"}});
    const Network gauze = previewNetwork({{"opacity", 0.3f}, {"opacityMode", "presence"}});
    const Network cutOut =
        previewNetwork({{"opacityThreshold", 0.6f}}, {{"opacity", "image.r"}}, textureNodes());
    EXPECT_NE(textOf(glass), first);
    EXPECT_EQ(textOf(gauze), textOf(glass));
    EXPECT_EQ(textOf(cutOut), textOf(glass));
    EXPECT_NEAR(standInOf(cutOut)->opacity(ShadingPoint()), 0.5f, 1e-3f) << "two of four columns";
}
