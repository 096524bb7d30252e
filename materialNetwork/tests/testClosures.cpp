// SPDX-License-Identifier: Apache-2.0
// Every BSDF node through the whole way from network to Bsdf: it is modelled, gains no energy, and
// is sampled by the density that it states.
#include "materialNetwork/tests/materialFixture.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

struct Case {
    const char* id;
    Inputs inputs;
    float budget = 2e-3f; ///< how far the albedo may be above 1
};

const std::vector<Case> cases = {
    {"ND_sheen_bsdf", {{"color", grey(1.0f)}, {"roughness", number(0.05f)}}},
    {"ND_sheen_bsdf", {{"color", grey(1.0f)}, {"roughness", number(0.8f)}}},
    {"ND_sheen_bsdf", {{"color", grey(1.0f)}, {"mode", text("zeltner")}}},
    {"ND_dielectric_bsdf", {{"thinfilm_thickness", number(500.0f)}, {"roughness", pair(0.2f)}}},
    {"ND_dielectric_bsdf",
     {{"thinfilm_thickness", number(500.0f)},
      {"thinfilm_ior", number(1.33f)},
      {"ior", number(1.0f)},
      {"scatter_mode", text("RT")},
      {"roughness", pair(0.2f)}},
     2e-2f},
    {"ND_conductor_bsdf", {{"thinfilm_thickness", number(300.0f)}, {"roughness", pair(0.2f)}}},
    {"ND_generalized_schlick_bsdf",
     {{"thinfilm_thickness", number(300.0f)},
      {"color0", grey(0.3f)},
      {"scatter_mode", text("RT")},
      {"roughness", pair(0.2f)}},
     2e-2f},
    {"ND_conductor_bsdf",
     {{"distribution", text("beckmann")}, {"roughness", Value::makeVec2(0.1f, 0.4f)}}},
    {"ND_dielectric_bsdf",
     {{"distribution", text("beckmann")}, {"roughness", pair(0.4f)}, {"scatter_mode", text("RT")}},
     2e-2f},
    {"ND_generalized_schlick_bsdf",
     {{"distribution", text("beckmann")}, {"color0", grey(0.5f)}, {"roughness", pair(0.7f)}}},
    {"ND_chiang_hair_bsdf", {}},
    {"ND_chiang_hair_bsdf", {{"absorption_coefficient", Value::makeVec3(0.2f, 0.5f, 1.0f)}}},
    {"ND_patina_lambert_bsdf", {{"color", grey(1.0f)}}},
    {"ND_patina_phong_bsdf", {{"exponent", number(1.0f)}}},
    {"ND_patina_phong_bsdf", {{"exponent", number(100.0f)}}},
    {"ND_patina_blinn_phong_bsdf", {{"exponent", number(1.0f)}}},
    {"ND_patina_blinn_phong_bsdf", {{"exponent", number(100.0f)}}},
    {"ND_patina_ward_bsdf", {{"roughness", Value::makeVec2(0.1f, 0.4f)}}},
    {"ND_patina_cook_torrance_bsdf", {}},
    {"ND_patina_cook_torrance_bsdf", {{"fresnel", text("schlick")}}},
};

ShadingPoint seenFrom(const glm::vec3& wo) {
    ShadingPoint point;
    point.viewDirection = wo;
    return point;
}

std::string describe(const Case& c, float theta) {
    return std::string(c.id) + " at " + std::to_string(theta);
}

} // namespace

TEST(Closures, AreModelledAndKeepEnergy) {
    for (const Case& c : cases) {
        const Network network = bsdfNetwork({makeNode("bsdf", c.id, c.inputs)});
        Compiled compiled(network);
        EXPECT_EQ(warnings(compiled.diagnostics), "") << c.id;
        for (const float theta : {0.0f, 40.0f, 75.0f, 89.0f, 89.9f}) {
            Bsdf bsdf;
            compiled.program->evaluate(seenFrom(direction(theta, 20.0f)), bsdf);
            ASSERT_EQ(bsdf.lobeCount(), 1) << describe(c, theta);
            const glm::vec3 a = bsdf.albedo();
            EXPECT_LE(std::max({a.x, a.y, a.z}), 1.0f + c.budget) << describe(c, theta);
            EXPECT_GT(std::max({a.x, a.y, a.z}), 0.0f) << describe(c, theta);
        }
    }
}

