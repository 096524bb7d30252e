// SPDX-License-Identifier: Apache-2.0
// Small networks whose nodes are shared so that each way through them is one of 2^n, and chains
// that are longer than a stack is deep. Without bounds these tests do not end, or crash.
#include "materialNetwork/tests/mtlxFixture.h"

#include "base/limits.h"

using namespace patina;

namespace {

constexpr int levels = 40;

/// Nodes, NAME0, given, and NAME1 to NAMEn, each of which reads the one before twice.
std::vector<NetworkNode> withDoubled(std::vector<NetworkNode> nodes, const std::string& name,
                                     const std::string& id, const NetworkNode& first) {
    nodes.push_back(first);
    for (int i = 1; i <= levels; ++i) {
        const std::string before = numbered(name, i - 1);
        nodes.push_back(binaryNode(numbered(name, i), id, before, before));
    }
    return nodes;
}

void expectFinite(const Compiled& c) {
    const glm::vec3 albedo = c.albedo({0.6f, 0.0f, 0.8f});
    EXPECT_TRUE(std::isfinite(albedo.x + albedo.y + albedo.z));
}

void expectTold(const Network& network, const std::string& part) {
    const Compiled c(network);
    EXPECT_TRUE(told(c, part));
    expectFinite(c);
}

} // namespace

TEST(HostileNetworks, SharedClosuresUnderAFilmAreCoatedOnce) {
    expectFinite(Compiled(bsdfNetwork(withDoubled(
        {makeNode("film", "ND_thin_film_bsdf"), layerNode("bsdf", "film", numbered("d", levels))},
        "d", "ND_add_bsdf", makeNode("d0", "ND_dielectric_bsdf")))));
}

TEST(HostileNetworks, LayersOverSharedClosuresAreScaledByAlbedo) {
    const Network network =
        bsdfNetwork(withDoubled({makeNode("base", "ND_oren_nayar_diffuse_bsdf"),
                                 layerNode("bsdf", numbered("d", levels), "base")},
                                "d", "ND_add_bsdf", makeNode("d0", "ND_dielectric_bsdf")));
    const Compiled scaled(network), returned(network, {{"layering", "returned"}});
    EXPECT_TRUE(nothingTold(scaled));
    expectFinite(scaled);
    EXPECT_TRUE(told(returned, "its layers share too many closures"));
    expectFinite(returned);
}

TEST(HostileNetworks, MixedShadersThatAreSharedAreMixedOnce) {
    const struct {
        const char *terminal, *first, *mix;
    } kinds[] = {{"surface", "ND_surface", "ND_mix_surfaceshader"},
                 {"displacement", "ND_displacement_float", "ND_mix_displacementshader"},
                 {"volume", "ND_volume", "ND_mix_volumeshader"}};
    for (const auto& kind : kinds) {
        Network network = makeNetwork({makeNode("a0", kind.first), makeNode("b0", kind.first)});
        for (int i = 1; i <= levels; ++i)
            for (const auto& [name, share] : {std::pair("a", 0.3f), std::pair("b", 0.4f)})
                network.nodes.push_back(mixNode(numbered(name, i), numbered("a", i - 1),
                                                numbered("b", i - 1), share, kind.mix));
        network.terminals = {{kind.terminal, {"/m/" + numbered("a", levels), ""}}};
        expectFinite(Compiled(network));
    }
}

TEST(HostileNetworks, WhatAnIorReadsIsAskedOnce) {
    const auto nodes = withDoubled({makeNode("bsdf", "ND_dielectric_bsdf", {{"scatter_mode", "RT"}},
                                             {{"ior", numbered("f", levels)}})},
                                   "f", "ND_add_float",
                                   makeNode("f0", "ND_geompropvalue_float", {{"geomprop", "x"}}));
    Diagnostics diagnostics;
    EXPECT_FALSE(explainMaterial(bsdfNetwork(nodes), diagnostics).empty());
}

TEST(HostileNetworks, SlopesOfSlopesEnd) {
    std::vector<NetworkNode> nodes = {makeNode("uv", "ND_texcoord_vector2"),
                                      binaryNode("h0", "ND_dotproduct_vector2", "uv", "uv")};
    for (int i = 1; i <= levels; ++i) {
        nodes.push_back(makeNode(numbered("n", i), "ND_heighttonormal_vector3", {},
                                 {{"in", numbered("h", i - 1)}}));
        nodes.push_back(binaryNode(numbered("h", i), "ND_dotproduct_vector3", numbered("n", i),
                                   numbered("n", i)));
    }
    nodes.push_back(
        makeNode("bsdf", "ND_oren_nayar_diffuse_bsdf", {}, {{"roughness", numbered("h", levels)}}));
    expectTold(bsdfNetwork(nodes), "too much would have to be evaluated");
}

TEST(HostileNetworks, ChainsAreNotMadeLongPieceByPiece) {
    constexpr int length = 40000, step = 500;
    std::vector<NetworkNode> nodes = {makeNode("n0", "ND_oren_nayar_diffuse_bsdf"),
                                      makeNode("top", "ND_dielectric_bsdf")};
    for (int i = 1; i <= length; ++i)
        nodes.push_back(binaryNode(numbered("n", i), "ND_add_bsdf", numbered("n", i - 1), "n0"));
    // Rungs, of which the lowest is followed first, make a long chain known from below.
    nodes.push_back(binaryNode("r1", "ND_add_bsdf", numbered("n", step), numbered("n", 2 * step)));
    for (int k = 2; k * step + step <= length; ++k)
        nodes.push_back(binaryNode(numbered("r", k), "ND_add_bsdf", numbered("r", k - 1),
                                   numbered("n", (k + 1) * step)));
    nodes.push_back(layerNode("layer", "top", numbered("n", length)));
    nodes.push_back(binaryNode("bsdf", "ND_add_bsdf", numbered("r", length / step - 1), "layer"));
    expectTold(bsdfNetwork(nodes), "more nodes follow each other than 1000 (--limit chain)");
}

