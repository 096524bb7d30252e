// SPDX-License-Identifier: Apache-2.0
// Mixes of whole shaders, back shaders, unlit surfaces: one program that acts as its parts do.
#include "materialNetwork/tests/mtlxFixture.h"

using namespace patina;

namespace {

const glm::vec3 up(0, 0, 1), back(0, 0, -1);
const NetworkNode red = diffuseNode("red", color(0.8f, 0.0f, 0.0f)),
                  blue = diffuseNode("blue", color(0.0f, 0.0f, 0.4f));

NetworkNode surfaceOf(const std::string& name, const std::string& bsdf, const Inputs& inputs = {},
                      Connections others = {}) {
    others["bsdf"] = bsdf;
    return makeNode(name, "ND_surface", inputs, others);
}

NetworkNode mixedShader(const std::string& fg, const std::string& bg, float amount) {
    return mixNode("surface", fg, bg, amount, "ND_mix_surfaceshader");
}

glm::vec3 emission(const Compiled& c, const glm::vec3& wo = up) {
    return c->emission(seenFrom(wo), wo);
}

float opacity(const Compiled& c, const glm::vec3& wo = up) {
    return c->opacity(seenFrom(wo));
}

} // namespace

TEST(MergeSurfaceShaders, MixesCountByTheirPresence) {
    const auto mixed = [](float opacityA, float opacityB, float m) {
        return Compiled(makeNetwork(
            {red, blue, makeNode("glow", "ND_uniform_edf", {{"color", grey(3.0f)}}),
             surfaceOf("a", "red", {{"opacity", opacityA}}, {{"edf", "glow"}}),
             surfaceOf("b", "blue", {{"opacity", opacityB}}), mixedShader("a", "b", m)}));
    };
    const Compiled even = mixed(1.0f, 1.0f, 0.25f);
    EXPECT_TRUE(nothingTold(even));
    EXPECT_TRUE(even->isOpaque());
    expectVector(even.albedo(), 0.2f, 0.0f, 0.3f);
    expectVector(emission(even), 0.75f, 0.75f, 0.75f);

    // Presence 0.25 * 0.2 + 0.75 * 0.6 = 0.5, of which the red part has 0.05.
    const Compiled uneven = mixed(0.2f, 0.6f, 0.25f);
    EXPECT_NEAR(opacity(uneven), 0.5f, 1e-6f);
    expectVector(uneven.albedo() * 0.5f, 0.05f * 0.8f, 0.0f, 0.45f * 0.4f);
    expectVector(emission(uneven) * 0.5f, 0.15f, 0.15f, 0.15f);

    EXPECT_EQ(opacity(mixed(0.0f, 0.0f, 0.25f)), 0.0f);
    const Compiled chosen = mixed(0.2f, 0.6f, 1.0f);
    expectVector(chosen.albedo(), 0.8f, 0.0f, 0.0f);
    EXPECT_NEAR(opacity(chosen), 0.2f, 1e-6f);
}

TEST(MergeSurfaceShaders, MixesOfModelsNestAndVaryOverTheSurface) {
    const CleanCompiled c(modelNetwork(
        "ND_mix_surfaceshader", {}, {{"fg", "inner"}, {"bg", "lamp"}, {"mix", "u.outx"}},
        {makeNode("paint", "ND_standard_surface_surfaceshader",
                  {{"base_color", color(1, 0, 0)}, {"specular", 0.0f}}),
         makeNode("lamp", "ND_surface_unlit", {{"emission_color", color(0, 1, 0)}}),
         mixNode("inner", "paint", "lamp", 0.5f, "ND_mix_surfaceshader"),
         makeNode("uv", "ND_texcoord_vector2"),
         makeNode("u", "ND_separate2_vector2", {}, {{"in", "uv"}})}));
    for (const float u : {0.0f, 0.5f, 1.0f}) {
        const PointWith point(*c.program, {{"st", glm::vec4(u)}, {"UV0", glm::vec4(u)}});
        expectVector(c.lobes(point).albedo(), 0.5f * u, 0.0f, 0.0f, 1e-4f);
        expectVector(c->emission(point, up), 0.0f, 1.0f - 0.5f * u, 0.0f);
    }
}