TEST(Closures, SamplesAgreeWithEval) {
    for (const Case& c : cases) {
        Compiled compiled(bsdfNetwork({makeNode("bsdf", c.id, c.inputs)}));
        Random random(5);
        int found = 0;
        for (int i = 0; i < 300; ++i) {
            Bsdf bsdf;
            const glm::vec3 wo = random.direction();
            compiled.program->evaluate(seenFrom(wo), bsdf);
            const BsdfSample s = bsdf.sample(random.next3(), random.next());
            if (s.event == 0 || (s.event & sh::LOBE_DELTA) != 0) continue;
            const BsdfEval e = bsdf.eval(s.wi);
            const glm::vec3 f = e.diffuse + e.specular;
            EXPECT_NEAR(s.pdf / e.pdf, 1.0f, 5e-3f) << c.id;
            EXPECT_NEAR(s.weight.y, f.y / e.pdf, 5e-3f * (1.0f + s.weight.y)) << c.id;
            ++found;
        }
        EXPECT_GT(found, 30) << c.id;
    }
}

// A sheen layer takes from its base what it reflects, whatever its colour.
TEST(Closures, SheenScalesTheBaseByItsAlbedo) {
    for (const char* mode : {"conty_kulla", "zeltner"})
        for (const float theta : {10.0f, 60.0f, 85.0f}) {
            const auto layered = [&](const Value& tint) {
                Compiled c(bsdfNetwork(
                    {makeNode("top", "ND_sheen_bsdf", {{"color", tint}, {"mode", text(mode)}}),
                     makeNode("base", "ND_oren_nayar_diffuse_bsdf", {{"color", grey(1.0f)}}),
                     makeNode("bsdf", "ND_layer_bsdf", {},
                              {{"top", {"top", ""}}, {"base", {"base", ""}}})}));
                Bsdf bsdf;
                c.program->evaluate(seenFrom(direction(theta)), bsdf);
                return bsdf.albedo();
            };
            EXPECT_NEAR(layered(grey(1.0f)).x, 1.0f, 1e-5f) << mode << theta;
            const glm::vec3 red = layered(color(1.0f, 0.0f, 0.0f));
            EXPECT_NEAR(red.x, 1.0f, 1e-5f) << mode << theta;
            EXPECT_LT(red.y, 0.999f) << mode << theta;
            EXPECT_GE(red.y, 0.0f) << mode << theta;
        }
}

// The thin_film_bsdf of MaterialX 1.38 on top of a layer is the input of 1.39.
TEST(Closures, OldThinFilmCoatsWhatIsBelow) {
    const Inputs metal = {{"roughness", pair(0.3f)}};
    Inputs coated = metal;
    coated["thinfilm_thickness"] = number(420.0f);
    coated["thinfilm_ior"] = number(1.7f);
    Compiled now(bsdfNetwork({makeNode("bsdf", "ND_conductor_bsdf", coated)}));
    Compiled old(bsdfNetwork(
        {makeNode("film", "ND_thin_film_bsdf",
                  {{"thickness", number(420.0f)}, {"ior", number(1.7f)}}),
         makeNode("metal", "ND_conductor_bsdf", metal),
         makeNode("same", "ND_mix_bsdf", {{"mix", number(0.25f)}},
                  {{"fg", {"metal", ""}}, {"bg", {"metal", ""}}}),
         makeNode("bsdf", "ND_layer_bsdf", {}, {{"top", {"film", ""}}, {"base", {"same", ""}}})}));
    EXPECT_EQ(warnings(old.diagnostics), "");
    Bsdf a, b;
    now.program->evaluate(seenFrom(direction(50.0f)), a);
    old.program->evaluate(seenFrom(direction(50.0f)), b);
    for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(a.albedo()[i], b.albedo()[i], 1e-6f);
        EXPECT_NEAR(a.eval(direction(45.0f, 180.0f)).specular[i],
                    b.eval(direction(45.0f, 180.0f)).specular[i], 1e-5f);
    }
    EXPECT_GT(std::fabs(a.albedo().x - a.albedo().z), 0.02f);
    Compiled alone(bsdfNetwork({makeNode("bsdf", "ND_thin_film_bsdf")}));
    EXPECT_NE(warnings(alone.diagnostics).find("coats only as the top"), std::string::npos);
}

