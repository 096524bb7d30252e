// SPDX-License-Identifier: Apache-2.0
// Networks, graphs and plans as text, compared with reviewed files. After a wanted change run with
// PATINA_UPDATE_EXPECTED=1, and review the difference.
#include "materialNetwork/tests/materialFixture.h"
#include "materialNetwork/network/translate.h"

#include <cstdlib>
#include <fstream>
#include <sstream>

namespace patina {

namespace {

void expectText(const std::string& name, const Network& network) {
    Diagnostics diagnostics;
    std::string text = explainMaterial(network, diagnostics);
    if (diagnostics.count()) text += "\n" + warnings(diagnostics);
    const std::string path = std::string(PATINA_EXPECTED_DIR) + "/" + name + ".txt";
    if (std::getenv("PATINA_UPDATE_EXPECTED")) {
        std::ofstream(path) << text;
        return;
    }
    std::ifstream file(path);
    ASSERT_TRUE(file) << path << " is missing";
    std::ostringstream expected;
    expected << file.rdbuf();
    EXPECT_EQ(expected.str(), text);
}

NetworkNode texture(const std::string& name, const std::string& file) {
    return makeNode(
        name, "UsdUVTexture",
        {{"file", Value::makeFilename(file)}, {"wrapS", text("repeat")}, {"wrapT", text("repeat")}},
        {{"st", {"st", "result"}}});
}

NetworkNode stReader() {
    return makeNode("st", "UsdPrimvarReader_float2", {{"varname", text("st")}});
}

} // namespace

TEST(Text, PreviewSurfaceDefault) {
    expectText("previewSurfaceDefault", previewNetwork());
}

TEST(Text, PreviewSurfaceGlass) {
    expectText("previewSurfaceGlass", previewNetwork({{"opacity", number(0.0f)},
                                                      {"roughness", number(0.1f)},
                                                      {"ior", number(1.52f)}}));
}

TEST(Text, PreviewSurfaceGoldWithCoat) {
    expectText("previewSurfaceGoldWithCoat", previewNetwork({{"diffuseColor", color(1, 0.7f, 0.3f)},
                                                             {"metallic", number(1.0f)},
                                                             {"clearcoat", number(0.5f)}}));
}

TEST(Text, PreviewSurfaceTextured) {
    expectText("previewSurfaceTextured",
               previewNetwork({{"opacityThreshold", number(0.5f)}, {"emissiveColor", grey(0.25f)}},
                              {{"diffuseColor", {"albedo", "rgb"}},
                               {"opacity", {"albedo", "a"}},
                               {"normal", {"normals", "rgb"}},
                               {"metallic", {"orm", "b"}},
                               {"roughness", {"orm", "g"}}},
                              {stReader(), texture("albedo", "albedo.png"),
                               texture("normals", "normals.png"), texture("orm", "orm.png")}));
}

TEST(Text, PreviewSurfaceLeaf) {
    expectText("previewSurfaceLeaf",
               previewNetwork({}, {{"diffuseColor", {"leaf", "rgb"}}, {"opacity", {"leaf", "a"}}},
                              {stReader(), texture("leaf", "leaf.png")}));
}

TEST(Text, StandardSurfaceCarPaint) {
    expectText("standardSurfaceCarPaint",
               makeNetwork({makeNode("surface", "standard_surface",
                                     {{"base_color", color(0.1f, 0.04f, 0.04f)},
                                      {"specular_color", color(0.0f, 0.02f, 0.3f)},
                                      {"specular_roughness", number(0.4f)},
                                      {"specular_anisotropy", number(0.5f)},
                                      {"coat", number(1.0f)},
                                      {"coat_affect_color", number(0.5f)},
                                      {"coat_roughness", number(0.0f)}})}));
}

TEST(Text, DisplayColor) {
    expectText("displayColor", makeDisplayColorNetwork());
}

TEST(Text, LayerOverMix) {
    expectText(
        "layerOverMix",
        bsdfNetwork(
            {makeNode("diffuse", "ND_oren_nayar_diffuse_bsdf", {{"color", grey(0.5f)}}),
             makeNode("metal", "ND_conductor_bsdf"),
             makeNode("coat", "ND_dielectric_bsdf", {{"weight", number(0.5f)}}),
             makeNode("amount", "ND_geompropvalue_float",
                      {{"geomprop", text("wear")}, {"default", number(0.25f)}}),
             makeNode("mix", "ND_mix_bsdf", {},
                      {{"fg", {"metal", ""}}, {"bg", {"diffuse", ""}}, {"mix", {"amount", ""}}}),
             makeNode("bsdf", "ND_layer_bsdf", {},
                      {{"top", {"coat", ""}}, {"base", {"mix", ""}}})}));
}

TEST(Text, GlassWithAbsorption) {
    expectText("glassWithAbsorption",
               bsdfNetwork({makeNode("glass", "ND_dielectric_bsdf",
                                     {{"scatter_mode", text("RT")}, {"roughness", pair(0.0f)}}),
                            makeNode("inside", "ND_anisotropic_vdf",
                                     {{"absorption", Value::makeVec3(1, 2, 3)}}),
                            makeNode("bsdf", "ND_layer_vdf", {},
                                     {{"top", {"glass", ""}}, {"base", {"inside", ""}}})}));
}

TEST(Text, GltfPbrBlended) {
    expectText("gltfPbrBlended", makeNetwork({makeNode("surface", "gltf_pbr",
                                                       {{"base_color", color(0.5f, 0.25f, 0.125f)},
                                                        {"metallic", number(0.0f)},
                                                        {"roughness", number(0.5f)},
                                                        {"alpha", number(0.5f)},
                                                        {"alpha_mode", text("BLEND")},
                                                        {"clearcoat", number(0.25f)},
                                                        {"anisotropy_strength", number(0.5f)},
                                                        {"emissive", color(1, 0.5f, 0)},
                                                        {"emissive_strength", number(2.0f)}})}));
}

TEST(Text, OpenPbrCoatedMetal) {
    expectText("openPbrCoatedMetal",
               makeNetwork({makeNode("surface", "open_pbr_surface",
                                     {{"base_color", color(0.9f, 0.6f, 0.3f)},
                                      {"base_metalness", number(1.0f)},
                                      {"specular_roughness", number(0.4f)},
                                      {"coat_weight", number(1.0f)},
                                      {"coat_color", color(0.8f, 0.9f, 1.0f)}})}));
}

TEST(Text, DisneyPrincipledGlazed) {
    expectText("disneyPrincipledGlazed",
               makeNetwork({makeNode("surface", "disney_principled",
                                     {{"baseColor", color(0.8f, 0.4f, 0.2f)},
                                      {"roughness", number(0.5f)},
                                      {"specularTint", number(0.5f)},
                                      {"clearcoat", number(1.0f)}})}));
}

TEST(Text, LamaMetalOverDiffuse) {
    expectText(
        "lamaMetalOverDiffuse",
        bsdfNetwork({makeNode("top", "ND_lama_conductor",
                              {{"fresnelMode", text("Scientific")},
                               {"roughness", number(0.5f)},
                               {"anisotropy", number(0.5f)}}),
                     makeNode("base", "ND_lama_diffuse", {{"roughness", number(0.5f)}}),
                     makeNode("bsdf", "ND_lama_layer_bsdf", {{"topMix", number(0.25f)}},
                              {{"materialTop", {"top", ""}}, {"materialBase", {"base", ""}}})}));
}

// The height is read at three places; nodes that do not move are shared.
TEST(Text, Bumps) {
    expectText(
        "bumps",
        bsdfNetwork(
            {makeNode("uv", "ND_texcoord_vector2"),
             makeNode("noise", "ND_noise2d_float", {{"amplitude", number(0.5f)}},
                      {{"texcoord", {"uv", ""}}}),
             makeNode("wear", "ND_geompropvalue_float", {{"geomprop", text("wear")}}),
             makeNode("height", "ND_multiply_float", {},
                      {{"in1", {"noise", ""}}, {"in2", {"wear", ""}}}),
             makeNode("bumps", "ND_bump_vector3", {{"scale", number(2.0f)}},
                      {{"height", {"height", ""}}}),
             makeNode("bsdf", "ND_oren_nayar_diffuse_bsdf", {}, {{"normal", {"bumps", ""}}})}));
}

TEST(Text, TranslatedPaint) {
    Diagnostics diagnostics;
    expectText("translatedPaint",
               translateMaterial(
                   makeNetwork({makeNode("paint", "ND_checkerboard_color3"),
                                makeNode("surface", "standard_surface",
                                         {{"specular", number(0.5f)}, {"coat", number(0.5f)}},
                                         {{"base_color", {"paint", ""}}})}),
                   "UsdPreviewSurface", diagnostics));
    EXPECT_EQ(diagnostics.count(), 0);
}

TEST(Text, EveryProblemIsNamed) {
    expectText("everyProblemIsNamed",
               previewNetwork({{"roughness", text("rough")}, {"sparkle", number(1.0f)}},
                              {{"diffuseColor", {"nowhere", "rgb"}},
                               {"metallic", {"vector", ""}},
                               {"clearcoat", {"strange", "out"}},
                               {"ior", {"loop", ""}}},
                              {makeNode("vector", "ND_constant_color3", {{"value", grey(1.0f)}}),
                               makeNode("strange", "ND_no_such_node"),
                               makeNode("loop", "ND_add_float", {{"in2", number(1.4f)}},
                                        {{"in1", {"loop", ""}}})}));
}

} // namespace patina
