// SPDX-License-Identifier: Apache-2.0
// The shading models that come with the library.
#include "materialNetwork/tests/patternFixture.h"

#include "materialNetwork/nodes/models.h"

using namespace patina;

namespace {

/// A model of any type at work in a surface: patterns as its light, closures as what it scatters.
Network asSurface(const ShadingModel& model, const Inputs& inputs) {
    const std::string& id = model.def.id;
    switch (model.def.outputs[0].type) {
    case ValueType::SurfaceShader:
    case ValueType::Material:
    case ValueType::LightShader: return modelNetwork(id, inputs);
    case ValueType::Bsdf: return lobeNetwork(id, inputs);
    case ValueType::Edf: return edfNetwork({makeNode("edf", id, inputs)});
    default: return emitting({makeNode("x", id, inputs)});
    }
}

glm::vec3 modelAlbedo(const std::string& id, const Inputs& inputs, float theta = 0.0f) {
    return albedoOf(modelNetwork(id, inputs), direction(theta, 30.0f));
}

} // namespace

TEST(Models, AreReadWithoutComplaint) {
    const ModelLibrary& library = ModelLibrary::get();
    EXPECT_TRUE(nothingTold(library.diagnostics()));
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
        EXPECT_TRUE(nothingTold(Compiled(asSurface(*model, inputs)))) << model->def.id;
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
        {"standard_surface", {{"base_color", grey(1.0f)}, {"metalness", 1.0f}}, 0.9f},
        {"standard_surface", {{"base_color", grey(1.0f)}, {"coat", 1.0f}}, 0.97f},
        {"standard_surface", {{"transmission", 1.0f}}, 0.98f},
        {"open_pbr_surface", {{"base_color", grey(1.0f)}}, 0.97f},
        {"open_pbr_surface", {{"base_color", grey(1.0f)}, {"base_diffuse_roughness", 1.0f}}, 0.97f},
        {"open_pbr_surface", {{"base_color", grey(1.0f)}, {"base_metalness", 1.0f}}, 0.97f},
        {"open_pbr_surface", {{"transmission_weight", 1.0f}}, 0.98f},
        {"gltf_pbr", {{"metallic", 0.0f}}, 0.97f},
        {"gltf_pbr", {{"metallic", 1.0f}, {"clearcoat", 1.0f}}, 0.97f},
        {"gltf_pbr", {{"metallic", 0.0f}, {"transmission", 1.0f}}, 0.97f},
    };
    for (const Case& c : cases)
        for (const float theta : {0.0f, 45.0f, 75.0f, 88.0f}) {
            const glm::vec3 a = modelAlbedo(c.id, c.inputs, theta);
            EXPECT_LE(std::max({a.x, a.y, a.z}), 1.003f) << c.id << " at " << theta;
            EXPECT_GE(std::min({a.x, a.y, a.z}), c.minimum) << c.id << " at " << theta;
        }
}

// The extinction of depth d is -ln(color) / d, of which scatter / d is scattered; where that leaves
// less than nothing for absorption, all channels are shifted.
TEST(Models, DepthScatters) {
    for (const auto& [id, weight] : {std::pair("standard_surface", "transmission"),
                                     {"open_pbr_surface", "transmission_weight"}}) {
        SCOPED_TRACE(id);
        const Compiled c(
            modelNetwork(id, {{weight, 1.0f},
                              {"transmission_color", color(std::exp(-1.0f), std::exp(-2.0f), 1.0f)},
                              {"transmission_depth", 2.0f},
                              {"transmission_scatter", grey(0.5f)},
                              {"transmission_scatter_anisotropy", 0.25f}}));
        ASSERT_TRUE(c->hasInterior());
        const auto medium = c->interior(ShadingPoint());
        EXPECT_NEAR(medium.scattering().x, 0.25f, 1e-5f);
        expectVector(medium.absorption, 0.5f - 0.25f + 0.25f, 1.0f - 0.25f + 0.25f, 0.0f);
    }
}

