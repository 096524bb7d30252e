// SPDX-License-Identifier: Apache-2.0
// Simple materials that look like others.
#include "materialNetwork/glsl/glslMaterial.h"
#include "materialNetwork/tests/materialFixture.h"

namespace patina {

namespace {

glm::vec3 albedo(const MaterialProgram& program) {
    Bsdf bsdf;
    program.evaluate(ShadingPoint(), bsdf);
    return bsdf.albedo();
}

float distance(const glm::vec3& a, const glm::vec3& b) {
    return glm::length(glm::sqrt(a) - glm::sqrt(b)); // about as lightness goes (Hunter 1948)
}

struct Case {
    const char* name;
    Network network;
};

std::vector<Case> opaqueCases() {
    return {
        {"plastic", previewNetwork({{"diffuseColor", color(0.6f, 0.1f, 0.05f)}})},
        {"white", previewNetwork({{"diffuseColor", grey(1.0f)}})},
        {"black", previewNetwork({{"diffuseColor", grey(0.0f)}, {"roughness", number(0.0f)}})},
        {"metal", previewNetwork({{"diffuseColor", color(0.9f, 0.6f, 0.2f)},
                                  {"metallic", number(1.0f)},
                                  {"roughness", number(0.2f)}})},
        {"half metal",
         previewNetwork({{"diffuseColor", color(0.2f, 0.4f, 0.8f)}, {"metallic", number(0.5f)}})},
        {"mirror",
         bsdfNetwork({makeNode("bsdf", "ND_conductor_bsdf", {{"roughness", pair(0.0f)}})})},
        {"cloth", bsdfNetwork({makeNode("bsdf", "ND_oren_nayar_diffuse_bsdf",
                                        {{"color", color(0.1f, 0.3f, 0.7f)}})})},
    };
}

} // namespace

TEST(StandIn, LooksMoreLikeTheMaterialThanDisplayColorDoes) {
    const glm::vec3 grey = albedo(*Compiled(makeDisplayColorNetwork()).program);
    for (const Case& c : opaqueCases()) {
        const Compiled material(c.network);
        const Compiled standIn(makeStandInNetwork(*material.program));
        const glm::vec3 wanted = albedo(*material.program), shown = albedo(*standIn.program);
        EXPECT_LT(distance(shown, wanted), 0.25f * distance(grey, wanted))
            << c.name << ": " << shown.x << " " << shown.y << " " << shown.z << " in place of "
            << wanted.x << " " << wanted.y << " " << wanted.z;
        EXPECT_TRUE(standIn.program->isOpaque()) << c.name;
        EXPECT_TRUE(standIn.program->primvars().empty()) << c.name;
        EXPECT_EQ(standIn.diagnostics.count(), 0) << c.name;
    }
}

TEST(StandIn, TakesTexturesByTheirMean) {
    const Compiled material(previewNetwork(
        {}, {{"diffuseColor", {"image", "rgb"}}},
        {makeNode("image", "UsdUVTexture", {{"file", text("a.png")}}, {{"st", {"st", "result"}}}),
         makeNode("st", "UsdPrimvarReader_float2", {{"varname", text("st")}})}));
    const Compiled standIn(makeStandInNetwork(*material.program));
    const glm::vec3 mean =
        albedo(*Compiled(previewNetwork({{"diffuseColor", grey(0.5f)}})).program);
    EXPECT_LT(glm::length(albedo(*standIn.program) - mean), 5.0f / 255.0f);
}

TEST(StandIn, IsHalfTransparentForGlass) {
    const Compiled glass(bsdfNetwork({makeNode(
        "bsdf", "ND_dielectric_bsdf", {{"scatter_mode", text("RT")}, {"roughness", pair(0.0f)}})}));
    const Compiled standIn(makeStandInNetwork(*glass.program));
    const float opacity = standIn.program->opacity(ShadingPoint());
    EXPECT_GT(opacity, 0.4f);
    EXPECT_LT(opacity, 0.6f);
    EXPECT_FALSE(standIn.program->hasTransmission());
}

TEST(StandIn, IsThereForSurfacesThatShowNoPrimvars) {
    EXPECT_TRUE(hasStandIn(*Compiled(previewNetwork()).program));
    EXPECT_FALSE(hasStandIn(*Compiled(makeDisplayColorNetwork()).program));
    Network fog = makeNetwork({makeNode("vdf", "ND_absorption_vdf", {{"absorption", grey(1.0f)}}),
                               makeNode("surface", "ND_volume", {}, {{"vdf", {"vdf", ""}}})});
    fog.terminals = {{"volume", fog.terminals["surface"]}};
    EXPECT_FALSE(hasStandIn(*Compiled(fog).program));
}

TEST(StandIn, LeavesOutLight) {
    const Compiled glowing(
        makeNetwork({makeNode("edf", "ND_uniform_edf", {{"color", grey(2.0f)}}),
                     makeNode("surface", "ND_surface", {}, {{"edf", {"edf", ""}}})}));
    const Compiled standIn(makeStandInNetwork(*glowing.program));
    EXPECT_FALSE(standIn.program->hasEmission());
}

// Else each material would have a program of its own again.
TEST(StandIn, HasOneTextForAll) {
    const auto textOf = [](const Network& network) {
        const Compiled standIn(makeStandInNetwork(*Compiled(network).program));
        const GlslMaterial glsl = makeGlslMaterial(standIn.program->ir());
        return glsl.text + (glsl.presence ? "// present" : "");
    };
    const std::string first = textOf(opaqueCases().front().network);
    EXPECT_FALSE(first.empty());
    for (const Case& c : opaqueCases())
        EXPECT_EQ(textOf(c.network), first) << c.name;
    const Network glass =
        bsdfNetwork({makeNode("bsdf", "ND_dielectric_bsdf", {{"scatter_mode", text("RT")}})});
    const Network gauze =
        previewNetwork({{"opacity", number(0.3f)}, {"opacityMode", text("presence")}});
    const Network cutOut = previewNetwork(
        {{"opacityThreshold", number(0.6f)}}, {{"opacity", {"image", "r"}}},
        {makeNode("image", "UsdUVTexture", {{"file", text("a.png")}}, {{"st", {"st", "result"}}}),
         makeNode("st", "UsdPrimvarReader_float2", {{"varname", text("st")}})});
    EXPECT_NE(textOf(glass), first);
    EXPECT_EQ(textOf(gauze), textOf(glass));
    EXPECT_EQ(textOf(cutOut), textOf(glass));
    const Compiled leaf(makeStandInNetwork(*Compiled(cutOut).program));
    EXPECT_NEAR(leaf.program->opacity(ShadingPoint()), 0.5f, 1e-3f) << "two of four columns";
}

} // namespace patina
