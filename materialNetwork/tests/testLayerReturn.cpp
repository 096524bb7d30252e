// SPDX-License-Identifier: Apache-2.0
// Layers by albedo scaling, the default, and by the method `returned`: both lose nothing where
// nothing is absorbed, and gain nothing. The first follows its definition, the second counts what
// an interface sends back down to its base.
#include "materialNetwork/cpu/programCode.h"
#include "materialNetwork/planner/planner.h"
#include "materialNetwork/tests/statistics.h"
#include "shaders/oracle.h"

#include <cmath>

namespace patina {

namespace {

NetworkNode interface(const char* name, float ior, float alpha, Inputs more = {}) {
    more["ior"] = number(ior);
    more["roughness"] = pair(alpha);
    return makeNode(name, "ND_dielectric_bsdf", std::move(more));
}

NetworkNode diffuse(const char* name, const Value& c) {
    return makeNode(name, "ND_oren_nayar_diffuse_bsdf", {{"color", c}});
}

NetworkNode metal(const char* name, const Value& c, float alpha) {
    return makeNode(name, "ND_generalized_schlick_bsdf",
                    {{"color0", c}, {"color90", c}, {"roughness", pair(alpha)}});
}

NetworkNode layer(const char* name, const char* top, const char* base) {
    return makeNode(name, "ND_layer_bsdf", {}, {{"top", {top, ""}}, {"base", {base, ""}}});
}

const MethodChoices scaled = {}, returned = {{"layering", "returned"}};

glm::vec3 albedoOf(const Network& network, float degrees, const MethodChoices& methods) {
    const auto program = compiled(network, methods);
    ShadingPoint point;
    point.viewDirection = direction(degrees);
    Bsdf bsdf;
    program->evaluate(point, bsdf);
    return bsdf.albedo();
}

/// Everything that a stack of white things and interfaces can be.
std::vector<std::pair<const char*, Network>> lossless() {
    const Value one = grey(1.0f);
    const NetworkNode white = diffuse("base", one);
    const NetworkNode film = makeNode("top", "ND_dielectric_bsdf",
                                      {{"roughness", pair(0.0f)},
                                       {"thinfilm_thickness", number(420.0f)},
                                       {"thinfilm_ior", number(2.0f)}});
    const NetworkNode roughFilm = makeNode("top", "ND_dielectric_bsdf",
                                           {{"roughness", pair(0.3f)},
                                            {"thinfilm_thickness", number(420.0f)},
                                            {"thinfilm_ior", number(2.0f)}});
    const NetworkNode red =
        makeNode("top", "ND_generalized_schlick_bsdf",
                 {{"color0", color(1.0f, 0.4f, 0.4f)}, {"roughness", pair(0.1f)}});
    const NetworkNode glass = interface("base", 1.5f, 0.2f, {{"scatter_mode", text("RT")}});
    const NetworkNode half = interface("top", 1.5f, 0.0f, {{"weight", number(0.5f)}});
    const NetworkNode first = interface("top", 1.4f, 0.1f), second = interface("inner", 1.8f, 0.0f);
    const NetworkNode mixed = makeNode("base", "ND_mix_bsdf", {{"mix", number(0.3f)}},
                                       {{"fg", {"a", ""}}, {"bg", {"b", ""}}});
    const NetworkNode mirror = metal("a", one, 0.2f), lambert = diffuse("b", one);
    const NetworkNode through = makeNode("a", "ND_translucent_bsdf", {{"color", one}});
    const NetworkNode over = layer("bsdf", "top", "base");
    return {{"film", bsdfNetwork({film, white, over})},
            {"rough film", bsdfNetwork({roughFilm, white, over})},
            {"Schlick", bsdfNetwork({red, white, over})},
            {"half covered", bsdfNetwork({half, white, over})},
            {"metal", bsdfNetwork({first, metal("base", one, 0.3f), over})},
            {"metal and diffuse", bsdfNetwork({first, mirror, lambert, mixed, over})},
            {"what passes and diffuse", bsdfNetwork({first, through, lambert, mixed, over})},
            {"glass", bsdfNetwork({first, glass, over})},
            {"two", bsdfNetwork({first, second, white, layer("lower", "inner", "base"),
                                 layer("bsdf", "top", "lower")})}};
}

} // namespace

// The method `largest` takes in all channels what the brightest reflects.
TEST(LayerReturn, LosesNothingWhereNothingAbsorbs) {
    for (const MethodChoices& methods : {scaled, returned})
        for (const auto& [name, network] : lossless())
            for (const float degrees : {0.0f, 60.0f, 80.0f}) {
                const glm::vec3 a = albedoOf(network, degrees, methods);
                for (int c = 0; c < 3; ++c)
                    EXPECT_NEAR(a[c], 1.0f, 2e-3f) << name << " " << degrees << " " << c;
            }
    const glm::vec3 largest =
        albedoOf(lossless()[0].second, 60.0f, {{"layerTransmittance", "largest"}});
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
                     {diffuse("base", grey(a)), metal("base", grey(a), 0.0f)}) {
                    const Network network = bsdfNetwork(
                        {interface("top", ior, 0.0f), base, layer("bsdf", "top", "base")});
                    const float f = sh::fresnelDielectric(direction(degrees).z, ior);
                    for (const double tolerance : {-1.0, 0.0, 0.01, 0.5}) {
                        const MethodPlan plan =
                            planMaterialMethods(network, textures, diagnostics, {}, tolerance);
                        EXPECT_NEAR(albedoOf(network, degrees, methodsOf(plan, {})).x,
                                    f + (1.0f - f) * a, 1e-3f)
                            << ior << " " << a << " " << degrees << " " << tolerance;
                    }
                }
}

