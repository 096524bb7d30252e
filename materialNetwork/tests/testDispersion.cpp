// SPDX-License-Identifier: Apache-2.0
// Iors by wavelength: what models make of an Abbe number, and when a program disperses.
#include "materialNetwork/tests/materialFixture.h"

#include "shaders/patterns.h"

using namespace patina;

namespace {

constexpr float lineD = 587.56f, lineF = 486.13f, lineC = 656.27f; // nm

struct Model {
    const char *id, *transmission, *ior, *roughness, *dispersion;
    float asked;  ///< value of the input
    float number; ///< the Abbe number that it asks for
};

const Model models[] = {
    {"ND_open_pbr_surface_surfaceshader", "transmission_weight", "specular_ior",
     "specular_roughness", "transmission_dispersion_scale", 0.5f, 40.0f}, // of number 20
    {"ND_standard_surface_surfaceshader", "transmission", "specular_IOR", "specular_roughness",
     "transmission_dispersion", 25.0f, 25.0f},
    {"ND_standard_surface_surfaceshader_100", "transmission", "specular_IOR", "specular_roughness",
     "transmission_dispersion", 25.0f, 25.0f},
    {"ND_gltf_pbr_surfaceshader", "transmission", "ior", "roughness", "dispersion", 0.8f, 25.0f},
};

Network glass(const Model& m, float asked, float transmission = 1.0f) {
    Inputs inputs = {
        {m.transmission, transmission}, {m.ior, 1.6f}, {m.roughness, 0.0f}, {m.dispersion, asked}};
    if (std::string(m.ior) == "ior") inputs["metallic"] = 0.0f;
    return modelNetwork(m.id, std::move(inputs));
}

/// By what light of a wavelength is bent that comes at 40 degrees, from Snell's law.
float iorOf(const MaterialProgram& program, float nm) {
    ShadingPoint point = seenFrom(direction(40.0f));
    point.wavelength = nm;
    const Bsdf bsdf = lobesAt(program, point);
    for (float uLobe = 0.01f; uLobe < 1.0f; uLobe += 0.02f) {
        const BsdfSample s = bsdf.sample(glm::vec3(0.5f), uLobe);
        if ((s.event & sh::LOBE_TRANSMIT) == 0) continue;
        return std::sin(glm::radians(40.0f)) / std::hypot(s.wi.x, s.wi.y);
    }
    return 0.0f;
}

} // namespace

TEST(Dispersion, TheIorsOfThreeLinesGiveTheAbbeNumber) {
    for (const float ior : {1.3f, 1.5f, 2.4f, 0.7f})
        for (const float abbe : {9.0f, 20.0f, 60.0f})
            for (const float scale : {0.25f, 1.0f}) {
                const auto n = [&](float nm) {
                    return sh::patternDispersedIor(ior, abbe, scale, nm);
                };
                EXPECT_NEAR(n(lineD), ior, 1e-6f);
                EXPECT_NEAR((n(lineD) - 1.0f) / (n(lineF) - n(lineC)), abbe / scale,
                            2e-3f * abbe / scale); // of differences of floats
            }
}

TEST(Dispersion, NoNumberScaleOrWavelengthLeavesTheIor) {
    for (const float nm : {0.0f, 400.0f, 700.0f}) {
        EXPECT_EQ(sh::patternDispersedIor(1.6f, 0.0f, 1.0f, nm), 1.6f);
        EXPECT_EQ(sh::patternDispersedIor(1.6f, 20.0f, 0.0f, nm), 1.6f);
        EXPECT_EQ(sh::patternDispersedIor(1.6f, -20.0f, 1.0f, nm), 1.6f);
        EXPECT_EQ(sh::patternDispersedIor(0.0f, 20.0f, 1.0f, nm), 0.0f) << "Fresnel off";
        // Whatever is asked for, glass stays glass and a bubble a bubble.
        EXPECT_GE(sh::patternDispersedIor(1.6f, 0.01f, 1.0f, nm), 1.0f);
        EXPECT_LE(sh::patternDispersedIor(0.6f, 0.01f, 1.0f, nm), 1.0f);
    }
    EXPECT_EQ(sh::patternDispersedIor(1.6f, 20.0f, 1.0f, 0.0f), 1.6f);
}

TEST(Dispersion, EveryModelBendsWavelengthsByItsNumber) {
    for (const Model& m : models) {
        const CleanCompiled c(glass(m, m.asked));
        ASSERT_TRUE(c->disperses()) << m.id;
        const float d = iorOf(*c.program, lineD), f = iorOf(*c.program, lineF),
                    red = iorOf(*c.program, lineC);
        EXPECT_NEAR(d, 1.6f, 1e-4f) << m.id;
        // Each ior is good to about 1e-6, their difference is 0.015 at least.
        EXPECT_NEAR((d - 1.0f) / (f - red), m.number, 0.02f * m.number) << m.id;
        EXPECT_EQ(iorOf(*c.program, 0.0f), d) << m.id;
    }
}

TEST(Dispersion, OnlyWhatAsksForItAndLetsLightThroughDisperses) {
    for (const Model& m : models) {
        EXPECT_FALSE(Compiled(glass(m, 0.0f))->disperses()) << m.id;
        EXPECT_FALSE(Compiled(glass(m, m.asked, 0.0f))->disperses()) << m.id;
        // A program that does not disperse is the one that never heard of it.
        EXPECT_EQ(Compiled(glass(m, 0.0f))->ir().surfaceCode.size(), 0u) << m.id;
    }
    // A connected input may turn out to be a constant.
    for (const float scale : {0.0f, 0.25f}) {
        const Network network = modelNetwork(
            models[0].id, {{"transmission_weight", 1.0f}},
            {{"transmission_dispersion_scale", "product"}},
            {makeNode("product", "ND_multiply_float", {{"in1", 2.0f}, {"in2", scale}})});
        EXPECT_EQ(Compiled(network)->disperses(), scale > 0.0f);
    }
}
