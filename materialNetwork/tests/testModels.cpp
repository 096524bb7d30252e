// The shading models that come with the library.
#include "materialNetwork/tests/materialTest.h"

#include "materialNetwork/models.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>

namespace patina {

namespace {

Network modelNetwork(const std::string& id, Inputs inputs = {}) {
    return makeNetwork({makeNode("surface", id, std::move(inputs))});
}

glm::vec3 albedoAt(const Network& network, float theta) {
    Compiled c(network);
    EXPECT_EQ(c.diagnostics.count(), 0) << warnings(c.diagnostics);
    ShadingPoint point;
    point.viewDirection = direction(theta, 30.0f);
    Bsdf bsdf;
    c.program->evaluate(point, bsdf);
    return bsdf.albedo();
}

} // namespace

TEST(Models, AreReadWithoutComplaint) {
    const ModelLibrary& library = ModelLibrary::get();
    EXPECT_EQ(library.diagnostics().count(), 0) << warnings(library.diagnostics());
    for (const char* id :
         {"UsdPreviewSurface", "standard_surface", "open_pbr_surface", "gltf_pbr",
          "ND_standard_surface_surfaceshader", "ND_UsdPreviewSurface_surfaceshader"})
        EXPECT_NE(library.find(id), nullptr) << id;
}

// Every input is set to a value that switches its branch on, so that every node of the graph is
// built: a wrong name or type in the data file is a warning.
TEST(Models, EveryBranchIsWellTyped) {
    for (const auto& model : ModelLibrary::get().all()) {
        Inputs inputs;
        for (const InputDef& input : model->def.inputs)
            if (input.geomprop.empty() && valueTypeComponents(input.type) > 0) {
                Value value = input.value;
                for (float& x : value.numbers)
                    x = 0.37f;
                inputs[input.name] = value;
            }
        Compiled c(modelNetwork(model->def.id, inputs));
        EXPECT_EQ(c.diagnostics.count(), 0) << model->def.id << "\n" << warnings(c.diagnostics);
    }
}

TEST(Models, WhiteFurnace) {
    struct Case {
        const char* id;
        Inputs inputs;
        float least; ///< measured, less a margin: what the layers may lose
    };
    const Case cases[] = {
        {"standard_surface", {{"base_color", grey(1.0f)}}, 0.97f},
        {"standard_surface", {{"base_color", grey(1.0f)}, {"metalness", number(1.0f)}}, 0.9f},
        {"standard_surface", {{"base_color", grey(1.0f)}, {"coat", number(1.0f)}}, 0.97f},
        {"standard_surface", {{"transmission", number(1.0f)}}, 0.98f},
        {"open_pbr_surface", {{"base_color", grey(1.0f)}}, 0.97f},
        {"open_pbr_surface",
         {{"base_color", grey(1.0f)}, {"base_diffuse_roughness", number(1.0f)}},
         0.97f},
        {"open_pbr_surface", {{"base_color", grey(1.0f)}, {"base_metalness", number(1.0f)}}, 0.97f},
        {"open_pbr_surface", {{"transmission_weight", number(1.0f)}}, 0.98f},
        {"gltf_pbr", {{"metallic", number(0.0f)}}, 0.97f},
        {"gltf_pbr", {{"metallic", number(1.0f)}, {"clearcoat", number(1.0f)}}, 0.97f},
        {"gltf_pbr", {{"metallic", number(0.0f)}, {"transmission", number(1.0f)}}, 0.97f},
    };
    for (const Case& c : cases)
        for (const float theta : {0.0f, 45.0f, 75.0f, 88.0f}) {
            const glm::vec3 a = albedoAt(modelNetwork(c.id, c.inputs), theta);
            EXPECT_LE(std::max({a.x, a.y, a.z}), 1.003f) << c.id << " at " << theta;
            EXPECT_GE(std::min({a.x, a.y, a.z}), c.least) << c.id << " at " << theta;
        }
}

TEST(Models, DepthAbsorbs) {
    Compiled c(modelNetwork("standard_surface", {{"transmission", number(1.0f)},
                                                 {"transmission_color", grey(0.5f)},
                                                 {"transmission_depth", number(2.0f)}}));
    ASSERT_TRUE(c.program->hasInterior());
    EXPECT_NEAR(c.program->interior(ShadingPoint()).absorption.x, std::log(2.0f) / 2.0f, 1e-5f);
}

TEST(Models, ThinFilmColoursTheHighlight) {
    const auto tinted = [](const std::string& model, const Inputs& inputs) {
        Compiled c(modelNetwork(model, inputs));
        ShadingPoint point;
        point.viewDirection = direction(30.0f);
        Bsdf bsdf;
        c.program->evaluate(point, bsdf);
        const glm::vec3 a = bsdf.albedo();
        return std::max({a.x, a.y, a.z}) - std::min({a.x, a.y, a.z});
    };
    EXPECT_GT(tinted("standard_surface", {{"base", number(0.0f)},
                                          {"thin_film_IOR", number(1.8f)},
                                          {"thin_film_thickness", number(400.0f)}}),
              5e-3f);
    EXPECT_GT(tinted("open_pbr_surface", {{"base_color", grey(0.5f)},
                                          {"base_metalness", number(1.0f)},
                                          {"thin_film_weight", number(1.0f)},
                                          {"thin_film_thickness", number(0.4f)}}),
              5e-3f);
    EXPECT_GT(tinted("gltf_pbr", {{"base_color", grey(0.5f)},
                                  {"iridescence", number(1.0f)},
                                  {"iridescence_thickness", number(400.0f)}}),
              5e-3f);
}

TEST(Models, WhatIsMissingIsSaid) {
    Diagnostics diagnostics;
    const std::string text = explainMaterial(
        modelNetwork("standard_surface", {{"subsurface", number(1.0f)}}), diagnostics);
    EXPECT_NE(text.find("subsurface scattering is shown as diffuse"), std::string::npos) << text;
}

} // namespace patina