TEST(Models, OpenPbrCoatsDarken) {
    // A grey base of albedo E under a clear coat: E (1 - K) / (1 - E K) of what the coat lets
    // through.
    const auto albedo = [](float darkening) {
        return modelAlbedo("open_pbr_surface", {{"base_color", grey(0.5f)},
                                                {"specular_weight", 0.0f},
                                                {"coat_weight", 1.0f},
                                                {"coat_darkening", darkening}})
            .x;
    };
    const float f0 = std::pow(0.6f / 2.6f, 2.0f), k = 1.0f - (1.0f - f0) / (1.6f * 1.6f);
    EXPECT_NEAR(albedo(0.0f), f0 + (1.0f - f0) * 0.5f, 2e-3f);
    EXPECT_NEAR(albedo(1.0f), f0 + (1.0f - f0) * 0.5f * (1.0f - k) / (1.0f - 0.5f * k), 2e-3f);
    // Against a coat of its own ior the base reflects nothing.
    const Inputs same = {{"base_color", grey(0.0f)}, {"specular_ior", 1.6f}, {"coat_weight", 1.0f}};
    EXPECT_NEAR(modelAlbedo("open_pbr_surface", same).x, f0, 1e-3f);
}

/// The coat takes what it reflects (Schlick), and colours the rest; MaterialX 1.39's graphs.
TEST(Models, EmissionLiesUnderTheCoat) {
    const Value tint = color(1, 0.5f, 0.25f);
    const std::pair<const char*, Inputs> cases[] = {{"standard_surface",
                                                     {{"base", 0.0f},
                                                      {"emission", 2.0f},
                                                      {"coat", 0.5f},
                                                      {"coat_IOR", 1.5f},
                                                      {"coat_color", tint}}},
                                                    {"open_pbr_surface",
                                                     {{"base_weight", 0.0f},
                                                      {"emission_luminance", 2.0f},
                                                      {"coat_weight", 0.5f},
                                                      {"coat_ior", 1.5f},
                                                      {"coat_color", tint}}}};
    for (const auto& [id, inputs] : cases)
        for (const float theta : {0.0f, 60.0f}) {
            SCOPED_TRACE(id + std::to_string(theta));
            const glm::vec3 wo = direction(theta);
            const float passes = 0.96f * (1.0f - std::pow(1.0f - wo.z, 5.0f));
            expectVector(Compiled(modelNetwork(id, inputs))->emission(seenFrom(wo), wo),
                         1.0f + passes * glm::vec3(1, 0.5f, 0.25f), 1e-4f);
        }
}

TEST(Models, VersionsOfStandardSurface) {
    // The versions differ in the default of base: 0.8 and 1.
    const Inputs red = {{"base_color", color(1, 0, 0)}, {"specular", 0.0f}};
    EXPECT_NEAR(modelAlbedo("ND_standard_surface_surfaceshader_100", red).x, 0.8f, 1e-4f);
    EXPECT_NEAR(modelAlbedo("standard_surface", red).x, 1.0f, 1e-4f);
}

TEST(Models, DisneyPrincipled) {
    // A white dielectric: diffuse light is what specular leaves over, Burley's lobe is not white.
    const auto albedo = [](const Value& color, Inputs inputs, float theta = 0.0f) {
        inputs["baseColor"] = color;
        inputs.insert({"roughness", 0.0f});
        return modelAlbedo("disney_principled", inputs, theta);
    };
    // F0 is 0.08 times specular: without it and with black below, only the rise to grazing is left.
    EXPECT_NEAR(albedo(grey(0.0f), {{"specular", 1.0f}}).x, 0.08f, 1e-3f);
    EXPECT_NEAR(albedo(grey(0.0f), {{"specular", 0.0f}}).x, 0.0f, 1e-3f);
    const glm::vec3 metal = albedo(color(0.9f, 0.5f, 0.1f), {{"metallic", 1.0f}});
    EXPECT_NEAR(metal.x, 0.9f, 2e-3f);
    EXPECT_NEAR(metal.z, 0.1f, 2e-3f);
    EXPECT_NEAR(albedo(grey(1.0f), {{"specTrans", 1.0f}}, 30.0f).x, 1.0f, 0.02f);
    for (const float theta : {0.0f, 45.0f, 80.0f})
        EXPECT_LE(modelAlbedo("disney_principled", {{"baseColor", grey(1.0f)}, {"clearcoat", 1.0f}},
                              theta)
                      .x,
                  1.15f);
}

