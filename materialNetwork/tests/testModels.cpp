// SPDX-License-Identifier: Apache-2.0
// The shading models that come with the library.
#include "materialNetwork/tests/materialFixture.h"

#include "materialNetwork/nodes/models.h"

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

/// A model of any type at work in a surface: patterns as its light, closures as what it scatters.
Network asSurface(const ShadingModel& model, Inputs inputs) {
    const ValueType type = model.def.outputs[0].type;
    if (type == ValueType::SurfaceShader || type == ValueType::Material ||
        type == ValueType::LightShader)
        return modelNetwork(model.def.id, std::move(inputs));
    if (type == ValueType::Bsdf) return bsdfNetwork({makeNode("bsdf", model.def.id, inputs)});
    if (type == ValueType::Edf)
        return makeNetwork({makeNode("edf", model.def.id, inputs),
                            makeNode("surface", "ND_surface", {}, {{"edf", {"edf", ""}}})});
    return makeNetwork({makeNode("x", model.def.id, inputs),
                        makeNode("edf", "ND_uniform_edf", {}, {{"color", {"x", ""}}}),
                        makeNode("surface", "ND_surface", {}, {{"edf", {"edf", ""}}})});
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
            if (input.geomprop.empty() && input.notModelled.empty() &&
                valueTypeComponents(input.type) > 0) {
                Value value = input.value;
                for (float& x : value.numbers)
                    x = 0.37f;
                inputs[input.name] = value;
            }
        Compiled c(asSurface(*model, inputs));
        EXPECT_EQ(c.diagnostics.count(), 0) << model->def.id << "\n" << warnings(c.diagnostics);
    }
}

TEST(Models, WhiteFurnace) {
    struct Case {
        const char* id;
        Inputs inputs;
        float minimum; ///< measured, less a margin: what the layers may lose
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
            EXPECT_GE(std::min({a.x, a.y, a.z}), c.minimum) << c.id << " at " << theta;
        }
}

// The extinction of depth d is -ln(color) / d, of which scatter / d is scattered; where that leaves
// less than nothing for absorption, all channels are shifted.
TEST(Models, DepthScatters) {
    for (const auto& [id, prefix] : {std::pair{"standard_surface", "transmission"},
                                     std::pair{"open_pbr_surface", "transmission"}}) {
        const std::string p(prefix);
        const std::string weight = std::string(id) == "standard_surface" ? p : p + "_weight";
        Compiled c(modelNetwork(id, {{weight, number(1.0f)},
                                     {p + "_color", color(std::exp(-1.0f), std::exp(-2.0f), 1.0f)},
                                     {p + "_depth", number(2.0f)},
                                     {p + "_scatter", color(0.5f, 0.5f, 0.5f)},
                                     {p + "_scatter_anisotropy", number(0.25f)}}));
        ASSERT_TRUE(c.program->hasInterior()) << id;
        const auto medium = c.program->interior(ShadingPoint());
        EXPECT_NEAR(medium.scattering().x, 0.25f, 1e-5f) << id;
        EXPECT_NEAR(medium.absorption.x, 0.5f - 0.25f + 0.25f, 1e-5f) << id;
        EXPECT_NEAR(medium.absorption.y, 1.0f - 0.25f + 0.25f, 1e-5f) << id;
        EXPECT_NEAR(medium.absorption.z, 0.0f, 1e-5f) << id;
    }
}

TEST(Models, OpenPbrCoatsDarken) {
    // A grey base of albedo E under a clear coat: E (1 - K) / (1 - E K) of what the coat lets
    // through.
    const auto albedo = [](float darkening) {
        return albedoAt(modelNetwork("open_pbr_surface", {{"base_color", grey(0.5f)},
                                                          {"specular_weight", number(0.0f)},
                                                          {"coat_weight", number(1.0f)},
                                                          {"coat_darkening", number(darkening)}}),
                        0.0f)
            .x;
    };
    const float f0 = std::pow(0.6f / 2.6f, 2.0f), k = 1.0f - (1.0f - f0) / (1.6f * 1.6f);
    EXPECT_NEAR(albedo(0.0f), f0 + (1.0f - f0) * 0.5f, 2e-3f);
    EXPECT_NEAR(albedo(1.0f), f0 + (1.0f - f0) * 0.5f * (1.0f - k) / (1.0f - 0.5f * k), 2e-3f);
    // Against a coat of its own ior the base reflects nothing.
    const float same = albedoAt(modelNetwork("open_pbr_surface", {{"base_color", grey(0.0f)},
                                                                  {"specular_ior", number(1.6f)},
                                                                  {"coat_weight", number(1.0f)}}),
                                0.0f)
                           .x;
    EXPECT_NEAR(same, f0, 1e-3f);
}

