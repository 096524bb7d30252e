// SPDX-License-Identifier: Apache-2.0
// The method positionFree of layering: energy, closed forms, values and samples that agree.
#include "materialNetwork/cpu/programCode.h"
#include "materialNetwork/tests/statistics.h"
#include "shaders/oracle.h"

namespace patina {

namespace {

const MethodChoices walks = {{"layering", "positionFree"}};
const MethodChoices bothWalk = {{"layering", "positionFree"}, {"energyCompensation", "randomWalk"}};

std::shared_ptr<const MaterialProgram> walked(const Network& network,
                                              const MethodChoices& methods = walks) {
    return compiled(network, methods);
}

NetworkNode coat(const char* name, float ior, float alpha, const char* mode = "R") {
    return makeNode(
        name, "ND_dielectric_bsdf",
        {{"ior", number(ior)}, {"roughness", pair(alpha)}, {"scatter_mode", text(mode)}});
}

NetworkNode diffuse(const char* name, float albedo) {
    return makeNode(name, "ND_oren_nayar_diffuse_bsdf", {{"color", grey(albedo)}});
}

NetworkNode gold(const char* name, float alpha) {
    return makeNode(name, "ND_conductor_bsdf", {{"roughness", pair(alpha)}});
}

NetworkNode layer(const char* name, const char* top, const char* base) {
    return makeNode(name, "ND_layer_bsdf", {}, {{"top", {top, ""}}, {"base", {base, ""}}});
}

Network stacked(NetworkNode top, NetworkNode base) {
    top.path = "/m/top";
    base.path = "/m/base";
    return bsdfNetwork({std::move(top), std::move(base), layer("bsdf", "top", "base")});
}

void expectSamplesAndValuesAgree(const Network& network, const glm::vec3& wo, const char* what,
                                 const MethodChoices& methods = walks, int samples = 20000) {
    const auto program = walked(network, methods);
    ASSERT_GT(program->code().walkedLayers, 0) << what;
    patina::expectSamplesAndValuesAgree(*program, wo, what, samples, 21);
}

} // namespace

// F + (1 - F) a (1 - I) / (1 - a I), with I the reflectance for diffuse light from inside.
TEST(LayerWalk, SmoothOverDiffuseIsAGeometricSeries) {
    const double outside = sh64::fresnelDielectricAverage(1.5);
    const double inside = 1.0 - (1.0 - outside) / 2.25;
    for (const float albedo : {0.2f, 0.5f, 0.9f})
        for (const float degrees : {0.0f, 45.0f, 75.0f}) {
            const auto program = walked(stacked(coat("top", 1.5f, 0.0f), diffuse("base", albedo)));
            const Mean found = sampledAlbedo(*program, direction(degrees), 20000);
            const double f = sh64::fresnelDielectric(std::cos(double(glm::radians(degrees))), 1.5);
            const double a = double(albedo);
            const double truth = f + (1.0 - f) * a * (1.0 - inside) / (1.0 - a * inside);
            EXPECT_NEAR(found.mean(), truth, 4.0 * std::sqrt(found.variance()) + 1e-3)
                << albedo << " " << degrees;
        }
}

// Nothing is lost and nothing won where neither top nor base absorbs. 4 standard errors.
TEST(LayerWalk, WhiteLosesNothing) {
    for (const float alpha : {0.0f, 0.3f, 0.8f})
        for (const float degrees : {0.0f, 60.0f, 85.0f}) {
            const auto program =
                walked(stacked(coat("top", 1.5f, alpha), diffuse("base", 1.0f)), bothWalk);
            const Mean found = sampledAlbedo(*program, direction(degrees), 4000);
            EXPECT_NEAR(found.mean(), 1.0, 4.0 * std::sqrt(found.variance()) + 1e-3)
                << alpha << " " << degrees;
        }
}

TEST(LayerWalk, SamplesAndValuesAgree) {
    const glm::vec3 wo = direction(50.0f, 20.0f), below = direction(125.0f, 20.0f);
    expectSamplesAndValuesAgree(stacked(coat("top", 1.5f, 0.0f), diffuse("base", 0.8f)), wo,
                                "smooth over diffuse");
    expectSamplesAndValuesAgree(stacked(coat("top", 1.5f, 0.4f), diffuse("base", 0.8f)), wo,
                                "rough over diffuse");
    expectSamplesAndValuesAgree(stacked(coat("top", 1.5f, 0.0f), gold("base", 0.4f)), wo,
                                "smooth over metal");
    expectSamplesAndValuesAgree(stacked(coat("top", 1.5f, 0.4f), gold("base", 0.3f)), wo,
                                "rough over metal");
    expectSamplesAndValuesAgree(stacked(coat("top", 1.5f, 0.4f), gold("base", 0.0f)), wo,
                                "rough over a mirror", walks, 80000);
    expectSamplesAndValuesAgree(stacked(coat("top", 1.3f, 0.3f), coat("base", 1.5f, 0.5f, "RT")),
                                wo, "coat on glass");
    expectSamplesAndValuesAgree(stacked(coat("top", 1.3f, 0.3f), coat("base", 1.5f, 0.5f, "RT")),
                                below, "coat on glass from below");
    expectSamplesAndValuesAgree(stacked(coat("top", 1.5f, 0.5f), gold("base", 0.6f)), wo,
                                "facets that are walked too", bothWalk);
    const NetworkNode red =
        makeNode("top", "ND_generalized_schlick_bsdf",
                 {{"color0", color(0.5f, 0.1f, 0.05f)}, {"roughness", pair(0.3f)}});
    expectSamplesAndValuesAgree(stacked(red, diffuse("base", 0.8f)), wo, "coloured top");
    expectSamplesAndValuesAgree(
        bsdfNetwork({coat("outer", 1.4f, 0.2f), coat("inner", 1.5f, 0.5f), diffuse("ground", 0.7f),
                     layer("under", "inner", "ground"), layer("bsdf", "outer", "under")}),
        wo, "two coats");
}

// A weight below 1 leaves a part of the base bare; beside the layer stand lobes with formulas.
TEST(LayerWalk, MixturesStayUnbiased) {
    NetworkNode half = coat("top", 1.5f, 0.3f);
    half.inputs["weight"] = number(0.5f);
    expectSamplesAndValuesAgree(
        bsdfNetwork({half, diffuse("base", 0.6f), gold("metal", 0.4f), layer("one", "top", "base"),
                     makeNode("bsdf", "ND_mix_bsdf", {{"mix", number(0.4f)}},
                              {{"fg", {"metal", ""}}, {"bg", {"one", ""}}})}),
        direction(50.0f), "half a coat beside metal");
}

TEST(LayerWalk, OtherLayersKeepAlbedoScaling) {
    const auto count = [](const Network& network) { return walked(network)->code().walkedLayers; };
    const NetworkNode sheen = makeNode("top", "ND_sheen_bsdf");
    EXPECT_EQ(count(stacked(sheen, diffuse("base", 0.5f))), 0);
    EXPECT_EQ(count(stacked(coat("top", 1.5f, 0.1f), coat("base", 1.5f, 0.1f, "T"))), 0);
    const NetworkNode skin = makeNode("base", "ND_subsurface_bsdf");
    EXPECT_EQ(count(stacked(coat("top", 1.5f, 0.1f), skin)), 0);
    EXPECT_EQ(count(stacked(coat("top", 1.5f, 0.1f), diffuse("base", 0.5f))), 1);
}

// Work grows with every layer inside a layer, so there is a bound.
TEST(LayerWalk, DeepNestsEnd) {
    std::vector<NetworkNode> nodes = {diffuse("n0", 0.8f)};
    for (int i = 1; i <= 12; ++i) {
        const std::string top = "c" + std::to_string(i), under = "n" + std::to_string(i - 1);
        const std::string name = i == 12 ? "bsdf" : "n" + std::to_string(i);
        nodes.push_back(coat(top.c_str(), 1.4f, 0.1f));
        nodes.push_back(layer(name.c_str(), top.c_str(), under.c_str()));
    }
    const auto program = walked(bsdfNetwork(nodes));
    EXPECT_EQ(program->code().walkedLayers, 4);
    const Mean found = sampledAlbedo(*program, direction(30.0f), 200);
    EXPECT_GT(found.mean(), 0.1);
    EXPECT_LT(found.mean(), 1.0);
}

TEST(LayerWalk, ValuesAreFiniteAndDensitiesPositive) {
    Random random(5);
    for (const Network& network :
         {stacked(coat("top", 1.5f, 0.0f), gold("base", 0.05f)),
          stacked(coat("top", 0.7f, 0.2f), diffuse("base", 0.5f)),
          stacked(coat("top", 0.0f, 0.2f), diffuse("base", 0.5f)),
          stacked(coat("top", 1.0f, 0.2f), coat("base", 2.4f, 0.5f, "RT"))}) {
        const auto program = walked(network, bothWalk);
        for (int i = 0; i < 500; ++i) {
            ShadingPoint point;
            point.viewDirection = random.direction();
            Bsdf bsdf;
            program->evaluate(point, bsdf);
            bsdf.seed(uint32_t(i));
            expectSoundValue(bsdf, random);
            if (testing::Test::HasFatalFailure()) return;
            const glm::vec3 u = random.next3();
            const BsdfSample s = bsdf.sample(u, random.next());
            ASSERT_TRUE(std::isfinite(s.weight.x) && std::isfinite(s.pdf));
        }
    }
}

} // namespace patina
