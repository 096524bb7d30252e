// SPDX-License-Identifier: Apache-2.0
// Translations between shading models.
#include "materialNetwork/tests/patternFixture.h"

#include "materialNetwork/nodes/models.h"
#include "materialNetwork/network/translate.h"

#include <cstring>

using namespace patina;

namespace {

using Values = std::map<std::string, float>;

Network translated(const Network& network, const std::string& target) {
    Diagnostics diagnostics;
    Network result = translateMaterial(network, target, diagnostics);
    EXPECT_TRUE(nothingTold(diagnostics));
    return result;
}

/// The value of an input of the surface node after everything is folded.
glm::vec3 foldedInput(Network network, const std::string& input) {
    const NetworkNode* surface = network.find("/m/surface");
    if (!surface || !surface->connections.count(input)) {
        ADD_FAILURE() << input << " is not translated";
        return glm::vec3(NAN);
    }
    NetworkNode edf = makeNode("edf", "ND_uniform_edf");
    edf.connections["color"] = surface->connections.at(input);
    network.nodes.push_back(edf);
    network.nodes.push_back(makeNode("light", "ND_surface", {}, {{"edf", "edf"}}));
    network.terminals = {{"surface", {"/m/light", ""}}};
    return emitted(network);
}

/// Inputs of a surface node, numbers, are these after everything is folded.
void expectInputs(const Network& network, const Values& expected, float tolerance = 1e-4f) {
    for (const auto& [input, value] : expected)
        EXPECT_NEAR(foldedInput(network, input).x, value, tolerance * std::max(1.0f, value))
            << input;
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
            EXPECT_TRUE(nothingTold(Compiled(translated(modelNetwork(from, inputs), to))));
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
    Values kept = {{"base", 0.9f},
                   {"specular_roughness", 0.4f},
                   {"specular_anisotropy", 0.6f},
                   {"coat", 0.3f},
                   {"sheen_roughness", 0.25f},
                   {"thin_film_thickness", 300.0f},
                   {"transmission_dispersion", 30.0f}};
    Inputs inputs(kept.begin(), kept.end());
    inputs["base_color"] = color(0.1f, 0.5f, 0.7f);
    inputs["coat_roughness"] = 0.0f;
    const Network there = translated(modelNetwork("standard_surface", inputs), "open_pbr_surface");
    expectInputs(there, {{"thin_film_thickness", 0.3f}, {"coat_darkening", 0.0f}}, 1e-6f);
    // Widths along and across: alpha 0.16 / sqrt(0.4) and 0.16 * sqrt(0.4), by OpenPBR's formulas.
    const float a = 0.6f, r = foldedInput(there, "specular_roughness").x;
    const float along = r * r * std::sqrt(2.0f / (1.0f + (1 - a) * (1 - a)));
    EXPECT_NEAR(along, 0.16f / std::sqrt(0.4f), 1e-4f);
    EXPECT_NEAR(along * (1 - a), 0.16f * std::sqrt(0.4f), 1e-4f);
    const Network back = translated(there, "standard_surface");
    kept["specular_IOR"] = 1.5f;
    expectInputs(back, kept);
    expectVector(foldedInput(back, "base_color"), 0.1f, 0.5f, 0.7f);
}

TEST(Translate, StandardSurfaceThroughGltfAndBack) {
    Values kept = {{"specular_roughness", 0.5f},
                   {"specular_anisotropy", 0.3f},
                   {"specular_rotation", 0.125f},
                   {"metalness", 0.7f},
                   {"sheen", 0.5f},
                   {"sheen_roughness", 0.36f}};
    Inputs inputs(kept.begin(), kept.end());
    inputs["sheen_color"] = color(1, 0.5f, 0.25f);
    inputs["opacity"] = grey(0.5f);
    const Network there = translated(modelNetwork("standard_surface", inputs), "gltf_pbr");
    EXPECT_EQ(foldedInput(there, "alpha_mode").x, 2.0f);
    expectInputs(there, {{"sheen_roughness", 0.6f}}, 1e-5f);
    kept["opacity"] = 0.5f;
    expectInputs(translated(there, "standard_surface"), kept);
}

TEST(Translate, PreviewSurfaceKeepsReflectance) {
    // Of the F0 that an ior has, with r = sqrt(F0), it is (1 + r) / (1 - r).
    const auto iorOf = [](float f0) { return (1 + std::sqrt(f0)) / (1 - std::sqrt(f0)); };
    // Half of the specular of ior 1.5: F0 = 0.02.
    expectInputs(
        translated(modelNetwork("standard_surface", {{"specular", 0.5f}}), "UsdPreviewSurface"),
        {{"ior", iorOf(0.02f)}});
    expectInputs(translated(previewNetwork({{"opacity", 0.0f}}), "gltf_pbr"),
                 {{"transmission", 1.0f}, {"alpha", 1.0f}}, 1e-6f);
    expectInputs(translated(previewNetwork({{"opacity", 0.3f}, {"opacityThreshold", 0.5f}}),
                            "open_pbr_surface"),
                 {{"geometry_opacity", 0.0f}}, 1e-6f);
    const Network shiny = translated(
        previewNetwork({{"useSpecularWorkflow", 1}, {"specularColor", color(0.5f, 0.25f, 0)}}),
        "standard_surface");
    expectVector(foldedInput(shiny, "specular_color"), 1, 0.5f, 0);
    expectInputs(shiny, {{"specular_IOR", iorOf(0.5f)}});
}

// The same material in another model's words reflects about as much. The tolerance is what the
// models differ by, measured, with a margin.
TEST(Translate, AlbedoStays) {
    const Inputs plastic = {
        {"base_color", color(0.2f, 0.5f, 0.8f)}, {"base", 1.0f}, {"specular_roughness", 0.4f}};
    const Inputs metal = {{"base_color", color(0.9f, 0.6f, 0.3f)},
                          {"base", 1.0f},
                          {"metalness", 1.0f},
                          {"specular_roughness", 0.3f}};
    for (const Inputs& inputs : {plastic, metal})
        for (const char* target : {"open_pbr_surface", "gltf_pbr", "UsdPreviewSurface"})
            for (const float theta : {0.0f, 60.0f}) {
                const Network source = modelNetwork("standard_surface", inputs);
                glm::vec3 a = albedoOf(source, direction(theta));
                const glm::vec3 b = albedoOf(translated(source, target), direction(theta));
                // Metals of Standard Surface have a white edge, which the others lack; those of
                // UsdPreviewSurface reflect the same at all angles.
                bool edge = inputs.count("metalness") && theta > 0.0f;
                if (edge && !std::strcmp(target, "UsdPreviewSurface")) {
                    a = albedoOf(source);
                    edge = false;
                }
                EXPECT_LT(glm::length(a - b), edge ? 0.2f : 0.02f) << target << " at " << theta;
            }
}

TEST(Translate, WhatCannotBeTranslatedIsReported) {
    Diagnostics diagnostics;
    EXPECT_TRUE(translateMaterial(modelNetwork("ND_surface"), "gltf_pbr", diagnostics).empty());
    EXPECT_EQ(diagnostics.count(), 1);
    EXPECT_TRUE(translateMaterial(modelNetwork("gltf_pbr"), "nothing", diagnostics).empty());
    EXPECT_TRUE(translateMaterial(Network(), "gltf_pbr", diagnostics).empty());
    EXPECT_EQ(diagnostics.count(), 3) << warnings(diagnostics);
}
