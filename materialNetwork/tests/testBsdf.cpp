// SPDX-License-Identifier: Apache-2.0
// The BSDF of whole materials: energy, sampling, layers, sides.
#include "materialNetwork/tests/statistics.h"
#include "shaders/tests/pearson.h"

using namespace patina;

namespace {

const std::pair<const char*, Inputs> variants[] = {
    {"white plastic", {{"diffuseColor", grey(1.0f)}}},
    {"smooth plastic", {{"diffuseColor", grey(1.0f)}, {"roughness", 0.0f}}},
    {"rough plastic", {{"diffuseColor", grey(1.0f)}, {"roughness", 1.0f}}},
    {"white metal", {{"diffuseColor", grey(1.0f)}, {"metallic", 1.0f}}},
    {"half metal", {{"diffuseColor", color(1, 0.5f, 0.2f)}, {"metallic", 0.5f}}},
    {"coated", {{"diffuseColor", grey(1.0f)}, {"clearcoat", 1.0f}}},
    {"rough coat over metal",
     {{"diffuseColor", grey(1.0f)},
      {"metallic", 1.0f},
      {"clearcoat", 1.0f},
      {"clearcoatRoughness", 0.7f}}},
    {"specular workflow",
     {{"diffuseColor", grey(1.0f)},
      {"useSpecularWorkflow", 1},
      {"specularColor", color(0.9f, 0.4f, 0.1f)}}},
    {"glass", {{"opacity", 0.0f}, {"roughness", 0.0f}}},
    {"half glass", {{"diffuseColor", grey(1.0f)}, {"opacity", 0.5f}}},
};

} // namespace

// Budget: the tables are within 2e-3 of the albedo that sampling finds, and no variant gains.
TEST(Bsdf, PreviewSurfaceNeverGainsEnergy) {
    for (const auto& [name, inputs] : variants) {
        const Compiled c(previewNetwork(inputs));
        for (const float theta : {0.0f, 30.0f, 60.0f, 80.0f, 89.0f}) {
            SCOPED_TRACE(std::string(name) + " at " + std::to_string(theta));
            const Bsdf bsdf = c.lobes(direction(theta, 20.0f));
            const glm::vec3 a = bsdf.albedo();
            EXPECT_LE(std::max({a.x, a.y, a.z}), 1.002f);
            EXPECT_GE(std::min({a.x, a.y, a.z}), 0.0f);
            // Four standard errors: p = 6e-5 per comparison, 50 comparisons, one fixed seed.
            const Mean sampled = sampledAlbedo(*c.program, direction(theta, 20.0f), 20000);
            EXPECT_NEAR(sampled.mean(), a.x, 4.0 * sampled.error() + 4e-3);
        }
    }
}

TEST(Bsdf, WhiteLambertIsExact) {
    const Compiled c(lobeNetwork("ND_oren_nayar_diffuse_bsdf", {{"color", grey(0.8f)}}));
    const Bsdf bsdf = c.lobes(direction(50.0f));
    EXPECT_NEAR(bsdf.albedo().x, 0.8f, 1e-6f);
    const glm::vec3 wi = direction(25.0f, 130.0f);
    EXPECT_NEAR(bsdf.eval(wi).diffuse.x, 0.8f * 0.31830989f * wi.z, 1e-6f);
    EXPECT_NEAR(bsdf.eval(wi).pdf, 0.31830989f * wi.z, 1e-6f);
}

TEST(Bsdf, LambertLobesComeOut) {
    const glm::vec3 none(0.0f);
    for (const auto& [name, inputs] : variants) {
        SCOPED_TRACE(name);
        const Compiled c(previewNetwork(inputs));
        const Bsdf whole = c.lobes(direction(50.0f, 20.0f));
        const LambertPart part = whole.lambertPart();
        Bsdf others = whole;
        const float left = others.dropLambert();
        EXPECT_TRUE(others.lambertPart().empty());
        const glm::vec3 sum = part.reflected + part.transmitted + others.albedo();
        EXPECT_NEAR(glm::length(sum - whole.albedo()), 0.0f, 1e-6f);
        float probability = 0.0f, kept = 0.0f;
        for (int i = 0; i < others.lobeCount(); ++i)
            probability += others.lobe(i).probability;
        for (int i = 0; i < whole.lobeCount(); ++i)
            kept += whole.lobe(i).diffuse ? 0.0f : whole.lobe(i).probability;
        EXPECT_NEAR(left, kept, 1e-6f);
        EXPECT_EQ(others.empty(), left == 0.0f);
        EXPECT_NEAR(probability, others.empty() ? 0.0f : 1.0f, 1e-6f);
        for (const float theta : {10.0f, 60.0f, 120.0f}) {
            const glm::vec3 wi = direction(theta, 200.0f);
            EXPECT_EQ(others.eval(wi).diffuse, none);
            EXPECT_EQ(others.eval(wi).specular, whole.eval(wi).specular);
        }
    }
}

