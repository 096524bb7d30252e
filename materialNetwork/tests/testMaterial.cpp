// SPDX-License-Identifier: Apache-2.0
// Programs: what they ask for, what they say about themselves, patterns, textures, overrides.
#include "materialNetwork/tests/patternFixture.h"

using namespace patina;

TEST(Material, FlagsOfADefaultPreviewSurface) {
    const Compiled c(previewNetwork());
    EXPECT_TRUE(c->constant());
    EXPECT_TRUE(c->isOpaque());
    EXPECT_FALSE(c->hasEmission());
    EXPECT_FALSE(c->hasTransmission());
    EXPECT_FALSE(c->usesUv());
    EXPECT_TRUE(c->primvars().empty());
    EXPECT_TRUE(nothingTold(c));
}

TEST(Material, DisplayColorIsReadWithItsDefault) {
    const Compiled c(makeDisplayColorNetwork());
    ASSERT_EQ(c->primvars().size(), 2u);
    EXPECT_FALSE(c->isOpaque());
    EXPECT_TRUE(c->isOpaqueWith({0, -1}));
    EXPECT_FALSE(c->isOpaqueWith({0, 1}));
    const PointWith red(*c.program, {{"displayColor", glm::vec4(1, 0, 0, 1)},
                                     {"displayOpacity", glm::vec4(0.25f)}});
    EXPECT_GT(c.lobes(red).albedo().x, c.albedo().x + 0.5f);
    EXPECT_NEAR(c->opacity(red), 0.25f, 1e-6f);
}

TEST(Material, OpacityThresholdCutsOut) {
    for (const auto& [authored, shown] : {std::pair(0.49f, 0.0f), {0.5f, 1.0f}}) {
        const Compiled c(previewNetwork({{"opacity", authored}, {"opacityThreshold", 0.5f}}));
        EXPECT_FALSE(c->hasTransmission());
        EXPECT_EQ(c->opacity(ShadingPoint()), shown);
    }
}

