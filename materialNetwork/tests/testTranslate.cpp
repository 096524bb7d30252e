// SPDX-License-Identifier: Apache-2.0
// Translations between shading models.
#include "materialNetwork/tests/patternFixture.h"

#include "materialNetwork/nodes/models.h"
#include "materialNetwork/network/translate.h"

#include <cstring>

namespace patina {

namespace {

Network modelNetwork(const std::string& id, Inputs inputs, Connections connections = {},
                     std::vector<NetworkNode> others = {}) {
    others.push_back(makeNode("surface", id, std::move(inputs), std::move(connections)));
    return makeNetwork(std::move(others));
}

Network translated(const Network& network, const std::string& target) {
    Diagnostics diagnostics;
    Network result = translateMaterial(network, target, diagnostics);
    EXPECT_EQ(diagnostics.count(), 0) << warnings(diagnostics);
    return result;
}

/// The value of an input of the surface node after everything is folded.
std::vector<float> folded(const Network& network, const std::string& input) {
    Diagnostics diagnostics;
    const NetworkNode* surface = network.find("/m/surface");
    EXPECT_NE(surface, nullptr);
    const auto c =
        surface ? surface->connections.find(input) : decltype(surface->connections.end())();
    if (!surface || c == surface->connections.end()) {
        ADD_FAILURE() << input << " is not translated";
        return {};
    }
    Network probe = network;
    NetworkNode edf = makeNode("edf", "ND_uniform_edf");
    edf.connections["color"] = c->second;
    probe.nodes.push_back(edf);
    probe.nodes.push_back(makeNode("light", "ND_surface", {}, {{"edf", {"edf", ""}}}));
    probe.terminals = {{"surface", {"/m/light", ""}}};
    const glm::vec3 v = emitted(probe);
    return {v.x, v.y, v.z};
}

float number1(const Network& network, const std::string& input) {
    const auto v = folded(network, input);
    return v.empty() ? NAN : v[0];
}

glm::vec3 albedoOf(const Network& network, float theta) {
    Compiled c(network);
    EXPECT_EQ(c.diagnostics.count(), 0) << warnings(c.diagnostics);
    ShadingPoint point;
    point.viewDirection = direction(theta);
    Bsdf bsdf;
    c.program->evaluate(point, bsdf);
    return bsdf.albedo();
}

} // namespace

TEST(Translate, AllPairsAreWellTyped) {
    const std::vector<std::string> models = translatableModels();
    ASSERT_EQ(models.size(), 4u);
    for (const std::string& from : models)
        for (const std::string& to : models) {
            SCOPED_TRACE(from + " to " + to);
            Inputs inputs;
            for (const InputDef& input : ModelLibrary::get().find(from)->def.inputs)
                if (input.geomprop.empty() && input.name != "normal" && input.notModelled.empty() &&
                    (input.type == ValueType::Float || input.type == ValueType::Color3)) {
                    Value value = input.value;
                    value.numbers.assign(value.numbers.size(), 0.37f);
                    inputs[input.name] = value;
                }
            Compiled c(translated(modelNetwork(from, inputs), to));
            EXPECT_EQ(c.diagnostics.count(), 0) << warnings(c.diagnostics);
        }
}

TEST(Translate, OutputsNameInputsOfTheTarget) {
    for (const auto& model : ModelLibrary::get().all()) {
        const size_t at = model->def.category.find("_to_");
        if (at == std::string::npos) continue;
        const ShadingModel* target = ModelLibrary::get().find(model->def.category.substr(at + 4));
        ASSERT_NE(target, nullptr) << model->def.category;
        for (const OutputDef& output : model->def.outputs) {
            const int i = target->def.findInput(output.name.substr(0, output.name.rfind("_out")));
            ASSERT_GE(i, 0) << output.name;
            EXPECT_EQ(target->def.inputs[size_t(i)].type, output.type) << output.name;
        }
    }
}

TEST(Translate, StandardSurfaceThroughOpenPbrAndBack) {
    const Network there =
        translated(modelNetwork("standard_surface", {{"base", number(0.9f)},
                                                     {"base_color", color(0.1f, 0.5f, 0.7f)},
                                                     {"specular_roughness", number(0.4f)},
                                                     {"specular_anisotropy", number(0.6f)},
                                                     {"coat", number(0.3f)},
                                                     {"coat_roughness", number(0.0f)},
                                                     {"sheen_roughness", number(0.25f)},
                                                     {"thin_film_thickness", number(300.0f)},
                                                     {"transmission_dispersion", number(30.0f)}}),
                   "open_pbr_surface");
    EXPECT_NEAR(number1(there, "thin_film_thickness"), 0.3f, 1e-5f);
    EXPECT_NEAR(number1(there, "coat_darkening"), 0.0f, 1e-6f);
    // Widths along and across: alpha 0.16 / sqrt(0.4) and 0.16 * sqrt(0.4), by OpenPBR's formulas.
    const float a = 0.6f, r = number1(there, "specular_roughness");
    const float along = r * r * std::sqrt(2.0f / (1.0f + (1 - a) * (1 - a)));
    EXPECT_NEAR(along, 0.16f / std::sqrt(0.4f), 1e-4f);
    EXPECT_NEAR(along * (1 - a), 0.16f * std::sqrt(0.4f), 1e-4f);
    const Network back = translated(there, "standard_surface");
    for (const auto& [input, value] : {std::pair{"base", 0.9f},
                                       {"specular_roughness", 0.4f},
                                       {"specular_anisotropy", 0.6f},
                                       {"coat", 0.3f},
                                       {"sheen_roughness", 0.25f},
                                       {"thin_film_thickness", 300.0f},
                                       {"transmission_dispersion", 30.0f},
                                       {"specular_IOR", 1.5f}})
        EXPECT_NEAR(number1(back, input), value, 1e-4f * std::max(1.0f, value)) << input;
    expectVector(glm::vec3(folded(back, "base_color")[0], folded(back, "base_color")[1],
                           folded(back, "base_color")[2]),
                 0.1f, 0.5f, 0.7f);
}

TEST(Translate, StandardSurfaceThroughGltfAndBack) {
    const Network there =
        translated(modelNetwork("standard_surface", {{"specular_roughness", number(0.5f)},
                                                     {"specular_anisotropy", number(0.3f)},
                                                     {"specular_rotation", number(0.125f)},
                                                     {"metalness", number(0.7f)},
                                                     {"sheen", number(0.5f)},
                                                     {"sheen_color", color(1, 0.5f, 0.25f)},
                                                     {"sheen_roughness", number(0.36f)},
                                                     {"opacity", grey(0.5f)}}),
                   "gltf_pbr");
    EXPECT_EQ(number1(there, "alpha_mode"), 2.0f);
    EXPECT_NEAR(number1(there, "sheen_roughness"), 0.6f, 1e-5f);
    const Network back = translated(there, "standard_surface");
    for (const auto& [input, value] : {std::pair{"specular_roughness", 0.5f},
                                       {"specular_anisotropy", 0.3f},
                                       {"specular_rotation", 0.125f},
                                       {"metalness", 0.7f},
                                       {"sheen", 0.5f},
                                       {"sheen_roughness", 0.36f},
                                       {"opacity", 0.5f}})
        EXPECT_NEAR(number1(back, input), value, 1e-4f) << input;
}

TEST(Translate, PreviewSurfaceKeepsReflectance) {
    // Half of the specular of ior 1.5: F0 = 0.02, which is ior (1 + r) / (1 - r), r = sqrt(0.02).
    const Network half = translated(modelNetwork("standard_surface", {{"specular", number(0.5f)}}),
                                    "UsdPreviewSurface");
    EXPECT_NEAR(number1(half, "ior"), (1 + std::sqrt(0.02f)) / (1 - std::sqrt(0.02f)), 1e-4f);
    const Network glass =
        translated(modelNetwork("UsdPreviewSurface", {{"opacity", number(0.0f)}}), "gltf_pbr");
    EXPECT_NEAR(number1(glass, "transmission"), 1.0f, 1e-6f);
    EXPECT_NEAR(number1(glass, "alpha"), 1.0f, 1e-6f);
    const Network leaf =
        translated(modelNetwork("UsdPreviewSurface",
                                {{"opacity", number(0.3f)}, {"opacityThreshold", number(0.5f)}}),
                   "open_pbr_surface");
    EXPECT_NEAR(number1(leaf, "geometry_opacity"), 0.0f, 1e-6f);
    const Network shiny =
        translated(modelNetwork("UsdPreviewSurface", {{"useSpecularWorkflow", Value::makeInt(1)},
                                                      {"specularColor", color(0.5f, 0.25f, 0)}}),
                   "standard_surface");
    expectVector(glm::vec3(folded(shiny, "specular_color")[0], folded(shiny, "specular_color")[1],
                           folded(shiny, "specular_color")[2]),
                 1, 0.5f, 0);
    const float root = std::sqrt(0.5f);
    EXPECT_NEAR(number1(shiny, "specular_IOR"), (1 + root) / (1 - root), 1e-3f);
}

// The same material in another model's words reflects about as much. The tolerance is what the
// models differ by, measured, with a margin.
TEST(Translate, AlbedoStays) {
    const Inputs plastic = {{"base_color", color(0.2f, 0.5f, 0.8f)},
                            {"base", number(1.0f)},
                            {"specular_roughness", number(0.4f)}};
    const Inputs metal = {{"base_color", color(0.9f, 0.6f, 0.3f)},
                          {"base", number(1.0f)},
                          {"metalness", number(1.0f)},
                          {"specular_roughness", number(0.3f)}};
    for (const Inputs& inputs : {plastic, metal})
        for (const char* target : {"open_pbr_surface", "gltf_pbr", "UsdPreviewSurface"})
            for (const float theta : {0.0f, 60.0f}) {
                const Network source = modelNetwork("standard_surface", inputs);
                glm::vec3 a = albedoOf(source, theta);
                const glm::vec3 b = albedoOf(translated(source, target), theta);
                // Metals of Standard Surface have a white edge, which the others lack; those of
                // UsdPreviewSurface reflect the same at all angles.
                bool edge = inputs.count("metalness") && theta > 0.0f;
                if (edge && !std::strcmp(target, "UsdPreviewSurface")) {
                    a = albedoOf(source, 0.0f);
                    edge = false;
                }
                EXPECT_LT(glm::length(a - b), edge ? 0.2f : 0.02f) << target << " at " << theta;
            }
}

TEST(Translate, WhatCannotBeTranslatedIsReported) {
    Diagnostics diagnostics;
    EXPECT_TRUE(
        translateMaterial(makeNetwork({makeNode("surface", "ND_surface")}), "gltf_pbr", diagnostics)
            .empty());
    EXPECT_EQ(diagnostics.count(), 1);
    EXPECT_TRUE(translateMaterial(modelNetwork("gltf_pbr", {}), "nothing", diagnostics).empty());
    EXPECT_TRUE(translateMaterial(Network(), "gltf_pbr", diagnostics).empty());
    EXPECT_EQ(diagnostics.count(), 3) << warnings(diagnostics);
}

} // namespace patina
