// SPDX-License-Identifier: Apache-2.0
// Every BSDF node through the whole way from network to Bsdf: it is modelled, gains no energy, and
// is sampled by the density that it states.
#include "materialNetwork/tests/statistics.h"

using namespace patina;

namespace {

struct Case {
    const char* id;
    Inputs inputs;
    float budget = 2e-3f; ///< how far the albedo may be above 1
};

const std::vector<Case> cases = {
    {"ND_sheen_bsdf", {{"color", grey(1.0f)}, {"roughness", 0.05f}}},
    {"ND_sheen_bsdf", {{"color", grey(1.0f)}, {"roughness", 0.8f}}},
    {"ND_sheen_bsdf", {{"color", grey(1.0f)}, {"mode", "zeltner"}}},
    {"ND_dielectric_bsdf", {{"thinfilm_thickness", 500.0f}, {"roughness", pair(0.2f)}}},
    {"ND_dielectric_bsdf",
     {{"thinfilm_thickness", 500.0f},
      {"thinfilm_ior", 1.33f},
      {"ior", 1.0f},
      {"scatter_mode", "RT"},
      {"roughness", pair(0.2f)}},
     2e-2f},
    {"ND_conductor_bsdf", {{"thinfilm_thickness", 300.0f}, {"roughness", pair(0.2f)}}},
    {"ND_generalized_schlick_bsdf",
     {{"thinfilm_thickness", 300.0f},
      {"color0", grey(0.3f)},
      {"scatter_mode", "RT"},
      {"roughness", pair(0.2f)}},
     2e-2f},
    {"ND_conductor_bsdf", {{"distribution", "beckmann"}, {"roughness", vector(0.1f, 0.4f)}}},
    {"ND_dielectric_bsdf",
     {{"distribution", "beckmann"}, {"roughness", pair(0.4f)}, {"scatter_mode", "RT"}},
     2e-2f},
    {"ND_generalized_schlick_bsdf",
     {{"distribution", "beckmann"}, {"color0", grey(0.5f)}, {"roughness", pair(0.7f)}}},
    {"ND_chiang_hair_bsdf", {}},
    {"ND_chiang_hair_bsdf", {{"absorption_coefficient", vector(0.2f, 0.5f, 1.0f)}}},
    {"ND_patina_lambert_bsdf", {{"color", grey(1.0f)}}},
    {"ND_patina_phong_bsdf", {{"exponent", 1.0f}}},
    {"ND_patina_phong_bsdf", {{"exponent", 100.0f}}},
    {"ND_patina_blinn_phong_bsdf", {{"exponent", 1.0f}}},
    {"ND_patina_blinn_phong_bsdf", {{"exponent", 100.0f}}},
    {"ND_patina_ward_bsdf", {{"roughness", vector(0.1f, 0.4f)}}},
    {"ND_patina_cook_torrance_bsdf", {}},
    {"ND_patina_cook_torrance_bsdf", {{"fresnel", "schlick"}}},
};

} // namespace

TEST(Closures, AreModelledAndKeepEnergy) {
    for (const Case& c : cases) {
        SCOPED_TRACE(c.id);
        const CleanCompiled compiled(lobeNetwork(c.id, c.inputs));
        for (const float theta : {0.0f, 40.0f, 75.0f, 89.0f, 89.9f}) {
            const Bsdf bsdf = compiled.lobes(direction(theta, 20.0f));
            ASSERT_EQ(bsdf.lobeCount(), 1) << theta;
            const glm::vec3 a = bsdf.albedo();
            EXPECT_LE(std::max({a.x, a.y, a.z}), 1.0f + c.budget) << theta;
            EXPECT_GT(std::max({a.x, a.y, a.z}), 0.0f) << theta;
        }
    }
}

TEST(Closures, SamplesAgreeWithEval) {
    for (const Case& c : cases) {
        SCOPED_TRACE(c.id);
        const Compiled compiled(lobeNetwork(c.id, c.inputs));
        Random random(5);
        int found = 0;
        for (int i = 0; i < 300; ++i)
            found += expectSampleIsOfEval(compiled.lobes(random.direction()), random, 5e-3f);
        EXPECT_GT(found, 30);
    }
}

// A sheen layer takes from its base what it reflects, whatever its colour.
TEST(Closures, SheenScalesTheBaseByItsAlbedo) {
    for (const char* mode : {"conty_kulla", "zeltner"})
        for (const float theta : {10.0f, 60.0f, 85.0f}) {
            SCOPED_TRACE(mode + std::to_string(theta));
            const auto under = [&](const Value& tint) {
                return albedoOf(
                    layered({makeNode("top", "ND_sheen_bsdf", {{"color", tint}, {"mode", mode}}),
                             diffuseNode("base", grey(1.0f))}),
                    direction(theta));
            };
            EXPECT_NEAR(under(grey(1.0f)).x, 1.0f, 1e-5f);
            const glm::vec3 red = under(color(1.0f, 0.0f, 0.0f));
            EXPECT_NEAR(red.x, 1.0f, 1e-5f);
            EXPECT_LT(red.y, 0.999f);
            EXPECT_GE(red.y, 0.0f);
        }
}

