// SPDX-License-Identifier: Apache-2.0
// Layers by albedo scaling, the default, and by the method `returned`: both lose nothing where
// nothing is absorbed, and gain nothing. The first follows its definition, the second counts what
// an interface sends back down to its base.
#include "materialNetwork/cpu/programCode.h"
#include "materialNetwork/ir/layerWeights.h"
#include "materialNetwork/planner/planner.h"
#include "materialNetwork/tests/layerFixture.h"

using namespace patina;

namespace {

NetworkNode metal(const char* name, const Value& c, float alpha) {
    return makeNode(name, "ND_generalized_schlick_bsdf",
                    {{"color0", c}, {"color90", c}, {"roughness", pair(alpha)}});
}

const MethodChoices scaled = {}, returned = {{"layering", "returned"}};

/// Everything that a stack of white things and interfaces can be.
std::vector<std::pair<const char*, Network>> lossless() {
    const Value one = grey(1.0f);
    const NetworkNode white = diffuseNode("base", one), first = interfaceNode("top", 1.4f, 0.1f),
                      mixed = mixNode("base", "a", "b", 0.3f);
    const auto film = [](float alpha) {
        return interfaceNode("top", 1.5f, alpha,
                             {{"thinfilm_thickness", 420.0f}, {"thinfilm_ior", 2.0f}});
    };
    return {
        {"film", layered({film(0.0f), white})},
        {"rough film", layered({film(0.3f), white})},
        {"Schlick",
         layered({makeNode("top", "ND_generalized_schlick_bsdf",
                           {{"color0", color(1.0f, 0.4f, 0.4f)}, {"roughness", pair(0.1f)}}),
                  white})},
        {"half covered", layered({interfaceNode("top", 1.5f, 0.0f, {{"weight", 0.5f}}), white})},
        {"metal", layered({first, metal("base", one, 0.3f)})},
        {"metal and diffuse",
         layered({first, metal("a", one, 0.2f), diffuseNode("b", one), mixed})},
        {"what passes and diffuse",
         layered({first, makeNode("a", "ND_translucent_bsdf", {{"color", one}}),
                  diffuseNode("b", one), mixed})},
        {"glass", layered({first, interfaceNode("base", 1.5f, 0.2f, {{"scatter_mode", "RT"}})})},
        {"two", layered({first, interfaceNode("inner", 1.8f, 0.0f), diffuseNode("lower", one),
                         layerNode("base", "inner", "lower")})}};
}

} // namespace

// The method `largest` takes in all channels what the brightest reflects.
TEST(LayerReturn, LosesNothingWhereNothingAbsorbs) {
    for (const MethodChoices& methods : {scaled, returned})
        for (const auto& [name, network] : lossless())
            for (const float degrees : {0.0f, 60.0f, 80.0f}) {
                SCOPED_TRACE(name + std::to_string(degrees));
                expectVector(albedoOf(network, direction(degrees), methods), glm::vec3(1.0f),
                             2e-3f);
            }
    const glm::vec3 largest =
        albedoOf(lossless()[0].second, direction(60.0f), {{"layerTransmittance", "largest"}});
    EXPECT_NEAR(largest.x, 1.0f, 2e-3f);
    EXPECT_LT(largest.y, 0.9f);
    EXPECT_LT(largest.z, 0.96f);
}

// A base of albedo a under an interface of reflectance F shows F + (1 - F) a, whatever the
// tolerance is, and whatever the base is.
TEST(LayerScaling, SmoothOverAnythingIsItsDefinition) {
    FakeTextures textures;
    Diagnostics diagnostics;
    for (const float ior : {1.2f, 1.5f, 2.0f, 3.0f})
        for (const float a : {0.05f, 0.5f, 1.0f})
            for (const float degrees : {0.0f, 70.0f})
                for (const NetworkNode& base :
                     {diffuseNode("base", grey(a)), metal("base", grey(a), 0.0f)}) {
                    const Network network = layered({interfaceNode("top", ior, 0.0f), base});
                    const float f = sh::fresnelDielectric(direction(degrees).z, ior);
                    for (const double tolerance : {-1.0, 0.0, 0.01, 0.5}) {
                        const MethodPlan plan =
                            planMaterialMethods(network, textures, diagnostics, {}, tolerance);
                        EXPECT_NEAR(albedoOf(network, direction(degrees), methodsOf(plan, {})).x,
                                    f + (1.0f - f) * a, 1e-3f)
                            << ior << " " << a << " " << degrees << " " << tolerance;
                    }
                }
}

TEST(LayerReturn, SmoothOverDiffuseIsAGeometricSeries) {
    for (const float ior : {1.2f, 1.5f, 2.0f, 3.0f})
        for (const float a : {0.05f, 0.5f, 0.9f})
            for (const float degrees : {0.0f, 70.0f})
                EXPECT_NEAR(albedoOf(layered({interfaceNode("top", ior, 0.0f),
                                              diffuseNode("base", grey(a))}),
                                     direction(degrees), returned)
                                .x,
                            interfaceOverDiffuse(ior, a, degrees), 3e-3)
                    << ior << " " << a << " " << degrees;
}

