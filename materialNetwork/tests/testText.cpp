// SPDX-License-Identifier: Apache-2.0
// Networks, graphs and plans as text, compared with reviewed files.
#include "materialNetwork/tests/materialFixture.h"
#include "materialNetwork/network/translate.h"
#include "materialNetwork/tests/reviewed.h"

using namespace patina;

namespace {

void expectText(const std::string& name, const Network& network) {
    Diagnostics diagnostics;
    std::string text = explainMaterial(network, diagnostics);
    if (diagnostics.count()) text += "\n" + warnings(diagnostics);
    expectReviewed(std::string(PATINA_EXPECTED_DIR) + "/" + name + ".txt", text);
}

NetworkNode texture(const std::string& name) {
    return makeNode(name, "UsdUVTexture",
                    {{"file", file(name + ".png")}, {"wrapS", "repeat"}, {"wrapT", "repeat"}},
                    {{"st", "st.result"}});
}

NetworkNode stReader() {
    return makeNode("st", "UsdPrimvarReader_float2", {{"varname", "st"}});
}

} // namespace

TEST(Text, Models) {
    expectText("previewSurfaceDefault", previewNetwork());
    expectText("previewSurfaceGlass",
               previewNetwork({{"opacity", 0.0f}, {"roughness", 0.1f}, {"ior", 1.52f}}));
    expectText("previewSurfaceGoldWithCoat", previewNetwork({{"diffuseColor", color(1, 0.7f, 0.3f)},
                                                             {"metallic", 1.0f},
                                                             {"clearcoat", 0.5f}}));
    expectText("previewSurfaceTextured",
               previewNetwork({{"opacityThreshold", 0.5f}, {"emissiveColor", grey(0.25f)}},
                              {{"diffuseColor", "albedo.rgb"},
                               {"opacity", "albedo.a"},
                               {"normal", "normals.rgb"},
                               {"metallic", "orm.b"},
                               {"roughness", "orm.g"}},
                              {stReader(), texture("albedo"), texture("normals"), texture("orm")}));
    expectText("previewSurfaceLeaf",
               previewNetwork({}, {{"diffuseColor", "leaf.rgb"}, {"opacity", "leaf.a"}},
                              {stReader(), texture("leaf")}));
    expectText("standardSurfaceCarPaint",
               modelNetwork("standard_surface", {{"base_color", color(0.1f, 0.04f, 0.04f)},
                                                 {"specular_color", color(0.0f, 0.02f, 0.3f)},
                                                 {"specular_roughness", 0.4f},
                                                 {"specular_anisotropy", 0.5f},
                                                 {"coat", 1.0f},
                                                 {"coat_affect_color", 0.5f},
                                                 {"coat_roughness", 0.0f}}));
    expectText("gltfPbrBlended",
               modelNetwork("gltf_pbr", {{"base_color", color(0.5f, 0.25f, 0.125f)},
                                         {"metallic", 0.0f},
                                         {"roughness", 0.5f},
                                         {"alpha", 0.5f},
                                         {"alpha_mode", "BLEND"},
                                         {"clearcoat", 0.25f},
                                         {"anisotropy_strength", 0.5f},
                                         {"emissive", color(1, 0.5f, 0)},
                                         {"emissive_strength", 2.0f}}));
    expectText("openPbrCoatedMetal",
               modelNetwork("open_pbr_surface", {{"base_color", color(0.9f, 0.6f, 0.3f)},
                                                 {"base_metalness", 1.0f},
                                                 {"specular_roughness", 0.4f},
                                                 {"coat_weight", 1.0f},
                                                 {"coat_color", color(0.8f, 0.9f, 1.0f)}}));
    expectText("disneyPrincipledGlazed",
               modelNetwork("disney_principled", {{"baseColor", color(0.8f, 0.4f, 0.2f)},
                                                  {"roughness", 0.5f},
                                                  {"specularTint", 0.5f},
                                                  {"clearcoat", 1.0f}}));
    expectText("displayColor", makeDisplayColorNetwork());
}

TEST(Text, Closures) {
    expectText(
        "layerOverMix",
        bsdfNetwork({diffuseNode("diffuse", grey(0.5f)), makeNode("metal", "ND_conductor_bsdf"),
                     makeNode("coat", "ND_dielectric_bsdf", {{"weight", 0.5f}}),
                     makeNode("amount", "ND_geompropvalue_float",
                              {{"geomprop", "wear"}, {"default", 0.25f}}),
                     makeNode("mix", "ND_mix_bsdf", {},
                              {{"fg", "metal"}, {"bg", "diffuse"}, {"mix", "amount"}}),
                     layerNode("bsdf", "coat", "mix")}));
    expectText("glassWithAbsorption",
               bsdfNetwork(
                   {makeNode("glass", "ND_dielectric_bsdf",
                             {{"scatter_mode", "RT"}, {"roughness", pair(0.0f)}}),
                    makeNode("inside", "ND_anisotropic_vdf", {{"absorption", vector(1, 2, 3)}}),
                    makeNode("bsdf", "ND_layer_vdf", {}, {{"top", "glass"}, {"base", "inside"}})}));
    expectText(
        "lamaMetalOverDiffuse",
        bsdfNetwork(
            {makeNode("top", "ND_lama_conductor",
                      {{"fresnelMode", "Scientific"}, {"roughness", 0.5f}, {"anisotropy", 0.5f}}),
             makeNode("base", "ND_lama_diffuse", {{"roughness", 0.5f}}),
             makeNode("bsdf", "ND_lama_layer_bsdf", {{"topMix", 0.25f}},
                      {{"materialTop", "top"}, {"materialBase", "base"}})}));
    // The height is read at three places; nodes that do not move are shared.
    expectText(
        "bumps",
        bsdfNetwork(
            {makeNode("uv", "ND_texcoord_vector2"),
             makeNode("noise", "ND_noise2d_float", {{"amplitude", 0.5f}}, {{"texcoord", "uv"}}),
             makeNode("wear", "ND_geompropvalue_float", {{"geomprop", "wear"}}),
             binaryNode("height", "ND_multiply_float", "noise", "wear"),
             makeNode("bumps", "ND_bump_vector3", {{"scale", 2.0f}}, {{"height", "height"}}),
             makeNode("bsdf", "ND_oren_nayar_diffuse_bsdf", {}, {{"normal", "bumps"}})}));
}

TEST(Text, TranslatedPaint) {
    Diagnostics diagnostics;
    expectText(
        "translatedPaint",
        translateMaterial(modelNetwork("standard_surface", {{"specular", 0.5f}, {"coat", 0.5f}},
                                       {{"base_color", "paint"}},
                                       {makeNode("paint", "ND_checkerboard_color3")}),
                          "UsdPreviewSurface", diagnostics));
    EXPECT_EQ(diagnostics.count(), 0);
}

TEST(Text, EveryProblemIsNamed) {
    expectText(
        "everyProblemIsNamed",
        previewNetwork({{"roughness", "rough"}, {"sparkle", 1.0f}},
                       {{"diffuseColor", "nowhere.rgb"},
                        {"metallic", "vector"},
                        {"clearcoat", "strange.out"},
                        {"ior", "loop"}},
                       {makeNode("vector", "ND_constant_color3", {{"value", grey(1.0f)}}),
                        makeNode("strange", "ND_no_such_node"),
                        makeNode("loop", "ND_add_float", {{"in2", 1.4f}}, {{"in1", "loop"}})}));
}