// The thin_film_bsdf of MaterialX 1.38 on top of a layer is the input of 1.39.
TEST(Closures, OldThinFilmCoatsWhatIsBelow) {
    const Given rough = pair(0.3f);
    const Compiled now(lobeNetwork(
        "ND_conductor_bsdf",
        {{"roughness", rough}, {"thinfilm_thickness", 420.0f}, {"thinfilm_ior", 1.7f}}));
    const CleanCompiled old(
        layered({makeNode("top", "ND_thin_film_bsdf", {{"thickness", 420.0f}, {"ior", 1.7f}}),
                 makeNode("metal", "ND_conductor_bsdf", {{"roughness", rough}}),
                 mixNode("base", "metal", "metal", 0.25f)}));
    const Bsdf a = now.lobes(direction(50.0f)), b = old.lobes(direction(50.0f));
    const glm::vec3 wi = direction(45.0f, 180.0f);
    expectVector(a.albedo(), b.albedo(), 1e-6f);
    expectVector(a.eval(wi).specular, b.eval(wi).specular, 1e-5f);
    EXPECT_GT(std::fabs(a.albedo().x - a.albedo().z), 0.02f);
    const Compiled alone(lobeNetwork("ND_thin_film_bsdf"));
    EXPECT_TRUE(told(alone, "coats only as the top"));
}

TEST(Closures, DistributionChoosesTheFacets) {
    const auto value = [&](const char* distribution) {
        const CleanCompiled c(lobeNetwork(
            "ND_conductor_bsdf", {{"roughness", pair(0.3f)}, {"distribution", distribution}}));
        return c.lobes(direction(30.0f)).eval(direction(60.0f)).specular.x;
    };
    // Far from the mirror direction Beckmann's tail is the thinner one.
    EXPECT_LT(value("beckmann"), 0.1f * value("ggx"));
    EXPECT_GT(value("beckmann"), 0.0f);
}

// The helpers at their defaults, against the formulas by hand.
TEST(Closures, HairHelpersFeedTheLobe) {
    const auto albedo = [](std::vector<NetworkNode> helpers, const Inputs& inputs,
                           const Connections& connections = {}) {
        helpers.push_back(makeNode("bsdf", "ND_chiang_hair_bsdf", inputs, connections));
        return albedoOf(bsdfNetwork(std::move(helpers)), direction(20.0f, 90.0f));
    };
    const float m = -std::log(0.75f) * 0.5f;
    expectVector(
        albedo({makeNode("melanin", "ND_deon_hair_absorption_from_melanin")}, {},
               {{"absorption_coefficient", "melanin"}}),
        albedo({}, {{"absorption_coefficient",
                     vector(m * (0.419f + 0.187f), m * (0.697f + 0.4f), m * (1.37f + 1.05f))}}),
        1e-4f);
    const glm::vec3 white =
        albedo({makeNode("color", "ND_chiang_hair_absorption_from_color"),
                makeNode("rough", "ND_chiang_hair_roughness")},
               {}, {{"absorption_coefficient", "color"}, {"roughness_TT", "rough.roughness_TT"}});
    EXPECT_NEAR(white.x, 1.0f, 1e-3f);
}

TEST(Closures, EdfsDependOnTheDirection) {
    const auto emitted = [](std::vector<NetworkNode> nodes, float theta) {
        const CleanCompiled c(edfNetwork(std::move(nodes)));
        return c->emission(seenFrom(direction(theta)), direction(theta));
    };
    const auto cone = [&](float inner, float outer, float theta) {
        return emitted({makeNode("edf", "ND_conical_edf",
                                 {{"color", color(2.0f, 1.0f, 0.0f)},
                                  {"inner_angle", inner},
                                  {"outer_angle", outer}})},
                       theta);
    };
    EXPECT_NEAR(cone(60.0f, 0.0f, 29.0f).x, 2.0f, 1e-5f);
    EXPECT_EQ(cone(60.0f, 0.0f, 31.0f).x, 0.0f);
    EXPECT_NEAR(cone(60.0f, 0.0f, 151.0f).x, 2.0f, 1e-5f); // both sides emit
    EXPECT_NEAR(cone(60.0f, 120.0f, 29.0f).x, 2.0f, 1e-5f);
    // Half way in the cosine between 30 and 60 degrees.
    const float half = std::acos(0.5f * (0.8660254f + 0.5f)) * 57.29578f;
    EXPECT_NEAR(cone(60.0f, 120.0f, half).y, 0.5f, 1e-4f);
    EXPECT_EQ(cone(60.0f, 120.0f, 61.0f).x, 0.0f);

    const auto schlick = [&](float theta) {
        return emitted({makeNode("glow", "ND_uniform_edf", {{"color", grey(4.0f)}}),
                        makeNode("edf", "ND_generalized_schlick_edf",
                                 {{"color0", grey(0.75f)}, {"color90", grey(0.0f)}},
                                 {{"base", "glow"}})},
                       theta)
            .x;
    };
    EXPECT_NEAR(schlick(0.0f), 3.0f, 1e-5f);
    EXPECT_NEAR(schlick(60.0f), 3.0f * (1.0f - 1.0f / 32.0f), 1e-4f);
    EXPECT_LT(schlick(89.9f), 0.05f);
}

