// SPDX-License-Identifier: Apache-2.0
// The method randomWalk of energyCompensation: energy, values and samples that agree.
#include "materialNetwork/tests/statistics.h"
#include "shaders/measure/microsurfaceWalk.h"

using namespace patina;

namespace {

const MethodChoices walks = {{"energyCompensation", "randomWalk"}};

std::shared_ptr<const MaterialProgram> walked(const Network& network) {
    return compiled(network, walks);
}

Network metal(float n, float k, float x, float y, const char* distribution = "ggx") {
    return lobeNetwork("ND_conductor_bsdf", {{"ior", grey(n)},
                                             {"extinction", grey(k)},
                                             {"roughness", vector(x, y)},
                                             {"distribution", distribution}});
}

Network glass(const char* mode, float ior, float alpha, const char* distribution = "ggx") {
    return lobeNetwork("ND_dielectric_bsdf", {{"ior", ior},
                                              {"roughness", pair(alpha)},
                                              {"scatter_mode", mode},
                                              {"distribution", distribution}});
}

Network schlick(const char* mode, float alpha) {
    return lobeNetwork(
        "ND_generalized_schlick_bsdf",
        {{"color0", color(0.3f, 0.1f, 0.05f)}, {"roughness", pair(alpha)}, {"scatter_mode", mode}});
}

void expectSamplesAndValuesAgree(const Network& network, const glm::vec3& wo, const char* what) {
    patina::expectSamplesAndValuesAgree(*walked(network), wo, what, 60000, 11);
}

} // namespace

// Every bounce keeps all light, and every walk ends: no noise at all.
TEST(Microsurface, WhiteLosesNothing) {
    for (const char* distribution : {"ggx", "beckmann"})
        for (const float alpha : {0.05f, 0.5f, 1.0f})
            for (const float degrees : {0.0f, 60.0f, 89.0f}) {
                SCOPED_TRACE(distribution + std::to_string(alpha) + " " + std::to_string(degrees));
                const auto expectWhite = [](const Network& network, float theta) {
                    EXPECT_NEAR(sampledAlbedo(*walked(network), direction(theta), 500).mean(), 1.0,
                                1e-4);
                };
                expectWhite(metal(0.0f, 1.0f, alpha, alpha, distribution), degrees);
                expectWhite(glass("RT", 1.5f, alpha, distribution), degrees);
                expectWhite(glass("RT", 1.5f, alpha, distribution), 180.0f - degrees);
            }
}

// Against the walk of shaders/measure, which was written apart. 4 standard errors.
TEST(Microsurface, MetalsReflectWhatTheReferenceWalkSays) {
    for (const float alpha : {0.3f, 0.6f, 1.0f})
        for (const float degrees : {10.0f, 50.0f, 80.0f}) {
            const auto copper = walked(metal(1.1f, 2.3f, alpha, alpha));
            const glm::vec3 wo = direction(degrees);
            const Mean ours = sampledAlbedo(*copper, wo, 20000);
            const measure::Walked truth = measure::walkMicrosurface(
                sh64::vec3(wo), sh64::vec2(alpha), sh::NDF_GGX,
                [](double c) { return sh64::fresnelConductorChannel(c, 1.1, 2.3); }, 20000, 3);
            const double sigma = std::sqrt(ours.variance() + truth.sigma * truth.sigma);
            EXPECT_NEAR(ours.mean(), truth.all, 4.0 * sigma) << alpha << " " << degrees;
        }
}

TEST(Microsurface, SamplesAndValuesAgree) {
    const glm::vec3 wo = direction(55.0f, 30.0f), below = direction(130.0f, 30.0f);
    expectSamplesAndValuesAgree(metal(0.2f, 3.4f, 0.9f, 0.3f), wo, "anisotropic metal");
    expectSamplesAndValuesAgree(metal(0.2f, 3.4f, 0.8f, 0.8f, "beckmann"), wo, "Beckmann metal");
    expectSamplesAndValuesAgree(glass("RT", 1.5f, 0.7f), wo, "glass");
    expectSamplesAndValuesAgree(glass("RT", 1.5f, 0.7f), below, "glass from below");
    expectSamplesAndValuesAgree(glass("RT", 1.3f, 0.8f, "beckmann"), below, "Beckmann glass");
    expectSamplesAndValuesAgree(glass("R", 1.5f, 0.9f), wo, "reflection of glass");
    expectSamplesAndValuesAgree(glass("T", 1.5f, 0.6f), wo, "transmission of glass");
    expectSamplesAndValuesAgree(schlick("R", 0.7f), wo, "Schlick");
    expectSamplesAndValuesAgree(schlick("RT", 0.7f), below, "Schlick from below");
}

// Lobes with and without formulas side by side: samples of one kind leave the other kind out.
TEST(Microsurface, MixturesStayUnbiased) {
    expectSamplesAndValuesAgree(
        bsdfNetwork({makeNode("rough", "ND_conductor_bsdf", {{"roughness", pair(0.9f)}}),
                     diffuseNode("diffuse", grey(0.5f)),
                     makeNode("sheen", "ND_sheen_bsdf", {{"roughness", 0.4f}}),
                     mixNode("two", "rough", "diffuse", 0.4f),
                     mixNode("bsdf", "sheen", "two", 0.3f)}),
        direction(40.0f), "metal, diffuse and sheen");
}

// The density may be any that is positive where light goes.
TEST(Microsurface, DensityIsPositiveWhereValuesAre) {
    Random random(5);
    for (const Network& network :
         {metal(0.2f, 3.4f, 0.05f, 0.05f), metal(0.2f, 3.4f, 1.0f, 0.1f), glass("RT", 1.5f, 0.4f),
          glass("T", 2.4f, 0.9f), schlick("RT", 0.3f)})
        expectSound(*walked(network), random, 2000);
}

// The same seed gives the same bits; another one another value of the same mean.
TEST(Microsurface, ValuesFollowFromSeeds) {
    const auto program = walked(metal(0.2f, 3.4f, 0.8f, 0.8f));
    Bsdf bsdf = lobesAt(*program);
    ASSERT_TRUE(bsdf.stochastic());
    const glm::vec3 wi = direction(30.0f);
    bsdf.seed(1);
    const float first = bsdf.eval(wi).specular.x;
    EXPECT_EQ(bsdf.eval(wi).specular.x, first);
    int others = 0;
    for (uint32_t seed = 2; seed < 100; ++seed) {
        bsdf.seed(seed);
        others += bsdf.eval(wi).specular.x != first;
    }
    EXPECT_GT(others, 10);
}

// Mirrors have no facets to walk between.
TEST(Microsurface, SmoothLobesKeepTheirFormulas) {
    EXPECT_FALSE(lobesAt(*walked(metal(0.2f, 3.4f, 0.0f, 0.0f))).stochastic());
}
