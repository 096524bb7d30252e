// SPDX-License-Identifier: Apache-2.0
// The method positionFree of layering: energy, closed forms, values and samples that agree.
#include "materialNetwork/cpu/programCode.h"
#include "materialNetwork/tests/layerFixture.h"

using namespace patina;

namespace {

const MethodChoices walks = {{"layering", "positionFree"}};
const MethodChoices bothWalk = {{"layering", "positionFree"}, {"energyCompensation", "randomWalk"}};

std::shared_ptr<const MaterialProgram> walked(const Network& network,
                                              const MethodChoices& methods = walks) {
    return compiled(network, methods);
}

NetworkNode coat(const std::string& name, float ior, float alpha, const char* mode = "R") {
    return interfaceNode(name, ior, alpha, {{"scatter_mode", mode}});
}

NetworkNode diffuse(const char* name, float albedo) {
    return diffuseNode(name, grey(albedo));
}

NetworkNode gold(const char* name, float alpha) {
    return makeNode(name, "ND_conductor_bsdf", {{"roughness", pair(alpha)}});
}

void expectSamplesAndValuesAgree(const Network& network, const glm::vec3& wo, const char* what,
                                 const MethodChoices& methods = walks, int samples = 20000) {
    const auto program = walked(network, methods);
    ASSERT_GT(program->code().walkedLayers, 0) << what;
    patina::expectSamplesAndValuesAgree(*program, wo, what, samples, 21);
}

} // namespace

TEST(LayerWalk, SmoothOverDiffuseIsAGeometricSeries) {
    for (const float albedo : {0.2f, 0.5f, 0.9f})
        for (const float degrees : {0.0f, 45.0f, 75.0f}) {
            const auto program =
                walked(layered({coat("top", 1.5f, 0.0f), diffuse("base", albedo)}));
            const Mean found = sampledAlbedo(*program, direction(degrees), 20000);
            EXPECT_NEAR(found.mean(), interfaceOverDiffuse(1.5, albedo, degrees),
                        4.0 * std::sqrt(found.variance()) + 1e-3)
                << albedo << " " << degrees;
        }
}

// Inside of its own ior an interface is none.
TEST(LayerWalk, TheTopBordersOnWhatSurroundsIt) {
    const auto program = walked(layered({coat("top", 1.5f, 0.0f), diffuse("base", 0.5f)}));
    ShadingPoint point = seenFrom(direction(30.0f));
    point.surroundingIor = 1.5f;
    Random random(3);
    Mean found;
    for (uint32_t i = 1; i <= 20000; ++i) {
        Bsdf bsdf = lobesAt(*program, point);
        bsdf.seed(i);
        const BsdfSample s = drawn(bsdf, random);
        found.add(s.event ? double(s.weight.x) : 0.0);
    }
    EXPECT_NEAR(found.mean(), 0.5, 4.0 * std::sqrt(found.variance()) + 1e-3);
}

// Nothing is lost and nothing won where neither top nor base absorbs. 4 standard errors.
TEST(LayerWalk, WhiteLosesNothing) {
    for (const float alpha : {0.0f, 0.3f, 0.8f})
        for (const float degrees : {0.0f, 60.0f, 85.0f}) {
            const auto program =
                walked(layered({coat("top", 1.5f, alpha), diffuse("base", 1.0f)}), bothWalk);
            const Mean found = sampledAlbedo(*program, direction(degrees), 4000);
            EXPECT_NEAR(found.mean(), 1.0, 4.0 * std::sqrt(found.variance()) + 1e-3)
                << alpha << " " << degrees;
        }
}