TEST(Models, LamaNodesAreWrappers) {
    const auto diffuse = [](const char* name, float albedo) {
        return makeNode(name, "ND_lama_diffuse", {{"color", grey(albedo)}});
    };
    // A layer of nothing over white is white; half of a mirror over black is half.
    const auto mirrored = [&](float topMix) {
        return albedoOf(
            bsdfNetwork({makeNode("top", "ND_lama_conductor",
                                  {{"reflectivity", grey(1.0f)}, {"edgeColor", grey(1.0f)}}),
                         diffuse("base", 1.0f),
                         makeNode("bsdf", "ND_lama_layer_bsdf", {{"topMix", topMix}},
                                  {{"materialTop", "top"}, {"materialBase", "base"}})}),
            direction(20.0f, 30.0f));
    };
    EXPECT_NEAR(mirrored(0.0f).x, 1.0f, 1e-4f);
    EXPECT_NEAR(mirrored(1.0f).x, 1.0f, 0.02f);
    const glm::vec3 sum =
        albedoOf(bsdfNetwork({diffuse("a", 0.5f), diffuse("b", 0.25f),
                              makeNode("bsdf", "ND_lama_add_bsdf", {{"weight2", 1.0f}},
                                       {{"material1", "a"}, {"material2", "b"}})}));
    EXPECT_NEAR(sum.x, 0.75f, 1e-4f);
    const Compiled c(modelNetwork("ND_lama_surface", {{"presence", 0.25f}},
                                  {{"materialFront", "a"}}, {diffuse("a", 0.5f)}));
    EXPECT_NEAR(c->opacity(ShadingPoint()), 0.25f, 1e-6f);
}

TEST(Models, DepthAbsorbs) {
    Compiled c(modelNetwork("standard_surface", {{"transmission", 1.0f},
                                                 {"transmission_color", grey(0.5f)},
                                                 {"transmission_depth", 2.0f}}));
    ASSERT_TRUE(c->hasInterior());
    EXPECT_NEAR(c->interior(ShadingPoint()).absorption.x, std::log(2.0f) / 2.0f, 1e-5f);
}

TEST(Models, SubsurfaceIsAnEvent) {
    for (const bool thin : {false, true}) {
        Compiled c(modelNetwork("standard_surface", {{"subsurface", 1.0f},
                                                     {"specular", 0.0f},
                                                     {"subsurface_color", grey(0.5f)},
                                                     {"subsurface_scale", 3.0f},
                                                     {"thin_walled", thin}}));
        EXPECT_EQ(c->hasSubsurface(), !thin);
        if (thin) continue;
        Bsdf bsdf = c.lobes(direction(30.0f));
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
    const std::pair<const char*, Inputs> cases[] = {
        {"standard_surface",
         {{"base", 0.0f}, {"thin_film_IOR", 1.8f}, {"thin_film_thickness", 400.0f}}},
        {"open_pbr_surface",
         {{"base_color", grey(0.5f)},
          {"base_metalness", 1.0f},
          {"thin_film_weight", 1.0f},
          {"thin_film_thickness", 0.4f}}},
        {"gltf_pbr",
         {{"base_color", grey(0.5f)}, {"iridescence", 1.0f}, {"iridescence_thickness", 400.0f}}}};
    for (const auto& [id, inputs] : cases) {
        const glm::vec3 a = modelAlbedo(id, inputs, 30.0f);
        EXPECT_GT(std::max({a.x, a.y, a.z}) - std::min({a.x, a.y, a.z}), 5e-3f) << id;
    }
}