/// The coat takes what it reflects (Schlick), and colours the rest; MaterialX 1.39's graphs.
TEST(Models, EmissionLiesUnderTheCoat) {
    const Inputs standard = {{"base", number(0)},
                             {"emission", number(2)},
                             {"coat", number(0.5f)},
                             {"coat_IOR", number(1.5f)},
                             {"coat_color", color(1, 0.5f, 0.25f)}};
    const Inputs open = {{"base_weight", number(0)},
                         {"emission_luminance", number(2)},
                         {"coat_weight", number(0.5f)},
                         {"coat_ior", number(1.5f)},
                         {"coat_color", color(1, 0.5f, 0.25f)}};
    for (const auto& [id, inputs] : {std::pair{"ND_standard_surface_surfaceshader", standard},
                                     std::pair{"ND_open_pbr_surface_surfaceshader", open}}) {
        Compiled c(modelNetwork(id, inputs));
        for (const float theta : {0.0f, 60.0f}) {
            ShadingPoint point;
            point.viewDirection = direction(theta);
            const float passes = 0.96f * (1.0f - std::pow(1.0f - point.viewDirection.z, 5.0f));
            const glm::vec3 light = c.program->emission(point, point.viewDirection);
            for (int i = 0; i < 3; ++i) {
                const float tint = i == 0 ? 1.0f : i == 1 ? 0.5f : 0.25f;
                EXPECT_NEAR(light[i], 1.0f + passes * tint, 1e-4f) << id << " " << theta;
            }
        }
    }
}

TEST(Models, VersionsOfStandardSurface) {
    // The versions differ in the default of base: 0.8 and 1.
    const Inputs red = {{"base_color", color(1, 0, 0)}, {"specular", number(0.0f)}};
    EXPECT_NEAR(albedoAt(modelNetwork("ND_standard_surface_surfaceshader_100", red), 0.0f).x, 0.8f,
                1e-4f);
    EXPECT_NEAR(albedoAt(modelNetwork("standard_surface", red), 0.0f).x, 1.0f, 1e-4f);
}

TEST(Models, DisneyPrincipled) {
    // A white dielectric: diffuse light is what specular leaves over, Burley's lobe is not white.
    const auto albedo = [](Inputs inputs, float theta) {
        return albedoAt(modelNetwork("disney_principled", std::move(inputs)), theta);
    };
    // F0 is 0.08 times specular: without it and with black below, only the rise to grazing is left.
    const Inputs black = {{"baseColor", grey(0.0f)}, {"roughness", number(0.0f)}};
    Inputs shiny = black, dull = black;
    shiny["specular"] = number(1.0f);
    dull["specular"] = number(0.0f);
    EXPECT_NEAR(albedo(shiny, 0.0f).x, 0.08f, 1e-3f);
    EXPECT_NEAR(albedo(dull, 0.0f).x, 0.0f, 1e-3f);
    const glm::vec3 metal = albedo({{"baseColor", color(0.9f, 0.5f, 0.1f)},
                                    {"roughness", number(0.0f)},
                                    {"metallic", number(1.0f)}},
                                   0.0f);
    EXPECT_NEAR(metal.x, 0.9f, 2e-3f);
    EXPECT_NEAR(metal.z, 0.1f, 2e-3f);
    const glm::vec3 glass = albedo(
        {{"baseColor", grey(1.0f)}, {"roughness", number(0.0f)}, {"specTrans", number(1.0f)}},
        30.0f);
    EXPECT_NEAR(glass.x, 1.0f, 0.02f);
    for (const float theta : {0.0f, 45.0f, 80.0f})
        EXPECT_LE(albedo({{"baseColor", grey(1.0f)}, {"clearcoat", number(1.0f)}}, theta).x, 1.15f);
}