// The helpers at their defaults, against the formulas by hand.
TEST(Closures, DistributionChoosesTheFacets) {
    const auto value = [&](const char* distribution) {
        Compiled c(bsdfNetwork(
            {makeNode("bsdf", "ND_conductor_bsdf",
                      {{"roughness", pair(0.3f)}, {"distribution", text(distribution)}})}));
        EXPECT_TRUE(c.diagnostics.all().empty()) << warnings(c.diagnostics);
        Bsdf bsdf;
        c.program->evaluate(seenFrom(direction(30.0f)), bsdf);
        return bsdf.eval(direction(60.0f)).specular.x;
    };
    // Far from the mirror direction Beckmann's tail is the thinner one.
    EXPECT_LT(value("beckmann"), 0.1f * value("ggx"));
    EXPECT_GT(value("beckmann"), 0.0f);
}

TEST(Closures, HairHelpersFeedTheLobe) {
    const auto albedo = [](std::vector<NetworkNode> helpers, const Connections& connections) {
        helpers.push_back(makeNode("bsdf", "ND_chiang_hair_bsdf", {}, connections));
        Compiled c(bsdfNetwork(std::move(helpers)));
        EXPECT_EQ(warnings(c.diagnostics), "");
        Bsdf bsdf;
        c.program->evaluate(seenFrom(direction(20.0f, 90.0f)), bsdf);
        return bsdf.albedo();
    };
    const glm::vec3 melanin = albedo({makeNode("melanin", "ND_deon_hair_absorption_from_melanin")},
                                     {{"absorption_coefficient", {"melanin", ""}}});
    const float m = -std::log(0.75f) * 0.5f;
    Compiled byHand(bsdfNetwork({makeNode(
        "bsdf", "ND_chiang_hair_bsdf",
        {{"absorption_coefficient",
          Value::makeVec3(m * (0.419f + 0.187f), m * (0.697f + 0.4f), m * (1.37f + 1.05f))}})}));
    Bsdf bsdf;
    byHand.program->evaluate(seenFrom(direction(20.0f, 90.0f)), bsdf);
    for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(melanin[i], bsdf.albedo()[i], 1e-4f);
    const glm::vec3 white = albedo(
        {makeNode("color", "ND_chiang_hair_absorption_from_color"),
         makeNode("rough", "ND_chiang_hair_roughness")},
        {{"absorption_coefficient", {"color", ""}}, {"roughness_TT", {"rough", "roughness_TT"}}});
    EXPECT_NEAR(white.x, 1.0f, 1e-3f);
}

