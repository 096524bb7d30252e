// SPDX-License-Identifier: Apache-2.0
// Programs: what they ask for, what they say about themselves, patterns, textures, overrides.
#include "materialNetwork/tests/materialFixture.h"

namespace patina {

namespace {

/// A material that emits the value of node "x".
Network emitting(std::vector<NetworkNode> nodes, const std::string& output = "") {
    nodes.push_back(makeNode("edf", "ND_uniform_edf", {}, {{"color", {"x", output}}}));
    nodes.push_back(makeNode("surface", "ND_surface", {}, {{"edf", {"edf", ""}}}));
    return makeNetwork(std::move(nodes));
}

glm::vec3 emitted(const Network& network, std::map<std::string, glm::vec4> primvars = {},
                  ShadingPoint point = {}) {
    Compiled c(network);
    const FakePrimvars reader(*c.program, std::move(primvars));
    point.primvars = &reader;
    return c.program->emission(point, glm::vec3(0, 0, 1));
}

void expectColor(const glm::vec3& a, float r, float g, float b) {
    EXPECT_NEAR(a.x, r, 1e-5f);
    EXPECT_NEAR(a.y, g, 1e-5f);
    EXPECT_NEAR(a.z, b, 1e-5f);
}

} // namespace

TEST(Material, FlagsOfADefaultPreviewSurface) {
    Compiled c(previewNetwork());
    EXPECT_TRUE(c.program->constant());
    EXPECT_TRUE(c.program->isOpaque());
    EXPECT_FALSE(c.program->hasEmission());
    EXPECT_FALSE(c.program->hasTransmission());
    EXPECT_FALSE(c.program->usesUv());
    EXPECT_TRUE(c.program->primvars().empty());
    EXPECT_EQ(c.diagnostics.count(), 0) << warnings(c.diagnostics);
}

TEST(Material, DisplayColorIsReadWithItsDefault) {
    Compiled c(makeDisplayColorNetwork());
    ASSERT_EQ(c.program->primvars().size(), 2u);
    EXPECT_FALSE(c.program->isOpaque());
    EXPECT_TRUE(c.program->isOpaqueWith({0, -1}));
    EXPECT_FALSE(c.program->isOpaqueWith({0, 1}));
    ShadingPoint point;
    Bsdf bsdf;
    c.program->evaluate(point, bsdf);
    const float grey = bsdf.albedo().x;
    const FakePrimvars reader(*c.program, {{"displayColor", glm::vec4(1, 0, 0, 1)},
                                           {"displayOpacity", glm::vec4(0.25f)}});
    point.primvars = &reader;
    c.program->evaluate(point, bsdf);
    EXPECT_GT(bsdf.albedo().x, grey + 0.5f);
    EXPECT_NEAR(c.program->opacity(point), 0.25f, 1e-6f);
}

TEST(Material, OpacityThresholdCutsOut) {
    const auto opacity = [](float x) {
        Compiled c(previewNetwork({{"opacity", number(x)}, {"opacityThreshold", number(0.5f)}}));
        EXPECT_FALSE(c.program->hasTransmission());
        return c.program->opacity(ShadingPoint());
    };
    EXPECT_EQ(opacity(0.49f), 0.0f);
    EXPECT_EQ(opacity(0.5f), 1.0f);
}

TEST(Material, VaryingOpacityPassesLightStraight) {
    Compiled c(previewNetwork({{"roughness", number(0.0f)}, {"diffuseColor", grey(1.0f)}},
                              {{"opacity", {"x", "result"}}},
                              {makeNode("x", "UsdPrimvarReader_float", {{"varname", text("o")}})}));
    EXPECT_FALSE(c.program->hasTransmission());
    EXPECT_FALSE(c.program->isOpaque());
    for (const float opacity : {0.0f, 0.5f, 1.0f})
        for (const float theta : {0.0f, 60.0f}) {
            const FakePrimvars reader(*c.program, {{"o", glm::vec4(opacity)}});
            ShadingPoint point;
            point.primvars = &reader;
            point.viewDirection = direction(theta);
            const float presence = c.program->opacity(point);
            Bsdf bsdf;
            c.program->evaluate(point, bsdf);
            // Light that passes and light that is scattered add up to all of it, for white.
            EXPECT_NEAR(presence * bsdf.albedo().x + 1.0f - presence, 1.0f, 1e-3f);
            EXPECT_FALSE(bsdf.transmits());
            // Specular stays where nothing else is there.
            if (opacity == 0.0f && theta == 0.0f) {
                EXPECT_NEAR(presence, 0.04f, 1e-3f);
            }
        }
}

TEST(Material, ThinSlabsHaveTwoFaces) {
    const glm::vec3 tint(0.9f, 0.5f, 0.2f);
    for (const float theta : {0.0f, 60.0f, 180.0f}) {
        Compiled c(
            makeNetwork({makeNode("surface", "ND_surface", {{"thin_walled", Value::makeBool(true)}},
                                  {{"bsdf", {"glass", "out"}}}),
                         makeNode("glass", "ND_dielectric_bsdf",
                                  {{"scatter_mode", text("RT")},
                                   {"ior", number(1.5f)},
                                   {"tint", Value::makeColor3(tint.x, tint.y, tint.z)},
                                   {"roughness", Value::makeVec2(0.0f, 0.0f)}})}));
        EXPECT_FALSE(c.program->hasTransmission());
        EXPECT_FALSE(c.program->isOpaque());
        ShadingPoint point;
        point.viewDirection = direction(theta);
        glm::vec3 passes(0.0f);
        const float opacity = c.program->opacity(point, &passes);
        Bsdf bsdf;
        c.program->evaluate(point, bsdf);
        EXPECT_FALSE(bsdf.transmits());
        const float once = sh::fresnelDielectric(std::abs(point.viewDirection.z), 1.5f);
        const float slab = 2.0f * once / (1.0f + once);
        const glm::vec3 transmittance = (1.0f - opacity) * passes;
        const BsdfSample s = bsdf.sample(glm::vec3(0.5f), 0.5f);
        ASSERT_EQ(s.event, sh::LOBE_REFLECT | sh::LOBE_DELTA);
        for (int k = 0; k < 3; ++k) {
            EXPECT_NEAR(transmittance[k], tint[k] * (1.0f - slab), 1e-4f) << theta;
            EXPECT_NEAR(opacity * s.weight[k], tint[k] * slab, 1e-4f) << theta;
        }
    }
}

TEST(Material, ConstantOpacityIsGlass) {
    Compiled c(previewNetwork({{"opacity", number(0.0f)}}));
    EXPECT_TRUE(c.program->hasTransmission());
    EXPECT_TRUE(c.program->isOpaque());
    ShadingPoint point;
    point.viewDirection = direction(45.0f);
    Bsdf bsdf;
    c.program->evaluate(point, bsdf);
    EXPECT_TRUE(bsdf.transmits());
    const BsdfSample s = bsdf.sample(glm::vec3(0.5f), 0.99f);
    ASSERT_EQ(s.event, sh::LOBE_TRANSMIT | sh::LOBE_DELTA);
    // Snell's law: sin 45 / 1.5.
    EXPECT_NEAR(-s.wi.x, 0.70710678f / 1.5f, 1e-5f);
}

TEST(Material, AbsorptionInsideGlass) {
    Compiled c(bsdfNetwork(
        {makeNode("glass", "ND_dielectric_bsdf", {{"scatter_mode", text("RT")}}),
         makeNode("inside", "ND_absorption_vdf", {{"absorption", Value::makeVec3(1, 2, 3)}}),
         makeNode("bsdf", "ND_layer_vdf", {},
                  {{"top", {"glass", ""}}, {"base", {"inside", ""}}})}));
    ASSERT_TRUE(c.program->hasInterior());
    expectColor(c.program->interior(ShadingPoint()).absorption, 1, 2, 3);
}

TEST(Material, TexturesAreReadWithScaleBiasAndChannels) {
    const auto texture = [](const char* file) {
        return makeNode("x", "UsdUVTexture",
                        {{"file", Value::makeFilename(file)},
                         {"scale",
                          [] {
                              Value v;
                              v.type = ValueType::Vec4;
                              v.numbers = {2, 2, 2, 1};
                              return v;
                          }()}},
                        {{"st", {"st", "result"}}});
    };
    const NetworkNode st = makeNode("st", "UsdPrimvarReader_float2", {{"varname", text("uv")}});
    const std::map<std::string, glm::vec4> uv = {{"uv", glm::vec4(0.25f, 0.5f, 0, 0)}};
    expectColor(emitted(emitting({st, texture("a.png")}, "rgb"), uv), 0.5f, 1.0f, 1.0f);
    expectColor(emitted(emitting({st, texture("a.png")}, "g"), uv), 1.0f, 1.0f, 1.0f);
    // A missing file shows the source's own sign, magenta, unless a fallback is authored.
    expectColor(emitted(emitting({st, texture("missing.png")}, "rgb"), uv), 2.0f, 0.0f, 2.0f);
    NetworkNode authored = texture("missing.png");
    authored.inputs["fallback"].type = ValueType::Vec4;
    authored.inputs["fallback"].numbers = {0.1f, 0.2f, 0.3f, 1.0f};
    expectColor(emitted(emitting({st, authored}, "rgb"), uv), 0.1f, 0.2f, 0.3f);
}

TEST(Material, WrapModesReachTheTextureSource) {
    NetworkNode node = makeNode("x", "UsdUVTexture",
                                {{"file", Value::makeFilename("a.png")},
                                 {"wrapS", text("mirror")},
                                 {"sourceColorSpace", text("raw")}});
    Compiled c(emitting({node}, "rgb"));
    ASSERT_EQ(c.textures.requests.size(), 1u);
    EXPECT_EQ(c.textures.requests[0].wrapS, TextureWrap::Mirror);
    EXPECT_EQ(c.textures.requests[0].wrapT, TextureWrap::Black);
    EXPECT_EQ(c.textures.requests[0].colorSpace, "raw");
    EXPECT_EQ(c.textures.requests[0].prim, "/m/x");
    EXPECT_TRUE(c.program->usesUv());
}

TEST(Material, Transform2dScalesRotatesTranslates) {
    const NetworkNode node = makeNode("y", "UsdTransform2d",
                                      {{"in", Value::makeVec2(1, 0)},
                                       {"scale", Value::makeVec2(2, 2)},
                                       {"rotation", number(90.0f)},
                                       {"translation", Value::makeVec2(0.5f, 0.25f)}});
    const NetworkNode x = makeNode("x", "ND_convert_vector3_color3", {}, {{"in", {"y", "result"}}});
    expectColor(emitted(emitting({node, x})), 0.5f, 2.25f, 0.0f);
}

TEST(Material, HsvThereAndBack) {
    for (const glm::vec3& rgb : {glm::vec3(1, 0, 0), glm::vec3(0.2f, 0.7f, 0.4f),
                                 glm::vec3(0.1f, 0.05f, 0.9f), glm::vec3(0.5f)}) {
        const NetworkNode hsv =
            makeNode("hsv", "ND_rgbtohsv_color3", {{"in", color(rgb.x, rgb.y, rgb.z)}});
        const NetworkNode x = makeNode("x", "ND_hsvtorgb_color3", {}, {{"in", {"hsv", ""}}});
        expectColor(emitted(emitting({hsv, x})), rgb.x, rgb.y, rgb.z);
    }
}

TEST(Material, NormalMapsTiltTheFrame) {
    Compiled c(previewNetwork({{"roughness", number(0.0f)},
                               {"metallic", number(1.0f)},
                               {"diffuseColor", grey(1.0f)},
                               {"normal", Value::makeVec3(0.6f, 0.0f, 0.8f)}}));
    ShadingPoint point;
    Bsdf bsdf;
    c.program->evaluate(point, bsdf);
    const BsdfSample s = bsdf.sample(glm::vec3(0.5f), 0.5f);
    ASSERT_NE(s.event, 0);
    // The mirror direction of z about (0.6, 0, 0.8).
    expectColor(s.wi, 0.96f, 0.0f, 0.28f);
}

TEST(Material, ObjectSpaceUndoesTheTransform) {
    ShadingPoint point;
    point.objectToWorldNormal = glm::mat3(0, 1, 0, -1, 0, 0, 0, 0, 1); // x to y
    point.normal = glm::vec3(0, 1, 0);
    const NetworkNode n = makeNode("n", "ND_normal_vector3");
    const NetworkNode x = makeNode("x", "ND_convert_vector3_color3", {}, {{"in", {"n", ""}}});
    expectColor(emitted(emitting({n, x}), {}, point), 1.0f, 0.0f, 0.0f);
}

TEST(Material, UnlitEmits) {
    Compiled c(makeNetwork(
        {makeNode("surface", "ND_surface_unlit",
                  {{"emission", number(2.0f)}, {"emission_color", color(0.1f, 0.2f, 0.3f)}})}));
    ASSERT_TRUE(c.program->hasEmission());
    expectColor(c.program->emission(ShadingPoint(), glm::vec3(0, 0, 1)), 0.2f, 0.4f, 0.6f);
}

TEST(Overrides, ReplaceValuesAndConnections) {
    const Network network =
        previewNetwork({}, {{"diffuseColor", {"c", ""}}}, {makeNode("c", "ND_constant_color3")});
    Value value;
    ASSERT_TRUE(parseOverride(network, "/m/surface.inputs:diffuseColor", "(1, 0.5, 0)", value));
    Diagnostics diagnostics;
    const Network changed = applyOverrides(network, {{"diffuseColor", value}}, diagnostics);
    EXPECT_EQ(changed.nodes[1].connections.count("diffuseColor"), 0u);
    EXPECT_EQ(changed.nodes[1].inputs.at("diffuseColor").numbers,
              (std::vector<float>{1.0f, 0.5f, 0.0f}));
    EXPECT_TRUE(parseOverride(network, "roughness", "0.2", value));
    EXPECT_TRUE(parseOverride(network, "opacityMode", "presence", value));
    EXPECT_FALSE(parseOverride(network, "roughness", "smooth", value));
    EXPECT_FALSE(parseOverride(network, "sparkle", "1", value));
    applyOverrides(network, {{"sparkle", number(1.0f)}}, diagnostics);
    EXPECT_EQ(diagnostics.count(), 1);
}

} // namespace patina