TEST(MergeSurfaceShaders, BackShadersShowFromBehind) {
    const auto material = [&](const Connections& c) {
        return Compiled(modelNetwork("ND_surfacematerial", {}, c,
                                     {red, blue, surfaceOf("front", "red"),
                                      surfaceOf("behind", "blue", {{"opacity", 0.5f}}),
                                      makeNode("empty", "ND_surface")}));
    };
    const Compiled both = material({{"surfaceshader", "front"}, {"backsurfaceshader", "behind"}});
    EXPECT_TRUE(nothingTold(both));
    expectVector(both.albedo(), 0.8f, 0.0f, 0.0f);
    expectVector(both.albedo(back), 0.0f, 0.0f, 0.4f);
    EXPECT_EQ(opacity(both), 1.0f);
    EXPECT_EQ(opacity(both, back), 0.5f);

    for (const Connections& c :
         {Connections{{"surfaceshader", "front"}},
          Connections{{"surfaceshader", "front"}, {"backsurfaceshader", "empty"}}}) {
        const Compiled twoSided = material(c);
        expectVector(twoSided.albedo(), 0.8f, 0.0f, 0.0f);
        expectVector(twoSided.albedo(back), 0.8f, 0.0f, 0.0f);
    }
    const Compiled alone = material({{"backsurfaceshader", "behind"}});
    EXPECT_EQ(opacity(alone), 0.0f);
    EXPECT_EQ(opacity(alone, back), 0.5f);
    expectVector(alone.albedo(back), 0.0f, 0.0f, 0.4f);
}

TEST(MergeSurfaceShaders, UnlitSurfacesPassLight) {
    const CleanCompiled c(
        modelNetwork("ND_surface_unlit", {{"emission", 2.0f},
                                          {"emission_color", color(0.1f, 0.2f, 0.3f)},
                                          {"transmission", 0.5f},
                                          {"transmission_color", color(1.0f, 0.5f, 0.0f)},
                                          {"opacity", 0.8f}}));
    glm::vec3 passes(0.0f);
    float presence = 0.0f;
    const float opacity = c->opacity(ShadingPoint(), &passes, &presence);
    EXPECT_EQ(presence, 0.8f);
    // mix(1, transmission * colour, opacity)
    expectVector(passes * (1.0f - opacity), 0.6f, 0.4f, 0.2f);
    EXPECT_TRUE(c->hasEmission());
    expectVector(emission(c) * presence, 0.16f, 0.32f, 0.48f);
    expectVector(c.albedo(), 0.0f, 0.0f, 0.0f);
}

TEST(MergeSurfaceShaders, ThinAndSolidPartsKeepTheirWays) {
    const auto of = [&](std::vector<NetworkNode> nodes) {
        nodes.push_back(makeNode("glass", "ND_dielectric_bsdf",
                                 {{"scatter_mode", "RT"}, {"roughness", pair(0.0f)}}));
        return Compiled(makeNetwork(nodes));
    };
    const Compiled wall = of({surfaceOf("surface", "glass", {{"thin_walled", true}})});
    const Compiled half = of({surfaceOf("thin", "glass", {{"thin_walled", true}}),
                              surfaceOf("solid", "glass"), mixedShader("thin", "solid", 0.5f)});
    const float transmittance = 1.0f - opacity(wall);
    EXPECT_GT(transmittance, 0.9f);
    EXPECT_NEAR(1.0f - opacity(half), 0.5f * transmittance, 1e-5f);
    EXPECT_TRUE(half->hasTransmission());
    EXPECT_FALSE(wall->hasTransmission());
    // thin_walled that varies is the same mix.
    const Compiled varying =
        of({makeNode("uv", "ND_texcoord_vector2"),
            makeNode("u", "ND_separate2_vector2", {}, {{"in", "uv"}}),
            makeNode("is", "ND_ifgreater_boolean", {{"value2", 0.5f}}, {{"value1", "u.outx"}}),
            surfaceOf("surface", "glass", {}, {{"thin_walled", "is"}})});
    EXPECT_TRUE(nothingTold(varying));
    for (const float u : {0.0f, 1.0f}) {
        const PointWith point(*varying.program, {{"st", glm::vec4(u)}, {"UV0", glm::vec4(u)}});
        EXPECT_NEAR(1.0f - varying->opacity(point), u * transmittance, 1e-5f);
    }
}

