// SPDX-License-Identifier: Apache-2.0
// The mean of a ball under a white sky, seen by an orthographic camera: beside the closed form of
// albedo scaling, and beside another renderer's ball.
#include "materialNetwork/tests/statistics.h"

#include <functional>

using namespace patina;

namespace {

using Albedo = std::function<float(const glm::vec3&)>;

constexpr int cosines = 64;

/// The mean over the disc of the ball: over the cosine c with the weight 2 c.
float meanOf(const Albedo& albedo) {
    float sum = 0.0f;
    for (int i = 0; i < cosines; ++i) {
        const float c = (float(i) + 0.5f) / float(cosines);
        sum += 2.0f * c * albedo({std::sqrt(1.0f - c * c), 0.0f, c}) / float(cosines);
    }
    return sum;
}

Albedo curveOf(const Network& network) {
    const auto program = compiled(network, {{"directionalAlbedo", "quadrature"}});
    return [program](const glm::vec3& wo) { return lobesAt(*program, seenFrom(wo)).albedo().x; };
}

Albedo interfaceOf(float roughness) {
    return curveOf(lobeNetwork("ND_dielectric_bsdf", {{"roughness", pair(roughness * roughness)}}));
}

Albedo schlickOf(const Value& color0, const Value& color90) {
    return curveOf(
        lobeNetwork("ND_generalized_schlick_bsdf",
                    {{"color0", color0}, {"color90", color90}, {"roughness", pair(0.04f)}}));
}

/// Patina's ball, what albedo scaling says, and the mean of Cycles' Principled BSDF with the same
/// numbers (Blender 5.0.1, 64 x 64 pixels, 256 samples).
void expectMean(const char* name, Inputs inputs, const char* model, const Albedo& closedForm,
                float cycles) {
    const float found = meanOf(curveOf(modelNetwork(model, std::move(inputs))));
    EXPECT_NEAR(found, meanOf(closedForm), 2e-3f) << name;
    EXPECT_NEAR(found / cycles, 1.0f, 0.03f) << name;
}

} // namespace

TEST(LayerMeans, PlasticCoatSheenAndMetalLookAsInOtherRenderers) {
    struct Base {
        float grey, smooth, rough, coat, sheen, metal;
    };
    const char* standard = "ND_standard_surface_surfaceshader";
    const auto smooth = interfaceOf(0.2f), middle = interfaceOf(0.5f), rough = interfaceOf(0.6f),
               coat = interfaceOf(0.1f),
               fuzz = curveOf(
                   lobeNetwork("ND_sheen_bsdf", {{"roughness", 0.5f}, {"mode", "zeltner"}}));
    for (const Base& b : {Base{0.8f, 0.8175f, 0.8085f, 0.8277f, 0.8326f, 0.8080f},
                          Base{0.4f, 0.4523f, 0.4294f, 0.4850f, 0.4997f, 0.4247f},
                          Base{0.05f, 0.1329f, 0.0976f, 0.1851f, 0.2085f, 0.0905f}}) {
        const auto over = [&](const auto& top, const auto& below) {
            return [=](const glm::vec3& wo) { return top(wo) + (1.0f - top(wo)) * below(wo); };
        };
        const auto diffuse = [&](const glm::vec3&) { return b.grey; };
        const Value c = grey(b.grey);
        const auto plastic = [&](float roughness) {
            return Inputs{{"base", 1.0f}, {"base_color", c}, {"specular_roughness", roughness}};
        };
        expectMean("smooth plastic", plastic(0.2f), standard, over(smooth, diffuse), b.smooth);
        expectMean("rough plastic", plastic(0.6f), standard, over(rough, diffuse), b.rough);
        Inputs coated = plastic(0.5f);
        coated["coat"] = number(1.0f);
        coated["coat_roughness"] = number(0.1f);
        const auto uncoated = over(middle, diffuse);
        expectMean("coat", coated, standard, over(coat, uncoated), b.coat);
        expectMean("sheen",
                   {{"base_color", c},
                    {"specular_roughness", 0.5f},
                    {"fuzz_weight", 1.0f},
                    {"fuzz_roughness", 0.5f}},
                   "ND_open_pbr_surface_surfaceshader", over(fuzz, uncoated), b.sheen);
        expectMean("metal",
                   {{"base_color", c}, {"specular_roughness", 0.2f}, {"base_metalness", 1.0f}},
                   "ND_open_pbr_surface_surfaceshader", schlickOf(c, grey(1.0f)), b.metal);
    }
}

// F0 and F90 as OpenUSD's Storm has them (previewSurface.glslfx): a metal reflects its albedo at
// all angles.
TEST(LayerMeans, MetalAndClearcoatOfUsdPreviewSurface) {
    const float albedo = 0.1f, ior = 2.0f, ofIor = 1.0f / 9.0f;
    for (const float metallic : {0.0f, 0.5f, 1.0f}) {
        const float edge = 1.0f + metallic * (albedo - 1.0f);
        const auto interface =
            schlickOf(grey(edge * (ofIor + metallic * (1.0f - ofIor))), grey(edge));
        const auto closedForm = [&](const glm::vec3& wo) {
            return interface(wo) + (1.0f - interface(wo)) * (1.0f - metallic) * albedo;
        };
        EXPECT_NEAR(meanOf(curveOf(previewNetwork({{"diffuseColor", grey(albedo)},
                                                   {"roughness", 0.2f},
                                                   {"ior", ior},
                                                   {"metallic", metallic}}))),
                    meanOf(closedForm), 2e-3f)
            << metallic;
    }
    const auto coat = curveOf(previewNetwork({{"diffuseColor", grey(0.0f)},
                                              {"useSpecularWorkflow", 1},
                                              {"specularColor", grey(0.0f)},
                                              {"roughness", 1.0f},
                                              {"clearcoat", 1.0f},
                                              {"clearcoatRoughness", 0.0f},
                                              {"ior", ior}}));
    EXPECT_NEAR(coat({0.0f, 0.0f, 1.0f}), ofIor, 1e-3f);
}