TEST(LayerWalk, SamplesAndValuesAgree) {
    const glm::vec3 wo = direction(50.0f, 20.0f), below = direction(125.0f, 20.0f);
    const NetworkNode smooth = coat("top", 1.5f, 0.0f), rough = coat("top", 1.5f, 0.4f),
                      white = diffuse("base", 0.8f);
    expectSamplesAndValuesAgree(layered({smooth, white}), wo, "smooth over diffuse");
    expectSamplesAndValuesAgree(layered({rough, white}), wo, "rough over diffuse");
    expectSamplesAndValuesAgree(layered({smooth, gold("base", 0.4f)}), wo, "smooth over metal");
    expectSamplesAndValuesAgree(layered({rough, gold("base", 0.3f)}), wo, "rough over metal");
    expectSamplesAndValuesAgree(layered({rough, gold("base", 0.0f)}), wo, "rough over a mirror",
                                walks, 80000);
    const Network glass = layered({coat("top", 1.3f, 0.3f), coat("base", 1.5f, 0.5f, "RT")});
    expectSamplesAndValuesAgree(glass, wo, "coat on glass");
    expectSamplesAndValuesAgree(glass, below, "coat on glass from below");
    expectSamplesAndValuesAgree(layered({coat("top", 1.5f, 0.5f), gold("base", 0.6f)}), wo,
                                "facets that are walked too", bothWalk);
    const NetworkNode red =
        makeNode("top", "ND_generalized_schlick_bsdf",
                 {{"color0", color(0.5f, 0.1f, 0.05f)}, {"roughness", pair(0.3f)}});
    expectSamplesAndValuesAgree(layered({red, white}), wo, "coloured top");
    expectSamplesAndValuesAgree(
        layered({coat("top", 1.4f, 0.2f), coat("inner", 1.5f, 0.5f), diffuse("ground", 0.7f),
                 layerNode("base", "inner", "ground")}),
        wo, "two coats");
}

// A weight below 1 leaves a part of the base bare; beside the layer stand lobes with formulas.
TEST(LayerWalk, MixturesStayUnbiased) {
    expectSamplesAndValuesAgree(
        bsdfNetwork({interfaceNode("top", 1.5f, 0.3f, {{"weight", 0.5f}}), diffuse("base", 0.6f),
                     gold("metal", 0.4f), layerNode("one", "top", "base"),
                     mixNode("bsdf", "metal", "one", 0.4f)}),
        direction(50.0f), "half a coat beside metal");
}

TEST(LayerWalk, OtherLayersKeepAlbedoScaling) {
    const auto count = [](const NetworkNode& top, const NetworkNode& base) {
        return walked(layered({top, base}))->code().walkedLayers;
    };
    const NetworkNode smooth = coat("top", 1.5f, 0.1f);
    EXPECT_EQ(count(makeNode("top", "ND_sheen_bsdf"), diffuse("base", 0.5f)), 0);
    EXPECT_EQ(count(smooth, coat("base", 1.5f, 0.1f, "T")), 0);
    EXPECT_EQ(count(smooth, makeNode("base", "ND_subsurface_bsdf")), 0);
    EXPECT_EQ(count(smooth, diffuse("base", 0.5f)), 1);
}

// Work grows with every layer inside a layer, so there is a bound.
TEST(LayerWalk, DeepNestsEnd) {
    std::vector<NetworkNode> nodes = {diffuse("n0", 0.8f)};
    for (int i = 1; i <= 12; ++i) {
        nodes.push_back(coat(numbered("c", i), 1.4f, 0.1f));
        nodes.push_back(
            layerNode(i == 12 ? "bsdf" : numbered("n", i), numbered("c", i), numbered("n", i - 1)));
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
         {layered({coat("top", 1.5f, 0.0f), gold("base", 0.05f)}),
          layered({coat("top", 0.7f, 0.2f), diffuse("base", 0.5f)}),
          layered({coat("top", 0.0f, 0.2f), diffuse("base", 0.5f)}),
          layered({coat("top", 1.0f, 0.2f), coat("base", 2.4f, 0.5f, "RT")})})
        expectSound(*walked(network, bothWalk), random, 500);
}