TEST(MergeSurfaceShaders, DisplacementsAreMixed) {
    Network network = makeNetwork(
        {makeNode("surface", "ND_surface"),
         makeNode("up", "ND_displacement_float", {{"displacement", 2.0f}, {"scale", 0.5f}}),
         makeNode("aside", "ND_displacement_vector3",
                  {{"displacement", vector(1, 2, 3)}, {"scale", 2.0f}}),
         mixNode("mixed", "up", "aside", 0.25f, "ND_mix_displacementshader")});
    network.terminals["displacement"] = {"/m/mixed", ""};
    const CleanCompiled c(network);
    expectVector(c->displacement(ShadingPoint()), 1.5f, 3.0f, 4.75f);
}

TEST(MergeSurfaceShaders, VolumesAreMixed) {
    Network network =
        makeNetwork({makeNode("thick", "ND_anisotropic_vdf",
                              {{"absorption", vector(4, 2, 1)}, {"scattering", vector(8, 8, 8)}}),
                     makeNode("clear", "ND_absorption_vdf", {{"absorption", vector(0, 0, 1)}}),
                     makeNode("a", "ND_volume", {}, {{"vdf", "thick"}}),
                     makeNode("b", "ND_volume", {}, {{"vdf", "clear"}}),
                     mixNode("mixed", "a", "b", 0.25f, "ND_mix_volumeshader")});
    network.terminals = {{"volume", {"/m/mixed", ""}}};
    const CleanCompiled c(network);
    const Medium medium = c->interior(ShadingPoint());
    expectVector(medium.absorption, 1.0f, 0.5f, 1.0f);
    expectVector(medium.scattering(), 2.0f, 2.0f, 2.0f);
}

TEST(MergeSurfaceShaders, AMaterialThatHasNoSuchShaderIsNone) {
    Network network =
        makeNetwork({makeNode("m", "ND_surfacematerial"), makeNode("v", "ND_volumematerial")});
    network.terminals = {{"volume", {"/m/m", ""}}};
    const Compiled surface(network);
    EXPECT_EQ(warnings(surface), "/m/m [volume] surfacematerial is not a volume; it is ignored\n");
    EXPECT_FALSE(surface->hasInterior());
    network.terminals = {{"surface", {"/m/v", ""}}, {"displacement", {"/m/v", ""}}};
    EXPECT_EQ(warnings(Compiled(network)),
              "/m/v [displacement] volumematerial is not a displacement; it is ignored\n");
}

TEST(MergeSurfaceShaders, MediaOfMixedSurfacesAreMixed) {
    std::vector<NetworkNode> nodes = {mixedShader("a", "b", 0.25f)};
    for (const auto& [name, absorption] : {std::pair(std::string("a"), 4.0f), {"b", 1.0f}})
        for (const NetworkNode& node :
             {makeNode(name + "T", "ND_dielectric_bsdf", {{"scatter_mode", "RT"}}),
              makeNode(name + "V", "ND_absorption_vdf",
                       {{"absorption", vector(absorption, 2 * absorption, 0)}}),
              makeNode(name + "B", "ND_layer_vdf", {}, {{"top", name + "T"}, {"base", name + "V"}}),
              surfaceOf(name, name + "B")})
            nodes.push_back(node);
    const CleanCompiled c(makeNetwork(nodes));
    ASSERT_TRUE(c->hasInterior());
    expectVector(c->interior(ShadingPoint()).absorption, 1.75f, 3.5f, 0.0f);
}

