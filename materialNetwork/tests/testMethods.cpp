// SPDX-License-Identifier: Apache-2.0
// The meanings that the field leaves open: every method gives the numbers that it promises.
#include "materialNetwork/tests/materialFixture.h"

namespace patina {

namespace {

struct Result {
    glm::vec3 albedo{0.0f};      ///< of the lobes, at normal incidence
    glm::vec3 passThrough{0.0f}; ///< straight on
    bool transmits = false;      ///< by a lobe
};

Result measure(const Network& network, const MethodChoices& methods) {
    FakeTextures textures;
    Diagnostics diagnostics;
    const auto program = compileMaterial(network, textures, diagnostics, methods);
    EXPECT_EQ(warnings(diagnostics), "");
    Bsdf bsdf;
    program->evaluate(ShadingPoint(), bsdf);
    Result r;
    const float opacity = program->opacity(ShadingPoint(), &r.passThrough);
    r.passThrough *= 1.0f - opacity;
    r.albedo = bsdf.albedo() * opacity;
    r.transmits = bsdf.transmits();
    return r;
}

void expectColor(const glm::vec3& value, float r, float g, float b) {
    EXPECT_NEAR(value.x, r, 2e-5f);
    EXPECT_NEAR(value.y, g, 2e-5f);
    EXPECT_NEAR(value.z, b, 2e-5f);
}

Network layered(const NetworkNode& top, const NetworkNode& base) {
    return bsdfNetwork(
        {top, base,
         makeNode("bsdf", "ND_layer_bsdf", {}, {{"top", {"top", ""}}, {"base", {"base", ""}}})});
}

const NetworkNode white = makeNode("base", "ND_oren_nayar_diffuse_bsdf", {{"color", grey(1.0f)}});

/// A rough interface over white: the base shows 1 - E.
Network coated(float roughness) {
    return layered(makeNode("top", "ND_dielectric_bsdf",
                            {{"roughness", pair(roughness)}, {"tint", grey(0.0f)}}),
                   white);
}

} // namespace

TEST(Methods, SheenFindsItsAlbedoByTableAsByQuadrature) {
    for (const float roughness : {0.02f, 0.1f, 0.3f, 1.0f})
        for (const float degrees : {0.0f, 60.0f, 80.0f, 89.0f}) {
            const auto of = [&](const char* method) {
                FakeTextures textures;
                Diagnostics diagnostics;
                const auto program =
                    compileMaterial(bsdfNetwork({makeNode("bsdf", "ND_sheen_bsdf",
                                                          {{"roughness", number(roughness)}})}),
                                    textures, diagnostics, {{"sheen", method}});
                ShadingPoint point;
                point.viewDirection = direction(degrees);
                Bsdf bsdf;
                program->evaluate(point, bsdf);
                return bsdf.albedo().x;
            };
            const float truth = of("quadrature");
            EXPECT_NEAR(of("table"), truth, 4e-3f) << roughness << " " << degrees;
        }
}

// On the path tracer light goes beneath the surface; the cheap way is a diffuse lobe.
TEST(Methods, SubsurfaceCanBeDiffuse) {
    const Network skin =
        bsdfNetwork({makeNode("bsdf", "ND_subsurface_bsdf", {{"color", grey(0.5f)}})});
    const auto kind = [&](const char* method) {
        FakeTextures textures;
        Diagnostics diagnostics;
        const auto program = compileMaterial(skin, textures, diagnostics, {{"subsurface", method}});
        Bsdf bsdf;
        program->evaluate(ShadingPoint(), bsdf);
        return bsdf.lobe(0).kind;
    };
    EXPECT_EQ(kind("randomWalk"), LobeKind::Subsurface);
    EXPECT_EQ(kind("diffuse"), LobeKind::OrenNayar);
}

// The share that a layer takes from its base follows the albedo method; the exact ones agree.
TEST(Methods, DirectionalAlbedoDecidesWhatALayerTakes) {
    const auto of = [](const char* method) {
        return measure(coated(0.5f), {{"directionalAlbedo", method}}).albedo.x;
    };
    const float truth = of("quadrature");
    EXPECT_NEAR(of("table"), truth, 1e-3f);
    EXPECT_NEAR(of("fit"), truth, 1e-3f);
    for (const char* method : {"karis", "monteCarlo16"}) {
        EXPECT_NEAR(of(method), truth, 3e-2f) << method;
        EXPECT_GT(std::fabs(of(method) - truth), 1e-5f) << method;
    }
}

TEST(Methods, Diffuse) {
    const NetworkNode rough = makeNode("bsdf", "ND_oren_nayar_diffuse_bsdf",
                                       {{"color", grey(1.0f)}, {"roughness", number(1.0f)}});
    const auto diffuse = [&](const char* method) {
        return measure(bsdfNetwork({rough}), {{"diffuse", method}}).albedo.x;
    };
    EXPECT_NEAR(diffuse("eon"), 1.0f, 1e-4f);
    EXPECT_NEAR(diffuse("lambert"), 1.0f, 1e-4f);
    EXPECT_EQ(diffuse("authored"), diffuse("qualitative"));
}

TEST(Methods, LayerTransmittance) {
    const auto of = [](const NetworkNode& top, const char* method) {
        return measure(layered(top, white), {{"layerTransmittance", method}}).albedo;
    };
    const NetworkNode coloured =
        makeNode("top", "ND_generalized_schlick_bsdf",
                 {{"color0", color(0.8f, 0.2f, 0.2f)}, {"roughness", pair(0.0f)}});
    expectColor(of(coloured, "perChannel"), 1.0f, 1.0f, 1.0f);
    expectColor(of(coloured, "largest"), 1.0f, 0.4f, 0.4f);
    expectColor(of(coloured, "average"), 1.4f, 0.8f, 0.8f);
    expectColor(of(coloured, "tinted"), 1.0f, 1.0f, 1.0f);
    const NetworkNode tinted =
        makeNode("top", "ND_dielectric_bsdf",
                 {{"tint", color(1.0f, 0.5f, 0.0f)}, {"roughness", pair(0.0f)}});
    expectColor(of(tinted, "perChannel"), 1.0f, 0.98f, 0.96f);
    expectColor(of(tinted, "largest"), 1.0f, 0.98f, 0.96f);
    expectColor(of(tinted, "average"), 1.0f, 0.98f, 0.96f);
    expectColor(of(tinted, "tinted"), 1.0f, 1.0f, 1.0f);
    // A product covers by its factor.
    const auto factored = [](const char* method) {
        return measure(bsdfNetwork(
                           {makeNode("metal", "ND_patina_lambert_bsdf", {{"color", grey(0.5f)}}),
                            makeNode("top", "ND_multiply_bsdfC", {{"in2", color(1.0f, 0.5f, 0.0f)}},
                                     {{"in1", {"metal", ""}}}),
                            white,
                            makeNode("bsdf", "ND_layer_bsdf", {},
                                     {{"top", {"top", ""}}, {"base", {"base", ""}}})}),
                       {{"layerTransmittance", method}})
            .albedo;
    };
    expectColor(factored("perChannel"), 0.5f, 0.25f, 0.0f);
    expectColor(factored("largest"), 0.5f, 0.25f, 0.0f);
    expectColor(factored("average"), 1.0f, 0.75f, 0.5f);
    expectColor(factored("tinted"), 0.5f, 0.75f, 1.0f);
}

TEST(Methods, ReflectionOverTransmission) {
    const Network glass =
        layered(makeNode("top", "ND_dielectric_bsdf", {{"roughness", pair(0.0f)}}),
                makeNode("base", "ND_dielectric_bsdf",
                         {{"roughness", pair(0.0f)}, {"scatter_mode", text("T")}}));
    expectColor(measure(glass, {}).albedo, 1.0f, 1.0f, 1.0f);
    const Result literal = measure(glass, {{"reflectionOverTransmission", "literal"}});
    const float darker = 0.04f + 0.96f * 0.96f;
    expectColor(literal.albedo, darker, darker, darker);
    EXPECT_TRUE(literal.transmits);
}

TEST(Methods, ThinWalled) {
    const Network pane =
        bsdfNetwork({makeNode("bsdf", "ND_dielectric_bsdf",
                              {{"roughness", pair(0.0f)}, {"scatter_mode", text("RT")}})},
                    {{"thin_walled", Value::makeBool(true)}});
    const Result slab = measure(pane, {});
    expectColor(slab.passThrough, 0.96f / 1.04f, 0.96f / 1.04f, 0.96f / 1.04f);
    expectColor(slab.albedo, 0.08f / 1.04f, 0.08f / 1.04f, 0.08f / 1.04f);
    EXPECT_FALSE(slab.transmits);
    const Result sheet = measure(pane, {{"thinWalled", "sheet"}});
    expectColor(sheet.passThrough, 0.96f, 0.96f, 0.96f);
    expectColor(sheet.albedo, 0.04f, 0.04f, 0.04f);
    const Result solid = measure(pane, {{"thinWalled", "solid"}});
    expectColor(solid.passThrough, 0.0f, 0.0f, 0.0f);
    expectColor(solid.albedo, 1.0f, 1.0f, 1.0f);
    EXPECT_TRUE(solid.transmits);
}

TEST(Methods, ExplainNamesThoseThatMatter) {
    const auto explained = [](const Network& network, const MethodChoices& methods = {}) {
        Diagnostics diagnostics;
        return explainMaterial(network, diagnostics, methods);
    };
    const auto has = [](const std::string& text, const char* what) {
        return text.find(what) != std::string::npos;
    };
    const std::string plain = explained(bsdfNetwork({makeNode("bsdf", "ND_burley_diffuse_bsdf")}));
    EXPECT_FALSE(has(plain, "method ")) << plain;
    const Network glass =
        layered(makeNode("top", "ND_dielectric_bsdf"), makeNode("base", "ND_dielectric_btdf"));
    EXPECT_TRUE(has(explained(glass), "method layering = albedoScaling: "));
    EXPECT_TRUE(has(explained(glass), "method reflectionOverTransmission = sharedInterface: "));
    EXPECT_FALSE(has(explained(glass), "method thinWalled"));
    EXPECT_EQ(explained(glass, {{"reflectionOverTransmission", "fused"}}),
              explained(glass)); // its former name
    const std::string literal = explained(glass, {{"reflectionOverTransmission", "literal"}});
    EXPECT_TRUE(has(literal, "method reflectionOverTransmission = literal: "));
    EXPECT_FALSE(has(literal, " shared interface *"));
    Network pane = glass;
    pane.nodes.back().inputs["thin_walled"] = Value::makeBool(true);
    EXPECT_TRUE(has(explained(pane, {{"thinWalled", "solid"}}), "method thinWalled = solid: "));
}

} // namespace patina