TEST(Closures, MeasuredEdfFollowsItsProfile) {
    struct Profile : EmissionProfile {
        float factor(float theta, float phi) const override {
            return std::cos(theta) * (2.0f + std::cos(phi));
        }
    };
    const auto network = [](const Inputs& inputs) {
        return edfNetwork({makeNode("edf", "ND_measured_edf", inputs)});
    };
    FakeTextures textures;
    textures.profile = std::make_shared<Profile>();
    Diagnostics diagnostics;
    const auto program = compileMaterial(
        network({{"color", grey(3.0f)}, {"file", file("lamp.ies")}}), textures, diagnostics);
    EXPECT_TRUE(nothingTold(diagnostics));
    for (float theta : {10.0f, 40.0f, 80.0f})
        for (float phi : {0.0f, 70.0f, 200.0f}) {
            const glm::vec3 wo = direction(theta, phi);
            const float expected =
                3.0f * std::cos(glm::radians(theta)) * (2.0f + std::cos(glm::radians(phi)));
            for (const glm::vec3& w : {wo, glm::vec3(wo.x, wo.y, -wo.z)}) // both sides emit alike
                EXPECT_NEAR(program->emission(seenFrom(w), w).y, expected, 1e-4f) << theta << phi;
        }
    Compiled without(network({{"color", grey(3.0f)}}));
    EXPECT_EQ(warnings(without), "/m/edf [file] names no IES file; it emits the same everywhere\n");
    EXPECT_EQ(without->emission(ShadingPoint(), direction(50.0f)).x, 3.0f);
}

// Names of MaterialX 1.38 and earlier stand for the same lobes.
TEST(Closures, OldNamesAreTheSameLobes) {
    const std::pair<const char*, const char*> names[] = {
        {"ND_diffuse_brdf", "ND_oren_nayar_diffuse_bsdf"},
        {"ND_oren_nayar_diffuse_brdf", "ND_oren_nayar_diffuse_bsdf"},
        {"ND_burley_diffuse_brdf", "ND_burley_diffuse_bsdf"},
        {"ND_diffuse_btdf", "ND_translucent_bsdf"},
        {"ND_dielectric_brdf", "ND_dielectric_bsdf"},
        {"ND_conductor_brdf", "ND_conductor_bsdf"},
        {"ND_generalized_schlick_brdf", "ND_generalized_schlick_bsdf"},
        {"ND_subsurface_brdf", "ND_subsurface_bsdf"},
        {"ND_sheen_brdf", "ND_sheen_bsdf"}};
    const auto bsdf = [&](const char* id, const Inputs& inputs = {}) {
        const Compiled c(lobeNetwork(id, inputs));
        EXPECT_EQ(warnings(c), "") << id;
        return c.lobes(direction(40.0f));
    };
    for (const auto& [old, current] : names) {
        const Bsdf a = bsdf(old), b = bsdf(current);
        ASSERT_GT(a.lobeCount(), 0) << old;
        EXPECT_EQ(a.albedo(), b.albedo()) << old;
        EXPECT_EQ(a.lobe(0).kind, b.lobe(0).kind) << old;
    }
    // The transmitting half by its own name, and by mode.
    EXPECT_EQ(bsdf("ND_dielectric_btdf").albedo(),
              bsdf("ND_dielectric_bsdf", {{"scatter_mode", "T"}}).albedo());
    // A radius was once a vector.
    Bsdf beneath = bsdf("ND_subsurface_bsdf", {{"radius", vector(1.0f, 0.5f, 0.2f)}});
    beneath.walkSubsurface();
    const BsdfSample entering = beneath.sample(glm::vec3(0.5f), 0.5f);
    ASSERT_NE(entering.event & LOBE_SUBSURFACE, 0);
    EXPECT_EQ(beneath.subsurface(entering).radius, glm::vec3(1.0f, 0.5f, 0.2f));
}

TEST(Closures, UnknownChoicesAreReported) {
    Compiled c(lobeNetwork("ND_sheen_bsdf", {{"mode", "velvet"}}));
    EXPECT_EQ(warnings(c), "/m/bsdf [mode] 'velvet' is not known; conty_kulla is used\n");
}
