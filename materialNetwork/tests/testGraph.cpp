// SPDX-License-Identifier: Apache-2.0
// Broken networks: never a crash or a hang, always a message, always the documented fallback.
#include "materialNetwork/tests/materialFixture.h"

#include "materialNetwork/nodes/nodeTable.h"
#include "materialNetwork/network/value.h"

#include <limits>
#include <set>

namespace patina {

namespace {

/// The number that arrives at the input of a surface's opacity.
float opacityOf(const Network& network, std::string* problems = nullptr) {
    Compiled c(network);
    if (problems) *problems = warnings(c.diagnostics);
    return c.program->opacity(ShadingPoint());
}

Network opacityNetwork(std::vector<NetworkNode> nodes) {
    nodes.push_back(
        makeNode("surface", "ND_surface", {{"opacity", number(0.75f)}}, {{"opacity", {"x", ""}}}));
    return makeNetwork(std::move(nodes));
}

} // namespace

TEST(Graph, CycleIsReportedAndTheOwnValueUsed) {
    std::string problems;
    const float x = opacityOf(
        opacityNetwork(
            {makeNode("x", "ND_add_float", {{"in2", number(0.125f)}}, {{"in1", {"y", ""}}}),
             makeNode("y", "ND_multiply_float", {{"in2", number(1.0f)}}, {{"in1", {"x", ""}}})}),
        &problems);
    EXPECT_FLOAT_EQ(x, 0.125f);
    EXPECT_NE(problems.find("/m/y [in1] connections form a cycle"), std::string::npos) << problems;
}

TEST(Graph, CycleThroughAModelEnds) {
    Compiled c(previewNetwork({}, {{"roughness", {"surface", "surface"}}}));
    EXPECT_NE(c.diagnostics.count(), 0);
    EXPECT_TRUE(c.program->isOpaque());
}

TEST(Graph, UnknownNodeTakesTheInputsOwnValue) {
    std::string problems;
    EXPECT_FLOAT_EQ(opacityOf(opacityNetwork({makeNode("x", "ND_nonsense")}), &problems), 0.75f);
    EXPECT_NE(problems.find("/m/surface [opacity] node /m/x has the unknown type 'ND_nonsense'"),
              std::string::npos)
        << problems;
}

TEST(Graph, MissingNodeAndOutputAreReported) {
    std::string problems;
    EXPECT_FLOAT_EQ(opacityOf(opacityNetwork({}), &problems), 0.75f);
    EXPECT_NE(problems.find("node /m/x does not exist"), std::string::npos) << problems;
    Network network = opacityNetwork({makeNode("x", "ND_separate3_color3")});
    network.nodes.back().connections["opacity"].output = "outq";
    EXPECT_FLOAT_EQ(opacityOf(network, &problems), 0.75f);
    EXPECT_NE(problems.find("has no output 'outq'"), std::string::npos) << problems;
}

TEST(Graph, TypeMismatchIsReported) {
    std::string problems;
    EXPECT_FLOAT_EQ(opacityOf(opacityNetwork({makeNode("x", "ND_constant_color3")}), &problems),
                    0.75f);
    EXPECT_NE(problems.find("/m/surface [opacity] type mismatch: color3 connected, float expected"),
              std::string::npos)
        << problems;
}

TEST(Graph, ClosureOnANumberIsReported) {
    std::string problems;
    EXPECT_FLOAT_EQ(
        opacityOf(opacityNetwork({makeNode("x", "ND_oren_nayar_diffuse_bsdf")}), &problems), 0.75f);
    EXPECT_NE(problems.find("type mismatch: BSDF connected"), std::string::npos) << problems;
}

TEST(Graph, NotANumberIsReported) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    Compiled c(makeNetwork({makeNode("surface", "ND_surface", {{"opacity", number(nan)}})}));
    EXPECT_FLOAT_EQ(c.program->opacity(ShadingPoint()), 1.0f);
    EXPECT_NE(warnings(c.diagnostics).find("not a finite number"), std::string::npos);
}

TEST(Graph, AMaterialWithoutAUsableSurfaceShowsDisplayColor) {
    Network network = previewNetwork();
    network.nodes[0].id = "SomeOtherSurface";
    Compiled c(network);
    ASSERT_EQ(c.program->primvars().size(), 2u);
    EXPECT_EQ(c.program->primvars()[0].name, "displayColor");
    Compiled empty((Network()));
    EXPECT_NE(empty.diagnostics.count(), 0);
}

TEST(Graph, LongChainsAndManyNodesAreHandled) {
    std::vector<NetworkNode> nodes;
    const int n = 20000;
    nodes.push_back(makeNode("n0", "ND_geompropvalue_float",
                             {{"geomprop", text("p")}, {"default", number(0.5f)}}));
    for (int i = 1; i < n; ++i)
        nodes.push_back(makeNode("n" + std::to_string(i), "ND_add_float", {{"in2", number(1e-6f)}},
                                 {{"in1", {"n" + std::to_string(i - 1), ""}}}));
    nodes.push_back(makeNode("x", "ND_dot_float", {}, {{"in", {"n" + std::to_string(n - 1), ""}}}));
    const float x = opacityOf(opacityNetwork(nodes));
    EXPECT_GE(x, 0.0f);
    EXPECT_LE(x, 1.0f);
}

