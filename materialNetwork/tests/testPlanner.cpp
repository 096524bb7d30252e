// SPDX-License-Identifier: Apache-2.0
// The planner: methods follow from the tolerance and the measured table, and from nothing else.
#include "materialNetwork/plan/methodTable.h"
#include "materialNetwork/planner/planner.h"
#include "materialNetwork/tests/materialFixture.h"

using namespace patina;

namespace {

constexpr double tolerances[] = {1e-5, 1e-4, 1e-3, 3e-3, 0.01, 0.03, 0.05, 0.1, 0.3};

MethodPlan planOf(const Network& network, double tolerance, const MethodChoices& forced = {}) {
    FakeTextures textures;
    Diagnostics diagnostics;
    return planMaterialMethods(network, textures, diagnostics, forced, tolerance);
}

const PlannedMethod& at(const MethodPlan& plan, const std::string& point) {
    for (const PlannedMethod& m : plan.choices)
        if (m.point == point) return m;
    static const PlannedMethod none;
    ADD_FAILURE() << "nothing is planned at " << point;
    return none;
}

/// Over all choices.
double sumOf(const MethodPlan& plan, double PlannedMethod::*member) {
    double sum = 0.0;
    for (const PlannedMethod& m : plan.choices)
        sum += m.*member;
    return sum;
}

double timeOf(const MethodPlan& plan) {
    return sumOf(plan, &PlannedMethod::ns);
}

const Inputs ofGold = {{"ior", color(0.183f, 0.421f, 1.373f)},
                       {"extinction", color(3.424f, 2.346f, 1.77f)}};

NetworkNode gold(const char* name, float roughness) {
    Inputs inputs = ofGold;
    inputs["roughness"] = pair(roughness);
    return makeNode(name, "ND_conductor_bsdf", inputs);
}

Network metal(float roughness) {
    return bsdfNetwork({gold("bsdf", roughness)});
}

Network coated(float roughness, float ior, const NetworkNode& base) {
    return layered(
        {makeNode("top", "ND_dielectric_bsdf", {{"roughness", pair(roughness)}, {"ior", ior}}),
         base});
}

Network coat(float roughness, float ior) {
    return coated(roughness, ior, diffuseNode("base", grey(0.5f)));
}

Network texturedMetal() {
    return bsdfNetwork({makeNode("image", "ND_image_vector2", {{"file", "map.exr"}}),
                        makeNode("bsdf", "ND_conductor_bsdf", ofGold, {{"roughness", "image"}})});
}

} // namespace

TEST(Planner, TablesServeInterfacesThatWalksAskAnew) {
    // Schlick's curve from black: light passes it unbent, so walks do not enter its facets.
    const Network network = layered({makeNode("top", "ND_generalized_schlick_bsdf",
                                              {{"color0", grey(0.0f)}, {"roughness", pair(1.0f)}}),
                                     diffuseNode("base", grey(0.5f))});
    const MethodChoices walks = {{"layering", "positionFree"}};
    const MethodPlan plan = planOf(network, 0.01, walks);
    EXPECT_NE(at(plan, "directionalAlbedo").method, "quadrature");
    EXPECT_LT(timeOf(plan), 0.5 * timeOf(planOf(network, 0.0, walks)))
        << "2304 facets at each step";
}

TEST(Planner, LargerTolerancesAreNeverSlower) {
    for (const Network& network : {metal(0.3f), metal(0.9f), coat(0.4f, 1.5f), texturedMetal()}) {
        double before = timeOf(planOf(network, 1e-6));
        for (double tolerance : tolerances) {
            const double now = timeOf(planOf(network, tolerance));
            EXPECT_LE(now, before) << tolerance;
            before = now;
        }
        EXPECT_LT(before, timeOf(planOf(network, 0.0)));
    }
}

TEST(Planner, ZeroIsTheTruthEverywhere) {
    for (const Network& network : {metal(0.3f), coat(0.4f, 1.5f), texturedMetal()}) {
        const MethodPlan plan = planOf(network, 0.0);
        EXPECT_EQ(plan.error, 0.0);
        for (const PlannedMethod& m : plan.choices)
            if (!truthMethod(m.point).empty()) {
                EXPECT_EQ(m.method, truthMethod(m.point)) << m.point;
            }
    }
}

TEST(Planner, WithoutAToleranceTheDefaultsStay) {
    const MethodPlan plan = planOf(metal(0.5f), -1.0);
    for (const PlannedMethod& m : plan.choices)
        EXPECT_EQ(m.method, chosenMethod({}, m.point)) << m.point;
    EXPECT_GT(plan.error, 0.0);
    EXPECT_TRUE(Compiled(metal(0.5f))->planned().choices.empty());
}