// A smooth interface over a mirror: light leaves at the angle that it came in by.
TEST(LayerReturn, SmoothOverMirrorIsASeriesOfMirrors) {
    const Network network =
        layered({interfaceNode("top", 1.5f, 0.0f), metal("base", grey(0.5f), 0.0f)});
    for (const float degrees : {0.0f, 60.0f}) {
        const double f = sh64::fresnelDielectric(double(direction(degrees).z), 1.5);
        EXPECT_NEAR(albedoOf(network, direction(degrees), returned).x,
                    f + (1.0 - f) * (1.0 - f) * 0.5 / (1.0 - 0.5 * f), 1e-4)
            << degrees;
    }
}

// Every part is as bright as it can be at most, and some are white.
TEST(LayerReturn, GainsNothing) {
    const Value shades[] = {grey(0.0f), color(1.0f, 0.5f, 0.0f), grey(1.0f)};
    for (const Value& a : shades)
        for (const Value& b : shades)
            for (const float alpha : {0.0f, 0.3f})
                for (const float cover : {0.4f, 1.0f}) {
                    const Network network =
                        layered({interfaceNode("top", 1.6f, alpha, {{"weight", cover}}),
                                 interfaceNode("inner", 1.3f, 0.2f), metal("a", a, 0.3f),
                                 layerNode("lower", "inner", "b"), diffuseNode("b", b),
                                 mixNode("base", "a", "lower", 0.6f)});
                    for (const MethodChoices& methods : {scaled, returned})
                        for (const float degrees : {0.0f, 75.0f}) {
                            const glm::vec3 found = albedoOf(network, direction(degrees), methods);
                            expectVector(glm::clamp(found, 0.0f, 1.002f), found, 0.0f);
                        }
                }
}

// A tint of the interface colours the top alone; so does a factor on it.
TEST(LayerReturn, TintsColourTheTopAlone) {
    const Value orange = color(1.0f, 0.5f, 0.0f);
    const Network tinted = layered({interfaceNode("top", 1.5f, 0.0f, {{"tint", orange}}),
                                    diffuseNode("base", grey(1.0f))}),
                  factored = layered(
                      {interfaceNode("bare", 1.5f, 0.0f),
                       makeNode("top", "ND_multiply_bsdfC", {{"in2", orange}}, {{"in1", "bare"}}),
                       diffuseNode("base", grey(1.0f))});
    for (const MethodChoices& methods : {scaled, returned})
        for (const Network& network : {tinted, factored})
            expectVector(albedoOf(network, {0, 0, 1}, methods), 1.0f, 0.98f, 0.96f, 1e-4f);
}

// Of a layer that is the other half of one interface nothing comes back.
TEST(LayerReturn, GlassOfTwoHalvesStaysWhole) {
    for (const float alpha : {0.0f, 0.3f}) {
        const NetworkNode half = interfaceNode("base", 1.5f, alpha, {{"scatter_mode", "T"}});
        const Network glass = layered({interfaceNode("top", 1.5f, alpha), half});
        const glm::vec3 wo = direction(30.0f);
        EXPECT_NEAR(albedoOf(glass, wo, scaled).x, albedoOf(glass, wo, returned).x, 1e-6f);
    }
}

TEST(LayerReturn, SamplesAndValuesAgree) {
    for (const MethodChoices& methods : {scaled, returned})
        for (const auto& [name, network] : lossless())
            expectSamplesAndValuesAgree(*compiled(network, methods), direction(50.0f), name, 20000,
                                        7);
}

// Also over closures that are added, whose albedo may be above 1.
TEST(LayerBound, NoMoreLeavesThanTheBaseHasOfWhatEnters) {
    test::Random random(3);
    for (int i = 0; i < 100000; ++i) {
        // Shares near 1 are the worst: those of films over what reflects all.
        const auto share = [&] {
            const float u = random();
            return i % 3 == 0 ? u : i % 3 == 1 ? 1.0f - 1e-3f * u * u : std::round(u);
        };
        const float mirrored = 2.0f * random(), spread = 2.0f * random();
        const float transmitted = i % 2 ? 2.0f * random() : 0.0f;
        const float coverage = share(), inside = share(), alpha = share(), z = share();
        const sh::LayerLight base =
            sh::layerLight(glm::vec3(mirrored), glm::vec3(spread), glm::vec3(transmitted));
        const sh::LayerLight through =
            sh::layerThrough(1.0f, glm::vec3(coverage), glm::vec3(inside), alpha, z, base);
        const float leaves = through.mirrored.x * mirrored + through.spread.x * spread +
                             through.transmitted.x * transmitted;
        // Five roundings of numbers near 1, each 2^-24, over a divisor of 1e-6 at least: 0.3.
        ASSERT_LE(leaves,
                  (1.0f - coverage) * std::max(mirrored + spread + transmitted, 1.0f) * 1.3f)
            << mirrored << " " << spread << " " << transmitted << " " << coverage << " " << inside
            << " " << alpha << " " << z;
    }
}
