// SPDX-License-Identifier: Apache-2.0
// Lobes at a point that asks for a least roughness, beside a material that has it.
#include "materialNetwork/tests/layerFixture.h"

#include <algorithm>

using namespace patina;

namespace {

constexpr float least = 0.3f;
constexpr float curveError = 1.5e-3f; // of the energy of constant lobes, see testEnergyCurve.cpp

NetworkNode lobeNode(const std::string& id, float x, float y, Inputs inputs = {}) {
    inputs["roughness"] = vector(x, y);
    return makeNode("bsdf", id, inputs);
}

ShadingPoint asking(const glm::vec3& wo) {
    ShadingPoint point = seenFrom(wo);
    point.leastRoughness = least;
    return point;
}

void expectSame(const Bsdf& a, const Bsdf& b, const std::string& what) {
    EXPECT_EQ(a.hasNonDelta(), b.hasNonDelta()) << what;
    EXPECT_EQ(a.transmits(), b.transmits()) << what;
    for (const float theta : {0.0f, 30.0f, 70.0f, 110.0f, 150.0f})
        for (const float phi : {0.0f, 60.0f, 180.0f}) {
            const BsdfEval x = a.eval(direction(theta, phi)), y = b.eval(direction(theta, phi));
            const glm::vec3 value = y.diffuse + y.specular;
            expectVector(x.diffuse + x.specular, value, 2.0f * curveError * (1e-3f + value.x));
            EXPECT_NEAR(x.pdf, y.pdf, 2.0f * curveError * (1e-3f + y.pdf)) << what;
        }
    const BsdfSample x = a.sample({0.3f, 0.6f, 0.2f}, 0.7f), y = b.sample({0.3f, 0.6f, 0.2f}, 0.7f);
    EXPECT_EQ(x.event, y.event) << what;
    EXPECT_FLOAT_EQ(x.roughness, y.roughness) << what;
    expectVector(x.wi, y.wi, 1e-5f);
}

} // namespace

TEST(LeastRoughness, IsThatOfARougherMaterial) {
    struct Case {
        const char* id;
        Inputs inputs;
    };
    const Case cases[] = {
        {"ND_conductor_bsdf", {}},
        {"ND_dielectric_bsdf", {}},
        {"ND_dielectric_bsdf", {{"scatter_mode", "RT"}}},
        {"ND_dielectric_bsdf", {{"thinfilm_thickness", 400.0f}}},
        {"ND_generalized_schlick_bsdf", {{"color0", grey(0.5f)}, {"scatter_mode", "RT"}}},
        {"ND_generalized_schlick_bsdf", {{"color0", grey(0.2f)}, {"thinfilm_thickness", 500.0f}}}};
    const glm::vec2 roughnesses[] = {{0.0f, 0.0f}, {0.1f, 0.1f}, {0.05f, 0.6f}, {0.5f, 0.4f}};
    for (const Case& c : cases)
        for (const glm::vec2& r : roughnesses)
            for (const float degrees : {20.0f, 75.0f, 130.0f}) {
                const glm::vec3 wo = direction(degrees);
                const Compiled smooth(bsdfNetwork({lobeNode(c.id, r.x, r.y, c.inputs)}));
                const Compiled rough(bsdfNetwork(
                    {lobeNode(c.id, std::max(r.x, least), std::max(r.y, least), c.inputs)}));
                expectSame(smooth.lobes(asking(wo)), rough.lobes(wo),
                           std::string(c.id) + " " + std::to_string(r.x) + " from " +
                               std::to_string(degrees));
            }
}

TEST(LeastRoughness, HoldsInLayersAndWhereTheyAreWalked) {
    for (const MethodChoices& methods :
         {MethodChoices(), MethodChoices{{"layering", "positionFree"}}}) {
        const auto of = [&](float alpha) {
            return Compiled(layered({interfaceNode("top", 1.5f, alpha, {{"scatter_mode", "R"}}),
                                     diffuseNode("base", grey(0.7f))}),
                            methods);
        };
        const Compiled smooth = of(0.02f), rough = of(least);
        expectVector(smooth.lobes(asking(direction(40.0f))).albedo(),
                     rough.albedo(direction(40.0f)), curveError);
    }
}

// A pane's reflection decides what passes straight on, for shadow rays too: all of it stays.
TEST(LeastRoughness, LeavesPanesAsTheyAre) {
    const Compiled pane(modelNetwork("ND_standard_surface_surfaceshader",
                                     {{"transmission", 1.0f}, {"thin_walled", true}}));
    const glm::vec3 wo = direction(30.0f);
    EXPECT_LT(pane->opacity(asking(wo)), 0.2f);
    EXPECT_EQ(pane->opacity(asking(wo)), pane->opacity(seenFrom(wo)));
    expectVector(pane.lobes(asking(wo)).eval(wo).specular, pane.lobes(wo).eval(wo).specular, 0.0f);
}