TEST(Closures, EdfsDependOnTheDirection) {
    const auto emitted = [](std::vector<NetworkNode> nodes, float theta) {
        nodes.push_back(makeNode("surface", "ND_surface", {}, {{"edf", {"edf", ""}}}));
        Compiled c(makeNetwork(std::move(nodes)));
        EXPECT_EQ(warnings(c.diagnostics), "");
        return c.program->emission(seenFrom(direction(theta)), direction(theta));
    };
    const auto cone = [&](float inner, float outer, float theta) {
        return emitted({makeNode("edf", "ND_conical_edf",
                                 {{"color", color(2.0f, 1.0f, 0.0f)},
                                  {"inner_angle", number(inner)},
                                  {"outer_angle", number(outer)}})},
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
        NetworkNode edf =
            makeNode("edf", "ND_generalized_schlick_edf",
                     {{"color0", grey(0.75f)}, {"color90", grey(0.0f)}}, {{"base", {"glow", ""}}});
        return emitted({makeNode("glow", "ND_uniform_edf", {{"color", grey(4.0f)}}), edf}, theta).x;
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
    const auto network = [](Inputs inputs) {
        return makeNetwork({makeNode("edf", "ND_measured_edf", std::move(inputs)),
                            makeNode("surface", "ND_surface", {}, {{"edf", {"edf", ""}}})});
    };
    FakeTextures textures;
    textures.profile = std::make_shared<Profile>();
    Diagnostics diagnostics;
    const auto program =
        compileMaterial(network({{"color", grey(3.0f)}, {"file", Value::makeFilename("lamp.ies")}}),
                        textures, diagnostics);
    EXPECT_EQ(warnings(diagnostics), "");
    for (float theta : {10.0f, 40.0f, 80.0f})
        for (float phi : {0.0f, 70.0f, 200.0f}) {
            const glm::vec3 wo = direction(theta, phi);
            const float expected =
                3.0f * std::cos(glm::radians(theta)) * (2.0f + std::cos(glm::radians(phi)));
            EXPECT_NEAR(program->emission(seenFrom(wo), wo).y, expected, 1e-4f) << theta << phi;
            // The other side emits alike.
            const glm::vec3 back(wo.x, wo.y, -wo.z);
            EXPECT_NEAR(program->emission(seenFrom(back), back).y, expected, 1e-4f) << theta;
        }
    Compiled without(network({{"color", grey(3.0f)}}));
    EXPECT_EQ(warnings(without.diagnostics),
              "/m/edf [file] names no IES file; it emits the same everywhere\n");
    EXPECT_EQ(without.program->emission(ShadingPoint(), direction(50.0f)).x, 3.0f);
}

// Names of MaterialX 1.38 and earlier stand for the same lobes.
TEST(Closures, OldNamesAreTheSameLobes) {
    const std::vector<std::pair<const char*, const char*>> names = {
        {"ND_diffuse_brdf", "ND_oren_nayar_diffuse_bsdf"},
        {"ND_oren_nayar_diffuse_brdf", "ND_oren_nayar_diffuse_bsdf"},
        {"ND_burley_diffuse_brdf", "ND_burley_diffuse_bsdf"},
        {"ND_diffuse_btdf", "ND_translucent_bsdf"},
        {"ND_dielectric_brdf", "ND_dielectric_bsdf"},
        {"ND_conductor_brdf", "ND_conductor_bsdf"},
        {"ND_generalized_schlick_brdf", "ND_generalized_schlick_bsdf"},
        {"ND_subsurface_brdf", "ND_subsurface_bsdf"},
        {"ND_sheen_brdf", "ND_sheen_bsdf"}};
    const auto bsdf = [&](const char* id, Inputs inputs) {
        Compiled c(bsdfNetwork({makeNode("bsdf", id, std::move(inputs))}));
        EXPECT_EQ(warnings(c.diagnostics), "") << id;
        Bsdf result;
        c.program->evaluate(seenFrom(direction(40.0f)), result);
        return result;
    };
    for (const auto& [old, current] : names) {
        EXPECT_GT(bsdf(old, {}).lobeCount(), 0) << old;
        EXPECT_EQ(bsdf(old, {}).albedo(), bsdf(current, {}).albedo()) << old;
        EXPECT_EQ(bsdf(old, {}).lobe(0).kind, bsdf(current, {}).lobe(0).kind) << old;
    }
    // The transmitting half by its own name, and by mode.
    EXPECT_EQ(bsdf("ND_dielectric_btdf", {}).albedo(),
              bsdf("ND_dielectric_bsdf", {{"scatter_mode", text("T")}}).albedo());
    // A radius was once a vector.
    Bsdf beneath = bsdf("ND_subsurface_bsdf", {{"radius", Value::makeVec3(1.0f, 0.5f, 0.2f)}});
    beneath.walkSubsurface();
    const BsdfSample entering = beneath.sample(glm::vec3(0.5f), 0.5f);
    ASSERT_NE(entering.event & LOBE_SUBSURFACE, 0);
    EXPECT_EQ(beneath.subsurface(entering).radius, glm::vec3(1.0f, 0.5f, 0.2f));
}

TEST(Closures, UnknownChoicesAreReported) {
    Compiled c(bsdfNetwork({makeNode("bsdf", "ND_sheen_bsdf", {{"mode", text("velvet")}})}));
    EXPECT_EQ(warnings(c.diagnostics),
              "/m/bsdf [mode] 'velvet' is not known; conty_kulla is used\n");
}

} // namespace patina