TEST(Models, LamaNodesAreWrappers) {
    // A layer of nothing over white is white; half of a mirror over black is half.
    const auto layered = [](float topMix) {
        return albedoAt(
            bsdfNetwork({makeNode("top", "ND_lama_conductor",
                                  {{"reflectivity", grey(1.0f)}, {"edgeColor", grey(1.0f)}}),
                         makeNode("base", "ND_lama_diffuse", {{"color", grey(1.0f)}}),
                         makeNode("bsdf", "ND_lama_layer_bsdf", {{"topMix", number(topMix)}},
                                  {{"materialTop", {"top", ""}}, {"materialBase", {"base", ""}}})}),
            20.0f);
    };
    EXPECT_NEAR(layered(0.0f).x, 1.0f, 1e-4f);
    EXPECT_NEAR(layered(1.0f).x, 1.0f, 0.02f);
    const glm::vec3 sum =
        albedoAt(bsdfNetwork({makeNode("a", "ND_lama_diffuse", {{"color", grey(0.5f)}}),
                              makeNode("b", "ND_lama_diffuse", {{"color", grey(0.25f)}}),
                              makeNode("bsdf", "ND_lama_add_bsdf", {{"weight2", number(1.0f)}},
                                       {{"material1", {"a", ""}}, {"material2", {"b", ""}}})}),
                 0.0f);
    EXPECT_NEAR(sum.x, 0.75f, 1e-4f);
    const Network material =
        makeNetwork({makeNode("a", "ND_lama_diffuse", {{"color", grey(0.5f)}}),
                     makeNode("surface", "ND_lama_surface", {{"presence", number(0.25f)}},
                              {{"materialFront", {"a", ""}}})});
    Compiled c(material);
    EXPECT_NEAR(c.program->opacity(ShadingPoint()), 0.25f, 1e-6f);
}

TEST(Models, DepthAbsorbs) {
    Compiled c(modelNetwork("standard_surface", {{"transmission", number(1.0f)},
                                                 {"transmission_color", grey(0.5f)},
                                                 {"transmission_depth", number(2.0f)}}));
    ASSERT_TRUE(c.program->hasInterior());
    EXPECT_NEAR(c.program->interior(ShadingPoint()).absorption.x, std::log(2.0f) / 2.0f, 1e-5f);
}

TEST(Models, SubsurfaceIsAnEvent) {
    for (const bool thin : {false, true}) {
        Compiled c(modelNetwork("standard_surface", {{"subsurface", number(1.0f)},
                                                     {"specular", number(0.0f)},
                                                     {"subsurface_color", grey(0.5f)},
                                                     {"subsurface_scale", number(3.0f)},
                                                     {"thin_walled", Value::makeBool(thin)}}));
        EXPECT_EQ(c.program->hasSubsurface(), !thin);
        if (thin) continue;
        ShadingPoint point;
        point.viewDirection = direction(30.0f, 0.0f);
        Bsdf bsdf;
        c.program->evaluate(point, bsdf);
        const glm::vec3 up(0, 0, 1);
        EXPECT_NEAR(bsdf.eval(up).diffuse.x, 0.5f / 3.14159265f, 1e-4f); // nobody walks yet
        bsdf.walkSubsurface();
        EXPECT_EQ(bsdf.eval(up).diffuse.x, 0.0f);
        EXPECT_FALSE(bsdf.hasNonDelta());
        const BsdfSample s = bsdf.sample(glm::vec3(0.5f), 0.5f);
        EXPECT_NE(s.event & LOBE_SUBSURFACE, 0);
        EXPECT_NEAR(s.weight.x, 1.0f, 1e-4f);
        const SubsurfaceEntry entry = bsdf.subsurface(s);
        EXPECT_NEAR(entry.color.x, 0.5f, 1e-5f);
        EXPECT_NEAR(entry.radius.x, 3.0f, 1e-4f);
    }
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

} // namespace patina