TEST(Planner, PredictedErrorsStayWithinTheirShare) {
    for (const Network& network :
         {metal(0.2f), metal(0.9f), coat(0.1f, 1.3f), coat(0.7f, 2.5f), texturedMetal()})
        for (double tolerance : tolerances) {
            const MethodPlan plan = planOf(network, tolerance);
            EXPECT_LE(plan.error, methodShare * tolerance * (1.0 + 1e-9)) << tolerance;
            EXPECT_DOUBLE_EQ(plan.error, sumOf(plan, &PlannedMethod::error));
        }
}

TEST(Planner, ForcedMethodsStayAndAreCounted) {
    const MethodPlan plan = planOf(metal(0.9f), 0.001, {{"energyCompensation", "none"}});
    EXPECT_EQ(at(plan, "energyCompensation").method, "none");
    EXPECT_TRUE(at(plan, "energyCompensation").forced);
    EXPECT_GT(plan.error, 0.1); // a rough metal loses a lot
    const MethodPlan truth = planOf(metal(0.9f), 0.0, {{"directionalAlbedo", "karis"}});
    EXPECT_EQ(at(truth, "directionalAlbedo").method, "karis");
    EXPECT_EQ(at(truth, "energyCompensation").method, "randomWalk");
}

TEST(Planner, MeaningsAreNeverChanged) {
    for (double tolerance : {0.0, 0.001, 0.5}) {
        const MethodPlan plan = planOf(coat(0.4f, 1.5f), tolerance);
        for (const PlannedMethod& m : plan.choices)
            EXPECT_TRUE(!truthMethod(m.point).empty() || m.point == "sampling") << m.point;
        EXPECT_EQ(methodsOf(plan, {}).count("layering"), 0u);
        const MethodChoices chosen =
            methodsOf(plan, {{"layering", "returned"}, {"diffuse", "eon"}});
        EXPECT_EQ(chosen.at("layering"), "returned");
        EXPECT_EQ(chosen.at("diffuse"), "eon");
    }
}

// The texture holds roughness from 0 to 1 along u.
TEST(Planner, AVaryingParameterCountsAtItsWorst) {
    const MethodChoices none = {{"energyCompensation", "none"}};
    const MethodPlan varying = planOf(texturedMetal(), 0.01, none);
    EXPECT_TRUE(varying.varies);
    EXPECT_FALSE(planOf(metal(0.2f), 0.01, none).varies);
    EXPECT_GT(varying.error, 5.0 * planOf(metal(0.01f), 0.01, none).error);
    EXPECT_GT(varying.error, 0.7 * planOf(metal(0.95f), 0.01, none).error);
}

TEST(Planner, ABackEndWithoutWalksSaysWhatItTakes) {
    const MethodPlan walked = planOf(coated(0.1f, 1.5f, gold("base", 0.9f)), 1e-4),
                     scaled = withoutWalks(walked);
    EXPECT_EQ(at(walked, "energyCompensation").method, "randomWalk");
    EXPECT_EQ(at(scaled, "energyCompensation").method, "turquin");
    EXPECT_EQ(at(scaled, "energyCompensation").error,
              at(walked, "energyCompensation").errorDefault);
    EXPECT_NEAR(scaled.error, sumOf(scaled, &PlannedMethod::error), 1e-12);
    EXPECT_GT(scaled.error, 1e-3);
}

TEST(Planner, AMirrorNeedsNoCompensation) {
    const MethodPlan plan = planOf(metal(0.0f), 0.01, {{"energyCompensation", "none"}});
    EXPECT_EQ(at(plan, "energyCompensation").error, 0.0);
}

TEST(Planner, ErrorsFollowTheTable) {
    // An error of a layer's top shows in its base.
    const double karis =
        at(planOf(coat(0.3f, 1.5f), 0.01, {{"directionalAlbedo", "karis"}}), "directionalAlbedo")
            .error;
    EXPECT_GT(karis, 0.005);
    EXPECT_LT(karis, 0.2);
}

// All rows have what the planner reads.
TEST(MethodTable, RowsAreWhole) {
    for (const MeasuredMethod& row : methodTable()) {
        const std::string name = std::string(row.point) + " " + row.method + ", " + row.subject;
        EXPECT_GT(row.axisEnd, 0.0f) << name;
        EXPECT_GE(row.ns, 0.0f) << name;
        float largest = 0.0f;
        for (int i = 0; i < methodBins * methodCosines; ++i) {
            EXPECT_GE(row.errors[i], 0.0f) << name;
            EXPECT_GT(row.truths[i], 0.0f) << name;
            largest = std::max(largest, row.errors[i]);
        }
        EXPECT_LE(largest, row.largest * 1.005f + 1e-3f) << name;
    }
}