TEST(Graph, ManyLobesAreCutWithAWarning) {
    std::vector<NetworkNode> nodes;
    const int n = 40;
    for (int i = 0; i < n; ++i) {
        const std::string k = std::to_string(i);
        nodes.push_back(
            makeNode("lobe" + k, "ND_oren_nayar_diffuse_bsdf",
                     {{"color", grey(0.01f)}, {"roughness", number(0.01f * float(i))}}));
        nodes.push_back(makeNode(i + 1 == n ? "bsdf" : "sum" + k, "ND_add_bsdf", {},
                                 {{"in1", {i ? "sum" + std::to_string(i - 1) : "lobe0", ""}},
                                  {"in2", {"lobe" + k, ""}}}));
    }
    Compiled c(bsdfNetwork(nodes));
    EXPECT_NE(warnings(c.diagnostics).find("more than 32 lobes"), std::string::npos);
    ShadingPoint point;
    Bsdf bsdf;
    c.program->evaluate(point, bsdf);
    EXPECT_EQ(bsdf.lobeCount(), Bsdf::maxLobes);
}

// Each sum uses the one before twice: 2^60 paths from the root to the lobe.
TEST(Graph, SharedClosuresCostNoMoreThanTheirNumber) {
    std::vector<NetworkNode> nodes = {
        makeNode("s0", "ND_oren_nayar_diffuse_bsdf", {{"color", grey(0.5f)}}),
        makeNode("coat", "ND_dielectric_bsdf")};
    const int n = 60;
    for (int i = 1; i <= n; ++i) {
        const std::string before = "s" + std::to_string(i - 1);
        nodes.push_back(makeNode("h" + std::to_string(i), "ND_multiply_bsdfF",
                                 {{"in2", number(0.5f)}}, {{"in1", {before, ""}}}));
        const std::string half = "h" + std::to_string(i);
        nodes.push_back(makeNode("s" + std::to_string(i), "ND_add_bsdf", {},
                                 {{"in1", {half, ""}}, {"in2", {half, ""}}}));
    }
    const std::string last = "s" + std::to_string(n);
    nodes.push_back(
        makeNode("bsdf", "ND_layer_bsdf", {}, {{"top", {last, ""}}, {"base", {last, ""}}}));
    const Network network = bsdfNetwork(nodes);
    Compiled c(network);
    Bsdf bsdf;
    c.program->evaluate(ShadingPoint(), bsdf);
    EXPECT_NEAR(bsdf.albedo().x, 0.5f, 1e-4f);
    Diagnostics diagnostics;
    EXPECT_LT(explainMaterial(network, diagnostics).size(), 200000u);
}

TEST(Values, AreBroughtToTheTypeOfTheInput) {
    InputDef def;
    Value out;
    std::optional<Message> problem;
    def.type = ValueType::Color3;
    EXPECT_TRUE(coerceValue(number(0.5f), def, out, problem));
    EXPECT_EQ(out.numbers, (std::vector<float>{0.5f, 0.5f, 0.5f}));
    Value srgb = grey(0.5f);
    srgb.colorSpace = "srgb_texture";
    EXPECT_TRUE(coerceValue(srgb, def, out, problem));
    EXPECT_NEAR(out.numbers[0], 0.21404f, 1e-5f);
    def.type = ValueType::Color4;
    EXPECT_TRUE(coerceValue(color(0.1f, 0.2f, 0.3f), def, out, problem));
    EXPECT_EQ(out.numbers, (std::vector<float>{0.1f, 0.2f, 0.3f, 1.0f}));
    def.type = ValueType::Float;
    EXPECT_FALSE(coerceValue(grey(1.0f), def, out, problem));
    EXPECT_FALSE(coerceValue(text("x"), def, out, problem));
}

TEST(NodeTable, HasNoDoublesAndCompleteRows) {
    std::set<std::string> ids;
    for (const auto& def : NodeTable::get().all()) {
        EXPECT_TRUE(ids.insert(def->id).second) << def->id << " is there twice";
        EXPECT_FALSE(def->outputs.empty()) << def->id;
        for (const InputDef& input : def->inputs) {
            EXPECT_NE(input.type, ValueType::Unknown) << def->id << "." << input.name;
            EXPECT_FALSE(input.name.empty()) << def->id;
        }
        for (const OutputDef& output : def->outputs)
            EXPECT_NE(output.type, ValueType::Unknown) << def->id;
    }
    EXPECT_GT(ids.size(), 250u);
}

} // namespace patina