TEST(HostileNetworks, ConstantMatricesCountAsTheirRows) {
    std::vector<NetworkNode> nodes = {
        makeNode("x", "ND_geompropvalue_vector4", {{"geomprop", "x"}})};
    std::vector<std::string> sums;
    for (int i = 0; i < 16400; ++i) {
        Value matrix;
        matrix.type = ValueType::Matrix44;
        for (int k = 0; k < 16; ++k)
            matrix.numbers.push_back(float(i + k));
        nodes.push_back(makeNode(numbered("t", i), "ND_transformmatrix_vector4", {{"mat", matrix}},
                                 {{"in", "x"}}));
        sums.push_back(numbered("t", i));
    }
    for (int number = 0; sums.size() > 1;) {
        std::vector<std::string> half;
        for (size_t i = 0; i + 1 < sums.size(); i += 2) {
            half.push_back(numbered("s", number++));
            nodes.push_back(binaryNode(half.back(), "ND_add_vector4", sums[i], sums[i + 1]));
        }
        if (sums.size() % 2) half.push_back(sums.back());
        sums = half;
    }
    nodes.push_back(makeNode("e", "ND_extract_vector4", {}, {{"in", sums[0]}}));
    nodes.push_back(makeNode("bsdf", "ND_oren_nayar_diffuse_bsdf", {}, {{"roughness", "e"}}));
    expectTold(bsdfNetwork(nodes), "the material is too large");
}

TEST(HostileNetworks, ConstantLayersThatAreWalkedHaveAllRegisters) {
    const Compiled c(layered({makeNode("top", "ND_dielectric_bsdf"),
                              makeNode("base", "ND_oren_nayar_diffuse_bsdf")}),
                     {{"layering", "positionFree"}});
    const BsdfEval eval = c.lobes({0.6f, 0.0f, 0.8f}).eval({-0.6f, 0.0f, 0.8f});
    EXPECT_TRUE(std::isfinite(eval.pdf) && eval.pdf > 0.0f);
}

struct Limits : MtlxTest {
    ~Limits() override { setLimits({}); }
};

TEST_F(Limits, MaterialsTogetherHaveNoMoreNodesThanFiveTimesTheLimit) {
    setLimits({{"nodes", 10}});
    std::string body =
        "<add name='n0' type='float'/><surface_unlit name='s' type='surfaceshader'>" +
        inputFrom("emission", "float", "n19") + "</surface_unlit>";
    for (int i = 1; i < 20; ++i)
        body += "<add name='" + numbered("n", i) + "' type='float'>" +
                inputFrom("in1", "float", numbered("n", i - 1)) + "</add>";
    for (int i = 0; i < 9; ++i)
        body += materialOf("s", numbered("m", i));
    const auto networks = parse(body);
    size_t nodes = 0;
    for (const Network& material : networks)
        nodes += material.nodes.size();
    EXPECT_EQ(networks.size(), 9u);
    EXPECT_LE(nodes, 50u);
    EXPECT_GE(nodes, 20u);
    EXPECT_TRUE(reported("more nodes than five times 10"));
}

TEST_F(Limits, TextsThatNodesShareAreCopiedNoOftenerThanALimitAllows) {
    setLimits({{"documentBytes", 30000}});
    std::string body = "<nodegraph name='g'>" + inputOf("f", "string", std::string(1000, 'x'));
    for (int i = 0; i < 100; ++i)
        body += "<geompropvalue name='" + numbered("p", i) +
                "' type='float'><input name='geomprop' type='string' interfacename='f'/>"
                "</geompropvalue>";
    parse(body + "</nodegraph>");
    EXPECT_TRUE(reported("take more bytes than 30000"));
    EXPECT_EQ(diagnostics.count(), 1);
}

TEST_F(Limits, AreSetTogetherOrNotAtAll) {
    const uint64_t nodes = limitOf(Limit::nodes);
    EXPECT_EQ(setLimits({{"nodes", 7}}), "");
    EXPECT_EQ(limitOf(Limit::nodes), 7u);
    EXPECT_EQ(limitText(Limit::nodes), "7 (--limit nodes)");
    EXPECT_TRUE(has(setLimits({{"nodes", 9}, {"nothing", 1}}), "no limit 'nothing'"));
    EXPECT_EQ(setLimits({{"nesting", 1}}), "the limit nesting is from 8 to 1000");
    EXPECT_EQ(limitOf(Limit::nodes), 7u);
    EXPECT_EQ(setLimits({}), "");
    EXPECT_EQ(limitOf(Limit::nodes), nodes);
}

TEST_F(Limits, TextsThatAreTooLongAreLeftOutAndNamed) {
    setLimits({{"textLength", 8}});
    const Network network =
        makeNetwork({makeNode("image", "ND_image_color3",
                              {{"file", file("123456789")}, {"uaddressmode", "12345678"}})},
                    "image");
    const Network found = expand(network, diagnostics);
    ASSERT_EQ(found.nodes.size(), 1u);
    EXPECT_EQ(found.nodes[0].inputs.count("file"), 0u);
    EXPECT_EQ(found.nodes[0].inputs.count("uaddressmode"), 1u);
    ASSERT_EQ(diagnostics.count(), 1);
    const Diagnostic told = diagnostics.all()[0];
    EXPECT_EQ(told.prim + " " + told.input + ": " + told.message,
              "/m/image file: the text is longer than 8 (--limit textLength); the default is used");
}