// Everything that the models have at once, front and back, fits.
TEST(MergeSurfaceShaders, LargeModelsFit) {
    const auto everything = [](const std::string& name, float metalness) {
        Inputs inputs = {{"metalness", metalness}, {"thin_film_thickness", 300.0f}};
        for (const char* input : {"transmission", "subsurface", "sheen", "coat"})
            inputs[input] = 0.3f;
        return makeNode(name, "ND_standard_surface_surfaceshader", inputs);
    };
    const CleanCompiled c(modelNetwork(
        "ND_surfacematerial", {}, {{"surfaceshader", "front"}, {"backsurfaceshader", "c"}},
        {everything("a", 0.3f), everything("b", 0.4f), everything("c", 0.5f),
         mixNode("front", "a", "b", 0.5f, "ND_mix_surfaceshader")}));
    EXPECT_GT(c.lobes(direction(40.0f)).lobeCount(), 5);
    EXPECT_LE(c.albedo().y, 1.01f);
}

TEST(MergeSurfaceShaders, WhatIsNoSurfaceIsReportedOnce) {
    const Compiled c(
        makeNetwork({red, surfaceOf("a", "red"), makeNode("wave", "ND_displacement_float"),
                     makeNode("bad", "ND_surfacematerial", {}, {{"surfaceshader", "a"}}),
                     mixedShader("a", "wave", 0.5f)}));
    EXPECT_EQ(c.diagnostics.count(), 1) << warnings(c);
    expectVector(c.albedo(), 0.4f, 0.0f, 0.0f);
}

TEST(MergeSurfaceShaders, OverridesReachTheFront) {
    const Network network = modelNetwork(
        "ND_surfacematerial", {}, {{"surfaceshader", "front"}, {"backsurfaceshader", "behind"}},
        {makeNode("front", "ND_surface_unlit"), makeNode("behind", "ND_surface_unlit")});
    Diagnostics diagnostics;
    const Compiled c(applyOverrides(network, {{"emission", number(3.0f)}}, diagnostics));
    EXPECT_TRUE(nothingTold(diagnostics));
    EXPECT_EQ(emission(c).x, 3.0f);
    EXPECT_EQ(emission(c, back).x, 1.0f);
}

TEST(MergeSurfaceShaders, DocumentsHaveThem) {
    const CleanCompiled c(readOne(R"(
  <surface_unlit name="red" type="surfaceshader">
    <input name="emission_color" type="color3" value="1, 0, 0" /></surface_unlit>
  <surface_unlit name="green" type="surfaceshader">
    <input name="emission_color" type="color3" value="0, 1, 0" /></surface_unlit>
  <mix name="both" type="surfaceshader">
    <input name="fg" type="surfaceshader" nodename="red" />
    <input name="bg" type="surfaceshader" nodename="green" />
    <input name="mix" type="float" value="0.25" /></mix>
  <displacement name="bump" type="displacementshader">
    <input name="displacement" type="float" value="0.5" /></displacement>
  <surfacematerial name="m" type="material">
    <input name="surfaceshader" type="surfaceshader" nodename="both" />
    <input name="backsurfaceshader" type="surfaceshader" nodename="green" />
    <input name="displacementshader" type="displacementshader" nodename="bump" />
  </surfacematerial>
  )"));
    expectVector(emission(c), 0.25f, 0.75f, 0.0f);
    expectVector(emission(c, back), 0.0f, 1.0f, 0.0f);
    expectVector(c->displacement(ShadingPoint()), 0.0f, 0.0f, 0.5f);
}