TEST(Bsdf, LambertPartIsOfLambertLobesAlone) {
    const auto lobes = [](const char* id, Inputs inputs) {
        inputs["color"] = grey(0.7f);
        const Compiled c(lobeNetwork(id, inputs));
        return c.lobes(direction(50.0f));
    };
    EXPECT_NEAR(lobes("ND_translucent_bsdf", {}).lambertPart().transmitted.x, 0.7f, 1e-6f);
    EXPECT_EQ(lobes("ND_translucent_bsdf", {}).lambertPart().reflected, glm::vec3(0.0f));
    EXPECT_NEAR(lobes("ND_oren_nayar_diffuse_bsdf", {}).lambertPart().reflected.x, 0.7f, 1e-6f);
    Bsdf skin = lobes("ND_subsurface_bsdf", {});
    EXPECT_NEAR(skin.lambertPart().reflected.x, 0.7f, 1e-6f);
    skin.walkSubsurface();
    EXPECT_TRUE(skin.lambertPart().empty());
    EXPECT_EQ(skin.dropLambert(), 1.0f);
    for (const char* id : {"ND_oren_nayar_diffuse_bsdf", "ND_burley_diffuse_bsdf", "ND_sheen_bsdf"})
        EXPECT_TRUE(lobes(id, {{"roughness", 0.5f}}).lambertPart().empty()) << id;
    const glm::vec3 tilted = direction(30.0f, 40.0f);
    const Bsdf bent =
        lobes("ND_oren_nayar_diffuse_bsdf", {{"normal", vector(tilted.x, tilted.y, tilted.z)}});
    EXPECT_NEAR(glm::dot(bent.lambertPart().normal, tilted), 1.0f, 1e-6f);
}

TEST(Bsdf, SampleAgreesWithEval) {
    for (const auto& [name, inputs] : variants) {
        SCOPED_TRACE(name);
        const Compiled c(previewNetwork(inputs));
        Random random(11);
        // Half vectors are rebuilt from float directions, which narrow lobes feel.
        for (int i = 0; i < 400; ++i)
            expectSampleIsOfEval(c.lobes(random.direction()), random, 2e-3f);
    }
}

// Pearson's chi-squared of sample() against the pdf of eval() over 10 x 20 bins of the hemisphere.
// Significance 0.01 over 5 materials and 3 seeds; a material fails when 2 of 3 seeds reject.
TEST(Bsdf, SamplingFollowsTheDensity) {
    const int n = 100000;
    const test::DirectionBins bins{10, 20, 0.0};
    for (const size_t which : {size_t(0), size_t(2), size_t(4), size_t(5), size_t(7)}) {
        const Bsdf bsdf =
            Compiled(previewNetwork(variants[which].second)).lobes(direction(35.0f, 10.0f));
        const auto expected =
            bins.integrals(24, [&](const glm::vec3& wi) { return n * double(bsdf.eval(wi).pdf); });
        int rejected = 0;
        for (const uint32_t seed : {1u, 2u, 3u}) {
            Random random(seed);
            std::vector<double> counts(expected.size(), 0.0);
            for (int i = 0; i < n; ++i) {
                const BsdfSample s = drawn(bsdf, random);
                if (s.event == 0 || (s.event & sh::LOBE_DELTA) != 0 || s.wi.z <= 0.0f) continue;
                ++counts[bins.of(s.wi)];
            }
            // 3.4e-4 is 0.01 / 15 with margin for the quadrature.
            rejected += test::pearson(expected, counts, 5.0).tail() < 3.4e-4;
        }
        EXPECT_LT(rejected, 2) << variants[which].first;
    }
}

// A smooth reflection lobe over a transmission lobe of the same interface is the RT lobe, from both
// sides.
TEST(Bsdf, ReflectionOverTransmissionIsTheSharedInterface) {
    const auto with = [&](const char* mode) {
        return Inputs{{"roughness", pair(0.0f)}, {"scatter_mode", mode}};
    };
    const Compiled halves(layered({makeNode("top", "ND_dielectric_bsdf", with("R")),
                                   makeNode("base", "ND_dielectric_bsdf", with("T"))}));
    const Compiled whole(lobeNetwork("ND_dielectric_bsdf", with("RT")));
    for (const float theta : {0.0f, 20.0f, 38.0f, 45.0f, 80.0f, 120.0f, 140.0f, 179.0f}) {
        SCOPED_TRACE(theta);
        const int n = 4000;
        double reflected[2];
        for (const Compiled* c : {&halves, &whole}) {
            const Bsdf bsdf = c->lobes(direction(theta));
            EXPECT_NEAR(bsdf.albedo().x, 1.0f, 1e-4f);
            // The share of reflection is the same, event by event.
            Random random(5);
            double& sum = reflected[c == &whole] = 0.0;
            for (int i = 0; i < n; ++i) {
                const BsdfSample s = drawn(bsdf, random);
                sum += (s.event & sh::LOBE_REFLECT) ? s.weight.x / n : 0.0;
            }
        }
        // Both are means of a coin: 4 standard errors of 0.5 / sqrt(n).
        EXPECT_NEAR(reflected[0], reflected[1], 4.0 * 0.75 / std::sqrt(double(n)));
    }
}

