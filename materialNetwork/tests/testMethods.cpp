// SPDX-License-Identifier: Apache-2.0
// The meanings that the field leaves open: every method gives the numbers that it promises.
#include "materialNetwork/tests/materialFixture.h"

using namespace patina;

namespace {

struct Result {
    glm::vec3 albedo{0.0f};      ///< of the lobes, at normal incidence
    glm::vec3 passThrough{0.0f}; ///< straight on
    bool transmits = false;      ///< by a lobe
};

Result measure(const Network& network, const MethodChoices& methods) {
    const CleanCompiled c(network, methods);
    const Bsdf bsdf = c.lobes();
    Result r;
    const float opacity = c->opacity(ShadingPoint(), &r.passThrough);
    r.passThrough *= 1.0f - opacity;
    r.albedo = bsdf.albedo() * opacity;
    r.transmits = bsdf.transmits();
    return r;
}

void expectColor(const glm::vec3& value, float r, float g, float b) {
    expectVector(value, r, g, b, 2e-5f);
}
void expectColor(const glm::vec3& value, float grey) {
    expectColor(value, grey, grey, grey);
}

const NetworkNode white = diffuseNode("base", grey(1.0f));

NetworkNode smooth(const char* name, Inputs inputs = {}) {
    inputs["roughness"] = pair(0.0f);
    return makeNode(name, "ND_dielectric_bsdf", inputs);
}

} // namespace

TEST(Methods, SheenFindsItsAlbedoByTableAsByQuadrature) {
    for (const float roughness : {0.02f, 0.1f, 0.3f, 1.0f})
        for (const float degrees : {0.0f, 60.0f, 80.0f, 89.0f}) {
            const auto of = [&](const char* method) {
                return albedoOf(lobeNetwork("ND_sheen_bsdf", {{"roughness", roughness}}),
                                direction(degrees), {{"sheen", method}})
                    .x;
            };
            EXPECT_NEAR(of("table"), of("quadrature"), 4e-3f) << roughness << " " << degrees;
        }
}

// On the path tracer light goes beneath the surface; the cheap way is a diffuse lobe.
TEST(Methods, SubsurfaceCanBeDiffuse) {
    const Network skin = lobeNetwork("ND_subsurface_bsdf", {{"color", grey(0.5f)}});
    for (const auto& [method, kind] :
         {std::pair("randomWalk", LobeKind::Subsurface), {"diffuse", LobeKind::OrenNayar}})
        EXPECT_EQ(Compiled(skin, {{"subsurface", method}}).lobes().lobe(0).kind, kind) << method;
}

// The share that a layer takes from its base follows the albedo method; the exact ones agree.
TEST(Methods, DirectionalAlbedoDecidesWhatALayerTakes) {
    // A rough interface over white: the base shows 1 - E.
    const Network coated = layered(
        {makeNode("top", "ND_dielectric_bsdf", {{"roughness", pair(0.5f)}, {"tint", grey(0.0f)}}),
         white});
    const auto of = [&](const char* method) {
        return measure(coated, {{"directionalAlbedo", method}}).albedo.x;
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
    const Network rough =
        lobeNetwork("ND_oren_nayar_diffuse_bsdf", {{"color", grey(1.0f)}, {"roughness", 1.0f}});
    const auto diffuse = [&](const char* method) {
        return measure(rough, {{"diffuse", method}}).albedo.x;
    };
    EXPECT_NEAR(diffuse("eon"), 1.0f, 1e-4f);
    EXPECT_NEAR(diffuse("lambert"), 1.0f, 1e-4f);
    EXPECT_EQ(diffuse("authored"), diffuse("qualitative"));
}

TEST(Methods, LayerTransmittance) {
    const Network coloured =
        layered({makeNode("top", "ND_generalized_schlick_bsdf",
                          {{"color0", color(0.8f, 0.2f, 0.2f)}, {"roughness", pair(0.0f)}}),
                 white});
    const Network tinted = layered({smooth("top", {{"tint", color(1.0f, 0.5f, 0.0f)}}), white});
    // A product covers by its factor.
    const Network factored =
        layered({makeNode("metal", "ND_patina_lambert_bsdf", {{"color", grey(0.5f)}}),
                 makeNode("top", "ND_multiply_bsdfC", {{"in2", color(1.0f, 0.5f, 0.0f)}},
                          {{"in1", "metal"}}),
                 white});
    const struct {
        const char* method;
        glm::vec3 coloured, tinted, factored;
    } cases[] = {{"perChannel", {1.0f, 1.0f, 1.0f}, {1.0f, 0.98f, 0.96f}, {0.5f, 0.25f, 0.0f}},
                 {"largest", {1.0f, 0.4f, 0.4f}, {1.0f, 0.98f, 0.96f}, {0.5f, 0.25f, 0.0f}},
                 {"average", {1.4f, 0.8f, 0.8f}, {1.0f, 0.98f, 0.96f}, {1.0f, 0.75f, 0.5f}},
                 {"tinted", {1.0f, 1.0f, 1.0f}, {1.0f, 1.0f, 1.0f}, {0.5f, 0.75f, 1.0f}}};
    for (const auto& c : cases) {
        SCOPED_TRACE(c.method);
        for (const auto& [network, expected] :
             {std::pair(&coloured, c.coloured), {&tinted, c.tinted}, {&factored, c.factored}})
            expectVector(measure(*network, {{"layerTransmittance", c.method}}).albedo, expected,
                         2e-5f);
    }
}

TEST(Methods, ReflectionOverTransmission) {
    const Network glass = layered({smooth("top"), smooth("base", {{"scatter_mode", "T"}})});
    expectColor(measure(glass, {}).albedo, 1.0f);
    const Result literal = measure(glass, {{"reflectionOverTransmission", "literal"}});
    expectColor(literal.albedo, 0.04f + 0.96f * 0.96f);
    EXPECT_TRUE(literal.transmits);
}

TEST(Methods, ThinWalled) {
    const Network pane =
        bsdfNetwork({smooth("bsdf", {{"scatter_mode", "RT"}})}, {{"thin_walled", true}});
    const struct {
        const char* method;
        float passes, reflects;
        bool transmits;
    } cases[] = {{"slab", 0.96f / 1.04f, 0.08f / 1.04f, false},
                 {"sheet", 0.96f, 0.04f, false},
                 {"solid", 0.0f, 1.0f, true}};
    EXPECT_EQ(chosenMethod({}, "thinWalled"), "slab");
    for (const auto& c : cases) {
        SCOPED_TRACE(c.method);
        const Result r = measure(pane, {{"thinWalled", c.method}});
        expectColor(r.passThrough, c.passes);
        expectColor(r.albedo, c.reflects);
        EXPECT_EQ(r.transmits, c.transmits);
    }
}

TEST(Methods, ExplainNamesThoseThatMatter) {
    const auto explained = [](const Network& network, const MethodChoices& methods = {}) {
        Diagnostics diagnostics;
        return explainMaterial(network, diagnostics, methods);
    };
    const std::string plain = explained(lobeNetwork("ND_burley_diffuse_bsdf"));
    EXPECT_FALSE(has(plain, "method ")) << plain;
    const Network glass =
        layered({makeNode("top", "ND_dielectric_bsdf"), makeNode("base", "ND_dielectric_btdf")});
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