// F + (1 - F) a (1 - R) / (1 - a R), with R the reflectance for diffuse light from inside.
TEST(LayerReturn, SmoothOverDiffuseIsAGeometricSeries) {
    for (const float ior : {1.2f, 1.5f, 2.0f, 3.0f}) {
        double mean = 0.0;
        const int n = 20000;
        for (int i = 0; i < n; ++i) {
            const double c = (i + 0.5) / n;
            mean += 2.0 * c * sh64::fresnelDielectric(c, double(ior)) / n;
        }
        const double inside = 1.0 - (1.0 - mean) / double(ior * ior);
        for (const float a : {0.05f, 0.5f, 0.9f})
            for (const float degrees : {0.0f, 70.0f}) {
                const double f = sh64::fresnelDielectric(double(direction(degrees).z), double(ior));
                const double truth =
                    f + (1.0 - f) * double(a) * (1.0 - inside) / (1.0 - double(a) * inside);
                const glm::vec3 found =
                    albedoOf(bsdfNetwork({interface("top", ior, 0.0f), diffuse("base", grey(a)),
                                          layer("bsdf", "top", "base")}),
                             degrees, returned);
                EXPECT_NEAR(double(found.x), truth, 3e-3) << ior << " " << a << " " << degrees;
            }
    }
}

// A smooth interface over a mirror: light leaves at the angle that it came in by.
TEST(LayerReturn, SmoothOverMirrorIsASeriesOfMirrors) {
    for (const float degrees : {0.0f, 60.0f}) {
        const double f = sh64::fresnelDielectric(double(direction(degrees).z), 1.5);
        const double truth = f + (1.0 - f) * (1.0 - f) * 0.5 / (1.0 - 0.5 * f);
        const glm::vec3 found =
            albedoOf(bsdfNetwork({interface("top", 1.5f, 0.0f), metal("base", grey(0.5f), 0.0f),
                                  layer("bsdf", "top", "base")}),
                     degrees, returned);
        EXPECT_NEAR(double(found.x), truth, 1e-4) << degrees;
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
                        bsdfNetwork({interface("top", 1.6f, alpha, {{"weight", number(cover)}}),
                                     interface("inner", 1.3f, 0.2f), metal("a", a, 0.3f),
                                     layer("lower", "inner", "b"), diffuse("b", b),
                                     makeNode("base", "ND_mix_bsdf", {{"mix", number(0.6f)}},
                                              {{"fg", {"a", ""}}, {"bg", {"lower", ""}}}),
                                     layer("bsdf", "top", "base")});
                    for (const MethodChoices& methods : {scaled, returned})
                        for (const float degrees : {0.0f, 75.0f}) {
                            const glm::vec3 found = albedoOf(network, degrees, methods);
                            for (int c = 0; c < 3; ++c) {
                                EXPECT_LE(found[c], 1.002f);
                                EXPECT_GE(found[c], 0.0f);
                            }
                        }
                }
}

// A tint of the interface colours the top alone; so does a factor on it.
TEST(LayerReturn, TintsColourTheTopAlone) {
    const Value orange = color(1.0f, 0.5f, 0.0f);
    const Network tinted = bsdfNetwork({interface("top", 1.5f, 0.0f, {{"tint", orange}}),
                                        diffuse("base", grey(1.0f)), layer("bsdf", "top", "base")}),
                  factored =
                      bsdfNetwork({interface("bare", 1.5f, 0.0f),
                                   makeNode("top", "ND_multiply_bsdfC", {{"in2", orange}},
                                            {{"in1", {"bare", ""}}}),
                                   diffuse("base", grey(1.0f)), layer("bsdf", "top", "base")});
    for (const MethodChoices& methods : {scaled, returned})
        for (const Network& network : {tinted, factored})
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(albedoOf(network, 0.0f, methods)[c], 1.0f - 0.02f * float(c), 1e-4f)
                    << c;
}

// Of a layer that is the other half of one interface nothing comes back.
TEST(LayerReturn, GlassOfTwoHalvesStaysWhole) {
    for (const float alpha : {0.0f, 0.3f}) {
        const NetworkNode half = interface("base", 1.5f, alpha, {{"scatter_mode", text("T")}});
        const Network glass =
            bsdfNetwork({interface("top", 1.5f, alpha), half, layer("bsdf", "top", "base")});
        EXPECT_NEAR(albedoOf(glass, 30.0f, scaled).x, albedoOf(glass, 30.0f, returned).x, 1e-6f);
    }
}

TEST(LayerReturn, SamplesAndValuesAgree) {
    for (const MethodChoices& methods : {scaled, returned})
        for (const auto& [name, network] : lossless())
            expectSamplesAndValuesAgree(*compiled(network, methods), direction(50.0f), name, 20000,
                                        7);
}

} // namespace patina