TEST(Material, VaryingOpacityPassesLightStraight) {
    const Compiled c(previewNetwork({{"roughness", 0.0f}, {"diffuseColor", grey(1.0f)}},
                                    {{"opacity", "x.result"}},
                                    {makeNode("x", "UsdPrimvarReader_float", {{"varname", "o"}})}));
    EXPECT_FALSE(c->hasTransmission());
    EXPECT_FALSE(c->isOpaque());
    for (const float opacity : {0.0f, 0.5f, 1.0f})
        for (const float theta : {0.0f, 60.0f}) {
            const PointWith point(*c.program, {{"o", glm::vec4(opacity)}},
                                  seenFrom(direction(theta)));
            const float presence = c->opacity(point);
            const Bsdf bsdf = c.lobes(point);
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
    const Compiled c(lobeNetwork("ND_dielectric_bsdf",
                                 {{"scatter_mode", "RT"},
                                  {"ior", 1.5f},
                                  {"tint", color(tint.x, tint.y, tint.z)},
                                  {"roughness", pair(0.0f)}},
                                 {{"thin_walled", true}}));
    EXPECT_FALSE(c->hasTransmission());
    EXPECT_FALSE(c->isOpaque());
    for (const float theta : {0.0f, 60.0f, 180.0f}) {
        SCOPED_TRACE(theta);
        const ShadingPoint point = seenFrom(direction(theta));
        glm::vec3 passes(0.0f);
        const float opacity = c->opacity(point, &passes);
        const Bsdf bsdf = c.lobes(point);
        EXPECT_FALSE(bsdf.transmits());
        const float once = sh::fresnelDielectric(std::abs(point.viewDirection.z), 1.5f);
        const float slab = 2.0f * once / (1.0f + once);
        const BsdfSample s = bsdf.sample(glm::vec3(0.5f), 0.5f);
        ASSERT_EQ(s.event, sh::LOBE_REFLECT | sh::LOBE_DELTA);
        expectVector((1.0f - opacity) * passes, tint * (1.0f - slab), 1e-4f);
        expectVector(opacity * s.weight, tint * slab, 1e-4f);
    }
}

TEST(Material, ConstantOpacityIsGlass) {
    const Compiled c(previewNetwork({{"opacity", 0.0f}}));
    EXPECT_TRUE(c->hasTransmission());
    EXPECT_TRUE(c->isOpaque());
    const Bsdf bsdf = c.lobes(direction(45.0f));
    EXPECT_TRUE(bsdf.transmits());
    const BsdfSample s = bsdf.sample(glm::vec3(0.5f), 0.99f);
    ASSERT_EQ(s.event, sh::LOBE_TRANSMIT | sh::LOBE_DELTA);
    // Snell's law: sin 45 / 1.5.
    EXPECT_NEAR(-s.wi.x, 0.70710678f / 1.5f, 1e-5f);
}

TEST(Material, TexturesAreReadWithScaleBiasAndChannels) {
    const auto shown = [](const char* name, const char* output, Inputs inputs = {}) {
        inputs["file"] = file(name);
        inputs["scale"] = color4(2, 2, 2, 1);
        inputs["scale"].type = ValueType::Vec4;
        return emitted(emitting({makeNode("st", "UsdPrimvarReader_float2", {{"varname", "uv"}}),
                                 makeNode("x", "UsdUVTexture", inputs, {{"st", "st.result"}})},
                                output),
                       {}, {{"uv", glm::vec4(0.25f, 0.5f, 0, 0)}});
    };
    expectVector(shown("a.png", "rgb"), 0.5f, 1.0f, 1.0f);
    expectVector(shown("a.png", "g"), 1.0f, 1.0f, 1.0f);
    // A missing file shows the source's own sign, magenta, unless a fallback is authored.
    expectVector(shown("missing.png", "rgb"), 2.0f, 0.0f, 2.0f);
    Given fallback = color4(0.1f, 0.2f, 0.3f, 1.0f);
    fallback.type = ValueType::Vec4;
    expectVector(shown("missing.png", "rgb", {{"fallback", fallback}}), 0.1f, 0.2f, 0.3f);
}

TEST(Material, WrapModesReachTheTextureSource) {
    const Compiled c(emitting(
        {makeNode("x", "UsdUVTexture",
                  {{"file", file("a.png")}, {"wrapS", "mirror"}, {"sourceColorSpace", "raw"}})},
        "rgb"));
    ASSERT_EQ(c.textures.requests.size(), 1u);
    EXPECT_EQ(c.textures.requests[0].wrapS, TextureWrap::Mirror);
    EXPECT_EQ(c.textures.requests[0].wrapT, TextureWrap::Black);
    EXPECT_EQ(c.textures.requests[0].colorSpace, "raw");
    EXPECT_EQ(c.textures.requests[0].prim, "/m/x");
    EXPECT_TRUE(c->usesUv());
}

TEST(Material, Transform2dScalesRotatesTranslates) {
    const NetworkNode node = makeNode("y", "UsdTransform2d",
                                      {{"in", vector(1, 0)},
                                       {"scale", vector(2, 2)},
                                       {"rotation", 90.0f},
                                       {"translation", vector(0.5f, 0.25f)}});
    expectVector(emitted(showing({node}, "y.result", "vector3")), 0.5f, 2.25f, 0.0f);
}

TEST(Material, HsvThereAndBack) {
    for (const glm::vec3& rgb : {glm::vec3(1, 0, 0), glm::vec3(0.2f, 0.7f, 0.4f),
                                 glm::vec3(0.1f, 0.05f, 0.9f), glm::vec3(0.5f)})
        expectVector(emitted(emitting({makeNode("hsv", "ND_rgbtohsv_color3",
                                                {{"in", color(rgb.x, rgb.y, rgb.z)}}),
                                       makeNode("x", "ND_hsvtorgb_color3", {}, {{"in", "hsv"}})})),
                     rgb);
}

TEST(Material, NormalMapsTiltTheFrame) {
    const Compiled c(previewNetwork({{"roughness", 0.0f},
                                     {"metallic", 1.0f},
                                     {"diffuseColor", grey(1.0f)},
                                     {"normal", vector(0.6f, 0.0f, 0.8f)}}));
    const BsdfSample s = c.lobes().sample(glm::vec3(0.5f), 0.5f);
    ASSERT_NE(s.event, 0);
    // The mirror direction of z about (0.6, 0, 0.8).
    expectVector(s.wi, 0.96f, 0.0f, 0.28f);
}

TEST(Material, ObjectSpaceUndoesTheTransform) {
    ShadingPoint point;
    point.objectToWorldNormal = glm::mat3(0, 1, 0, -1, 0, 0, 0, 0, 1); // x to y
    point.normal = glm::vec3(0, 1, 0);
    const NetworkNode n = makeNode("n", "ND_normal_vector3");
    expectVector(emitted(showing({n}, "n", "vector3"), point), 1.0f, 0.0f, 0.0f);
}

TEST(Overrides, ReplaceValuesAndConnections) {
    const Network network =
        previewNetwork({}, {{"diffuseColor", "c"}}, {makeNode("c", "ND_constant_color3")});
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