TEST(Bsdf, LayerOfNothingIsTheBase) {
    const Inputs base = {{"roughness", pair(0.3f)}};
    const auto value = [](const Network& network) {
        return Compiled(network).lobes(direction(40.0f)).eval(direction(35.0f, 170.0f)).specular.x;
    };
    // ior 1 reflects nothing, and is not cut because it is no zero weight.
    EXPECT_NEAR(value(layered({makeNode("top", "ND_dielectric_bsdf",
                                        {{"ior", 1.0f}, {"roughness", pair(0.2f)}}),
                               makeNode("base", "ND_conductor_bsdf", base)})),
                value(lobeNetwork("ND_conductor_bsdf", base)), 1e-5f);
}

TEST(Bsdf, MixAndMultiplyAreLinear) {
    const auto eval = [&](float mix, float factor) {
        const Compiled c(bsdfNetwork(
            {diffuseNode("a", color(1, 0, 0)),
             makeNode("b", "ND_conductor_bsdf", {{"roughness", pair(0.4f)}}),
             makeNode("amount", "ND_geompropvalue_float", {{"geomprop", "none"}, {"default", mix}}),
             makeNode("mix", "ND_mix_bsdf", {}, {{"fg", "a"}, {"bg", "b"}, {"mix", "amount"}}),
             makeNode("bsdf", "ND_multiply_bsdfC", {{"in2", grey(factor)}}, {{"in1", "mix"}})}));
        const BsdfEval e = c.lobes(direction(30.0f)).eval(direction(25.0f, 150.0f));
        return e.diffuse + e.specular;
    };
    const glm::vec3 a = eval(1.0f, 1.0f), b = eval(0.0f, 1.0f);
    expectVector(eval(0.25f, 0.5f), 0.5f * (0.25f * a + 0.75f * b));
}

TEST(Bsdf, NothingLeaksThroughABentNormal) {
    const Compiled c(previewNetwork({{"diffuseColor", grey(1.0f)}, {"roughness", 0.4f}}));
    Random random(3);
    for (int i = 0; i < 2000; ++i) {
        ShadingPoint point;
        point.normal = glm::normalize(random.direction() + glm::vec3(0, 0, 1.02f));
        point.tangent = glm::normalize(glm::cross(point.normal, glm::vec3(0.3f, 0.8f, 0.1f)));
        point.viewDirection = random.direction();
        const Bsdf bsdf = c.lobes(point);
        const bool front = point.viewDirection.z >= 0.0f;
        const glm::vec3 wi = random.direction();
        if ((wi.z > 0.0f) != front) {
            const BsdfEval e = bsdf.eval(wi);
            EXPECT_EQ(e.pdf, 0.0f);
            EXPECT_EQ(e.diffuse.x + e.specular.x, 0.0f);
        }
        const BsdfSample s = drawn(bsdf, random);
        if (s.event != 0) {
            EXPECT_EQ(s.wi.z > 0.0f, front);
            EXPECT_TRUE(std::isfinite(s.weight.x) && s.weight.x >= 0.0f);
        }
    }
}

TEST(Bsdf, BothSidesOfAnOpaqueSurfaceLookTheSame) {
    const Compiled c(previewNetwork({{"diffuseColor", grey(0.6f)}, {"clearcoat", 1.0f}}));
    const float back = c.albedo(-direction(40.0f)).x;
    EXPECT_NEAR(c.albedo(direction(40.0f)).x, back, 1e-6f);
    EXPECT_GT(back, 0.2f);
}

TEST(Bsdf, ExtremesStayFinite) {
    const float values[] = {0.0f, 1e-6f, 0.5f, 1.0f, 1000.0f, -1.0f};
    Random random(17);
    const auto any = [&] { return values[int(random.next() * 6.0f)]; };
    for (int i = 0; i < 300; ++i) {
        Inputs inputs;
        for (const char* name :
             {"metallic", "roughness", "clearcoat", "clearcoatRoughness", "opacity", "ior"})
            inputs[name] = any();
        inputs["diffuseColor"] = grey(any());
        const Compiled c(previewNetwork(inputs));
        for (const float theta : {0.0f, 89.99f, 90.0f, 90.01f, 180.0f}) {
            const Bsdf bsdf = c.lobes(direction(theta));
            const BsdfEval e = bsdf.eval(random.direction());
            const BsdfSample s = drawn(bsdf, random);
            for (const glm::vec3& v : {e.diffuse, e.specular, s.weight, bsdf.albedo()})
                for (int k = 0; k < 3; ++k)
                    EXPECT_TRUE(std::isfinite(v[k]) && v[k] >= 0.0f);
            EXPECT_TRUE(std::isfinite(e.pdf) && e.pdf >= 0.0f);
        }
    }
}
