// SPDX-License-Identifier: Apache-2.0
// Broken networks: never a crash or a hang, always a message, always the documented fallback.
#include "materialNetwork/tests/materialFixture.h"

#include "materialNetwork/nodes/nodeTable.h"
#include "materialNetwork/network/value.h"

#include <limits>
#include <set>

using namespace patina;

namespace {

/// A surface whose opacity reads node "x", and is 0.75 otherwise.
Network opacityNetwork(std::vector<NetworkNode> nodes, const Link& link = "x") {
    return modelNetwork("ND_surface", {{"opacity", 0.75f}}, {{"opacity", link}}, std::move(nodes));
}

} // namespace

TEST(Graph, WhatCannotBeReadIsReportedAndTheOwnValueUsed) {
    const struct {
        const char* message;
        Network network;
        float opacity = 0.75f;
    } cases[] = {
        {"/m/y [in1] connections form a cycle",
         opacityNetwork({makeNode("x", "ND_add_float", {{"in2", 0.125f}}, {{"in1", "y"}}),
                         makeNode("y", "ND_multiply_float", {{"in2", 1.0f}}, {{"in1", "x"}})}),
         0.125f},
        {"/m/surface [opacity] node /m/x has the unknown type 'ND_nonsense'",
         opacityNetwork({makeNode("x", "ND_nonsense")})},
        {"node /m/x does not exist", opacityNetwork({})},
        {"has no output 'outq'", opacityNetwork({makeNode("x", "ND_separate3_color3")}, "x.outq")},
        {"/m/surface [opacity] type mismatch: color3 connected, float expected",
         opacityNetwork({makeNode("x", "ND_constant_color3")})},
        {"type mismatch: BSDF connected",
         opacityNetwork({makeNode("x", "ND_oren_nayar_diffuse_bsdf")})},
        {"not a finite number",
         modelNetwork("ND_surface", {{"opacity", std::numeric_limits<float>::quiet_NaN()}}), 1.0f},
    };
    for (const auto& [message, network, opacity] : cases) {
        const Compiled c(network);
        EXPECT_TRUE(told(c, message));
        EXPECT_FLOAT_EQ(c->opacity(ShadingPoint()), opacity) << message;
    }
}

TEST(Graph, CycleThroughAModelEnds) {
    const Compiled c(previewNetwork({}, {{"roughness", "surface.surface"}}));
    EXPECT_NE(c.diagnostics.count(), 0);
    EXPECT_TRUE(c->isOpaque());
}

TEST(Graph, AMaterialWithoutAUsableSurfaceShowsDisplayColor) {
    const Compiled c(modelNetwork("SomeOtherSurface"));
    ASSERT_EQ(c->primvars().size(), 2u);
    EXPECT_EQ(c->primvars()[0].name, "displayColor");
    EXPECT_NE(Compiled(Network()).diagnostics.count(), 0);
}

TEST(Graph, LongChainsAndManyNodesAreHandled) {
    const int n = 20000;
    std::vector<NetworkNode> nodes = {
        makeNode("n0", "ND_geompropvalue_float", {{"geomprop", "p"}, {"default", 0.5f}})};
    for (int i = 1; i < n; ++i)
        nodes.push_back(makeNode(numbered("n", i), "ND_add_float", {{"in2", 1e-6f}},
                                 {{"in1", numbered("n", i - 1)}}));
    nodes.push_back(makeNode("x", "ND_dot_float", {}, {{"in", numbered("n", n - 1)}}));
    const float x = Compiled(opacityNetwork(nodes))->opacity(ShadingPoint());
    EXPECT_GE(x, 0.0f);
    EXPECT_LE(x, 1.0f);
}

TEST(Graph, ManyLobesAreCutWithAWarning) {
    std::vector<NetworkNode> nodes;
    const int n = 40;
    for (int i = 0; i < n; ++i) {
        const std::string lobe = numbered("lobe", i);
        nodes.push_back(makeNode(lobe, "ND_oren_nayar_diffuse_bsdf",
                                 {{"color", grey(0.01f)}, {"roughness", 0.01f * float(i)}}));
        nodes.push_back(binaryNode(i + 1 == n ? "bsdf" : numbered("sum", i), "ND_add_bsdf",
                                   i ? numbered("sum", i - 1) : "lobe0", lobe));
    }
    const Compiled c(bsdfNetwork(nodes));
    EXPECT_TRUE(told(c, "more than 32 lobes"));
    EXPECT_EQ(c.lobes().lobeCount(), Bsdf::maxLobes);
}

// Each sum uses the one before twice: 2^60 paths from the root to the lobe.
TEST(Graph, SharedClosuresCostNoMoreThanTheirNumber) {
    std::vector<NetworkNode> nodes = {diffuseNode("s0", grey(0.5f))};
    const int n = 60;
    for (int i = 1; i <= n; ++i) {
        const std::string half = numbered("h", i);
        nodes.push_back(
            makeNode(half, "ND_multiply_bsdfF", {{"in2", 0.5f}}, {{"in1", numbered("s", i - 1)}}));
        nodes.push_back(binaryNode(numbered("s", i), "ND_add_bsdf", half, half));
    }
    nodes.push_back(layerNode("bsdf", numbered("s", n), numbered("s", n)));
    const Network network = bsdfNetwork(nodes);
    EXPECT_NEAR(Compiled(network).albedo().x, 0.5f, 1e-4f);
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
