// SPDX-License-Identifier: Apache-2.0
// Mixes of whole shaders, back shaders, unlit surfaces: one program that acts as its parts do.
#include "materialNetwork/tests/materialFixture.h"

#include "materialNetwork/mtlx/document.h"

#include <filesystem>
#include <fstream>

namespace patina {

namespace {

void expectColor(const glm::vec3& value, float r, float g, float b, float tolerance = 1e-5f) {
    EXPECT_NEAR(value.x, r, tolerance);
    EXPECT_NEAR(value.y, g, tolerance);
    EXPECT_NEAR(value.z, b, tolerance);
}

ShadingPoint seenFrom(const glm::vec3& wo) {
    ShadingPoint point;
    point.viewDirection = wo;
    return point;
}

glm::vec3 albedo(const Compiled& c, const glm::vec3& wo = {0, 0, 1}) {
    Bsdf bsdf;
    c.program->evaluate(seenFrom(wo), bsdf);
    return bsdf.albedo();
}

NetworkNode lambert(const std::string& name, const Value& tint) {
    return makeNode(name, "ND_oren_nayar_diffuse_bsdf", {{"color", tint}});
}

NetworkNode surfaceOf(const std::string& name, const std::string& bsdf, Inputs inputs = {},
                      const std::string& edf = "") {
    Connections c = {{"bsdf", {bsdf, ""}}};
    if (!edf.empty()) c["edf"] = {edf, ""};
    return makeNode(name, "ND_surface", std::move(inputs), std::move(c));
}

NetworkNode mixOf(const char* id, const char* fg, const char* bg, float amount) {
    return makeNode("surface", id, {{"mix", number(amount)}}, {{"fg", {fg, ""}}, {"bg", {bg, ""}}});
}

const glm::vec3 back(0, 0, -1);

} // namespace

TEST(MergeSurfaceShaders, MixesCountByTheirPresence) {
    const auto mixed = [](float opacityA, float opacityB, float m) {
        return std::vector<NetworkNode>{
            lambert("red", color(0.8f, 0.0f, 0.0f)),
            lambert("blue", color(0.0f, 0.0f, 0.4f)),
            makeNode("glow", "ND_uniform_edf", {{"color", grey(3.0f)}}),
            surfaceOf("a", "red", {{"opacity", number(opacityA)}}, "glow"),
            surfaceOf("b", "blue", {{"opacity", number(opacityB)}}),
            mixOf("ND_mix_surfaceshader", "a", "b", m)};
    };
    Compiled even(makeNetwork(mixed(1.0f, 1.0f, 0.25f)));
    EXPECT_EQ(warnings(even.diagnostics), "");
    EXPECT_TRUE(even.program->isOpaque());
    expectColor(albedo(even), 0.2f, 0.0f, 0.3f);
    expectColor(even.program->emission(ShadingPoint(), {0, 0, 1}), 0.75f, 0.75f, 0.75f);

    // Presence 0.25 * 0.2 + 0.75 * 0.6 = 0.5, of which the red part has 0.05.
    Compiled uneven(makeNetwork(mixed(0.2f, 0.6f, 0.25f)));
    EXPECT_NEAR(uneven.program->opacity(ShadingPoint()), 0.5f, 1e-6f);
    expectColor(albedo(uneven) * 0.5f, 0.05f * 0.8f, 0.0f, 0.45f * 0.4f);
    expectColor(uneven.program->emission(ShadingPoint(), {0, 0, 1}) * 0.5f, 0.15f, 0.15f, 0.15f);

    Compiled absent(makeNetwork(mixed(0.0f, 0.0f, 0.25f)));
    EXPECT_EQ(absent.program->opacity(ShadingPoint()), 0.0f);
    Compiled chosen(makeNetwork(mixed(0.2f, 0.6f, 1.0f)));
    expectColor(albedo(chosen), 0.8f, 0.0f, 0.0f);
    EXPECT_NEAR(chosen.program->opacity(ShadingPoint()), 0.2f, 1e-6f);
}

TEST(MergeSurfaceShaders, MixesOfModelsNestAndVaryOverTheSurface) {
    std::vector<NetworkNode> nodes = {
        makeNode("paint", "ND_standard_surface_surfaceshader",
                 {{"base_color", color(1, 0, 0)}, {"specular", number(0.0f)}}),
        makeNode("lamp", "ND_surface_unlit", {{"emission_color", color(0, 1, 0)}}),
        makeNode("inner", "ND_mix_surfaceshader", {{"mix", number(0.5f)}},
                 {{"fg", {"paint", ""}}, {"bg", {"lamp", ""}}}),
        makeNode("uv", "ND_texcoord_vector2"),
        makeNode("u", "ND_separate2_vector2", {}, {{"in", {"uv", ""}}}),
        makeNode("surface", "ND_mix_surfaceshader", {},
                 {{"fg", {"inner", ""}}, {"bg", {"lamp", ""}}, {"mix", {"u", "outx"}}})};
    Compiled c(makeNetwork(nodes));
    EXPECT_EQ(warnings(c.diagnostics), "");
    for (const float u : {0.0f, 0.5f, 1.0f}) {
        const FakePrimvars primvars(*c.program, {{"st", glm::vec4(u)}, {"UV0", glm::vec4(u)}});
        ShadingPoint point;
        point.primvars = &primvars;
        Bsdf bsdf;
        c.program->evaluate(point, bsdf);
        expectColor(bsdf.albedo(), 0.5f * u, 0.0f, 0.0f, 1e-4f);
        expectColor(c.program->emission(point, {0, 0, 1}), 0.0f, 1.0f - 0.5f * u, 0.0f);
    }
}

TEST(MergeSurfaceShaders, BackShadersShowFromBehind) {
    const std::vector<NetworkNode> parts = {
        lambert("red", color(0.8f, 0.0f, 0.0f)), lambert("blue", color(0.0f, 0.0f, 0.4f)),
        surfaceOf("front", "red"), surfaceOf("behind", "blue", {{"opacity", number(0.5f)}})};
    const auto material = [&](const Connections& c) {
        std::vector<NetworkNode> nodes = parts;
        nodes.push_back(makeNode("surface", "ND_surfacematerial", {}, c));
        nodes.push_back(makeNode("empty", "ND_surface"));
        return makeNetwork(nodes);
    };
    Compiled both(
        material({{"surfaceshader", {"front", ""}}, {"backsurfaceshader", {"behind", ""}}}));
    EXPECT_EQ(warnings(both.diagnostics), "");
    expectColor(albedo(both), 0.8f, 0.0f, 0.0f);
    expectColor(albedo(both, back), 0.0f, 0.0f, 0.4f);
    EXPECT_EQ(both.program->opacity(seenFrom({0, 0, 1})), 1.0f);
    EXPECT_EQ(both.program->opacity(seenFrom(back)), 0.5f);

    for (const Connections& c :
         {Connections{{"surfaceshader", {"front", ""}}},
          Connections{{"surfaceshader", {"front", ""}}, {"backsurfaceshader", {"empty", ""}}}}) {
        Compiled twoSided(material(c));
        expectColor(albedo(twoSided), 0.8f, 0.0f, 0.0f);
        expectColor(albedo(twoSided, back), 0.8f, 0.0f, 0.0f);
    }
    Compiled alone(material({{"backsurfaceshader", {"behind", ""}}}));
    EXPECT_EQ(alone.program->opacity(seenFrom({0, 0, 1})), 0.0f);
    EXPECT_EQ(alone.program->opacity(seenFrom(back)), 0.5f);
    expectColor(albedo(alone, back), 0.0f, 0.0f, 0.4f);
}

TEST(MergeSurfaceShaders, UnlitSurfacesPassLight) {
    Compiled c(makeNetwork({makeNode("surface", "ND_surface_unlit",
                                     {{"emission", number(2.0f)},
                                      {"transmission", number(0.5f)},
                                      {"transmission_color", color(1.0f, 0.5f, 0.0f)},
                                      {"opacity", number(0.8f)}})}));
    EXPECT_EQ(warnings(c.diagnostics), "");
    glm::vec3 passes(0.0f);
    float presence = 0.0f;
    const float opacity = c.program->opacity(ShadingPoint(), &passes, &presence);
    EXPECT_EQ(presence, 0.8f);
    // mix(1, transmission * colour, opacity)
    expectColor(passes * (1.0f - opacity), 0.6f, 0.4f, 0.2f);
    expectColor(c.program->emission(ShadingPoint(), {0, 0, 1}) * presence, 1.6f, 1.6f, 1.6f);
    expectColor(albedo(c), 0.0f, 0.0f, 0.0f);
}

TEST(MergeSurfaceShaders, ThinAndSolidPartsKeepTheirWays) {
    const NetworkNode glass = makeNode("glass", "ND_dielectric_bsdf",
                                       {{"scatter_mode", text("RT")}, {"roughness", pair(0.0f)}});
    const auto of = [&](std::vector<NetworkNode> more) {
        more.insert(more.begin(), glass);
        return Compiled(makeNetwork(more));
    };
    const Compiled wall =
        of({surfaceOf("surface", "glass", {{"thin_walled", Value::makeBool(1)}})});
    const Compiled half =
        of({surfaceOf("thin", "glass", {{"thin_walled", Value::makeBool(1)}}),
            surfaceOf("solid", "glass"), mixOf("ND_mix_surfaceshader", "thin", "solid", 0.5f)});
    const float transmittance = 1.0f - wall.program->opacity(ShadingPoint());
    EXPECT_GT(transmittance, 0.9f);
    EXPECT_NEAR(1.0f - half.program->opacity(ShadingPoint()), 0.5f * transmittance, 1e-5f);
    EXPECT_TRUE(half.program->hasTransmission());
    EXPECT_FALSE(wall.program->hasTransmission());
    // thin_walled that varies is the same mix.
    const Compiled varying = of({makeNode("uv", "ND_texcoord_vector2"),
                                 makeNode("u", "ND_separate2_vector2", {}, {{"in", {"uv", ""}}}),
                                 makeNode("is", "ND_ifgreater_boolean", {{"value2", number(0.5f)}},
                                          {{"value1", {"u", "outx"}}}),
                                 makeNode("surface", "ND_surface", {},
                                          {{"bsdf", {"glass", ""}}, {"thin_walled", {"is", ""}}})});
    EXPECT_EQ(warnings(varying.diagnostics), "");
    for (const float u : {0.0f, 1.0f}) {
        const FakePrimvars primvars(*varying.program,
                                    {{"st", glm::vec4(u)}, {"UV0", glm::vec4(u)}});
        ShadingPoint point;
        point.primvars = &primvars;
        EXPECT_NEAR(1.0f - varying.program->opacity(point), u * transmittance, 1e-5f);
    }
}

TEST(MergeSurfaceShaders, DisplacementsAreMixed) {
    Network network = makeNetwork(
        {makeNode("surface", "ND_surface"),
         makeNode("up", "ND_displacement_float",
                  {{"displacement", number(2.0f)}, {"scale", number(0.5f)}}),
         makeNode("aside", "ND_displacement_vector3",
                  {{"displacement", Value::makeVec3(1, 2, 3)}, {"scale", number(2.0f)}}),
         makeNode("mixed", "ND_mix_displacementshader", {{"mix", number(0.25f)}},
                  {{"fg", {"up", ""}}, {"bg", {"aside", ""}}})});
    network.terminals["displacement"] = {"/m/mixed", ""};
    Compiled c(network);
    EXPECT_EQ(warnings(c.diagnostics), "");
    expectColor(c.program->displacement(ShadingPoint()), 1.5f, 3.0f, 4.75f);
}

TEST(MergeSurfaceShaders, VolumesAreMixed) {
    Network network;
    network.path = "/m";
    network.nodes = {
        makeNode(
            "thick", "ND_anisotropic_vdf",
            {{"absorption", Value::makeVec3(4, 2, 1)}, {"scattering", Value::makeVec3(8, 8, 8)}}),
        makeNode("clear", "ND_absorption_vdf", {{"absorption", Value::makeVec3(0, 0, 1)}}),
        makeNode("a", "ND_volume", {}, {{"vdf", {"thick", ""}}}),
        makeNode("b", "ND_volume", {}, {{"vdf", {"clear", ""}}}),
        makeNode("mixed", "ND_mix_volumeshader", {{"mix", number(0.25f)}},
                 {{"fg", {"a", ""}}, {"bg", {"b", ""}}})};
    network.terminals["volume"] = {"/m/mixed", ""};
    Compiled c(network);
    EXPECT_EQ(warnings(c.diagnostics), "");
    const Medium medium = c.program->interior(ShadingPoint());
    expectColor(medium.absorption, 1.0f, 0.5f, 1.0f);
    expectColor(medium.scattering(), 2.0f, 2.0f, 2.0f);
}

TEST(MergeSurfaceShaders, AMaterialThatHasNoSuchShaderIsNone) {
    Network network;
    network.path = "/m";
    network.nodes = {makeNode("m", "ND_surfacematerial", {}),
                     makeNode("v", "ND_volumematerial", {})};
    network.terminals["volume"] = {"/m/m", ""};
    Compiled surface(network);
    EXPECT_EQ(warnings(surface.diagnostics),
              "/m/m [volume] surfacematerial is not a volume; it is ignored\n");
    EXPECT_FALSE(surface.program->hasInterior());
    network.terminals = {{"surface", {"/m/v", ""}}, {"displacement", {"/m/v", ""}}};
    Compiled volume(network);
    EXPECT_EQ(warnings(volume.diagnostics),
              "/m/v [displacement] volumematerial is not a displacement; it is ignored\n");
}

TEST(MergeSurfaceShaders, MediaOfMixedSurfacesAreMixed) {
    const auto glass = [](const std::string& name, float absorption) {
        return std::vector<NetworkNode>{
            makeNode(name + "T", "ND_dielectric_bsdf", {{"scatter_mode", text("RT")}}),
            makeNode(name + "V", "ND_absorption_vdf",
                     {{"absorption", Value::makeVec3(absorption, 0, 0)}}),
            makeNode(name + "B", "ND_layer_vdf", {},
                     {{"top", {name + "T", ""}}, {"base", {name + "V", ""}}}),
            surfaceOf(name, name + "B")};
    };
    std::vector<NetworkNode> nodes = glass("a", 4.0f);
    for (const NetworkNode& node : glass("b", 1.0f))
        nodes.push_back(node);
    nodes.push_back(mixOf("ND_mix_surfaceshader", "a", "b", 0.25f));
    Compiled c(makeNetwork(nodes));
    EXPECT_EQ(warnings(c.diagnostics), "");
    EXPECT_NEAR(c.program->interior(ShadingPoint()).absorption.x, 1.75f, 1e-5f);
}

// Everything that the models have at once, front and back, fits.
TEST(MergeSurfaceShaders, LargeModelsFit) {
    const auto everything = [](const std::string& name, float metalness) {
        return makeNode(name, "ND_standard_surface_surfaceshader",
                        {{"metalness", number(metalness)},
                         {"transmission", number(0.3f)},
                         {"subsurface", number(0.3f)},
                         {"sheen", number(0.3f)},
                         {"coat", number(0.3f)},
                         {"thin_film_thickness", number(300.0f)}});
    };
    Compiled c(makeNetwork(
        {everything("a", 0.3f), everything("b", 0.4f), everything("c", 0.5f),
         makeNode("front", "ND_mix_surfaceshader", {{"mix", number(0.5f)}},
                  {{"fg", {"a", ""}}, {"bg", {"b", ""}}}),
         makeNode("surface", "ND_surfacematerial", {},
                  {{"surfaceshader", {"front", ""}}, {"backsurfaceshader", {"c", ""}}})}));
    EXPECT_EQ(warnings(c.diagnostics), "");
    Bsdf bsdf;
    c.program->evaluate(seenFrom(direction(40.0f)), bsdf);
    EXPECT_GT(bsdf.lobeCount(), 5);
    EXPECT_LE(albedo(c).y, 1.01f);
}

TEST(MergeSurfaceShaders, WhatIsNoSurfaceIsReportedOnce) {
    Compiled c(
        makeNetwork({lambert("red", color(0.8f, 0.0f, 0.0f)), surfaceOf("a", "red"),
                     makeNode("wave", "ND_displacement_float"),
                     makeNode("bad", "ND_surfacematerial", {}, {{"surfaceshader", {"a", ""}}}),
                     makeNode("surface", "ND_mix_surfaceshader", {{"mix", number(0.5f)}},
                              {{"fg", {"a", ""}}, {"bg", {"wave", ""}}})}));
    EXPECT_EQ(c.diagnostics.count(), 1) << warnings(c.diagnostics);
    expectColor(albedo(c), 0.4f, 0.0f, 0.0f);
}

TEST(MergeSurfaceShaders, OverridesReachTheFront) {
    const Network network = makeNetwork(
        {makeNode("front", "ND_surface_unlit"), makeNode("behind", "ND_surface_unlit"),
         makeNode("surface", "ND_surfacematerial", {},
                  {{"surfaceshader", {"front", ""}}, {"backsurfaceshader", {"behind", ""}}})});
    Diagnostics diagnostics;
    const Network changed = applyOverrides(network, {{"emission", number(3.0f)}}, diagnostics);
    EXPECT_EQ(warnings(diagnostics), "");
    Compiled c(changed);
    EXPECT_EQ(c.program->emission(seenFrom({0, 0, 1}), {0, 0, 1}).x, 3.0f);
    EXPECT_EQ(c.program->emission(seenFrom(back), back).x, 1.0f);
}

TEST(MergeSurfaceShaders, DocumentsHaveThem) {
    const std::string path =
        (std::filesystem::temp_directory_path() / "patinaMergeSurfaceShaders.mtlx").string();
    std::ofstream(path) << R"(<?xml version="1.0"?>
<materialx version="1.39">
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
</materialx>)";
    Diagnostics diagnostics;
    const std::vector<Network> networks = readMtlx(path, diagnostics);
    std::filesystem::remove(path);
    ASSERT_EQ(networks.size(), 1u);
    Compiled c(networks[0]);
    EXPECT_EQ(warnings(diagnostics) + warnings(c.diagnostics), "");
    expectColor(c.program->emission(seenFrom({0, 0, 1}), {0, 0, 1}), 0.25f, 0.75f, 0.0f);
    expectColor(c.program->emission(seenFrom(back), back), 0.0f, 1.0f, 0.0f);
    expectColor(c.program->displacement(ShadingPoint()), 0.0f, 0.0f, 0.5f);
}

} // namespace patina
