// SPDX-License-Identifier: Apache-2.0
// Small networks whose nodes are shared so that each way through them is one of 2^n, and chains
// that are longer than a stack is deep. Without bounds these tests do not end, or crash.
#include "materialNetwork/tests/mtlxFixture.h"

#include "base/limits.h"

#include <cmath>

namespace patina {

namespace {

constexpr int levels = 40;

/// Nodes, NAME0, given, and NAME1 to NAMEn, each of which reads the one before twice.
std::vector<NetworkNode> withDoubled(std::vector<NetworkNode> nodes, const std::string& name,
                                     const std::string& id, const NetworkNode& first) {
    nodes.push_back(first);
    for (int i = 1; i <= levels; ++i) {
        const std::string before = numbered(name, i - 1);
        nodes.push_back(makeNode(numbered(name, i), id, {}, {{"in1", before}, {"in2", before}}));
    }
    return nodes;
}

void expectFinite(const Compiled& c) {
    const glm::vec3 albedo = c.albedo({0.6f, 0.0f, 0.8f});
    EXPECT_TRUE(std::isfinite(albedo.x + albedo.y + albedo.z));
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
        Network network;
        network.path = "/m";
        network.nodes = {makeNode("a0", kind.first), makeNode("b0", kind.first)};
        for (int i = 1; i <= levels; ++i)
            for (const auto& [name, share] : {std::pair("a", 0.3f), std::pair("b", 0.4f)})
                network.nodes.push_back(
                    makeNode(numbered(name, i), kind.mix, {{"mix", share}},
                             {{"fg", numbered("a", i - 1)}, {"bg", numbered("b", i - 1)}}));
        network.terminals[kind.terminal] = {"/m/" + numbered("a", levels), ""};
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
    std::vector<NetworkNode> nodes = {
        makeNode("uv", "ND_texcoord_vector2"),
        makeNode("h0", "ND_dotproduct_vector2", {}, {{"in1", "uv"}, {"in2", "uv"}})};
    for (int i = 1; i <= levels; ++i) {
        nodes.push_back(makeNode(numbered("n", i), "ND_heighttonormal_vector3", {},
                                 {{"in", numbered("h", i - 1)}}));
        nodes.push_back(makeNode(numbered("h", i), "ND_dotproduct_vector3", {},
                                 {{"in1", numbered("n", i)}, {"in2", numbered("n", i)}}));
    }
    nodes.push_back(
        makeNode("bsdf", "ND_oren_nayar_diffuse_bsdf", {}, {{"roughness", numbered("h", levels)}}));
    Compiled c(bsdfNetwork(nodes));
    EXPECT_TRUE(told(c, "too much would have to be evaluated")) << warnings(c);
    expectFinite(c);
}

TEST(HostileNetworks, ChainsAreNotMadeLongPieceByPiece) {
    constexpr int length = 40000, step = 500;
    std::vector<NetworkNode> nodes = {makeNode("n0", "ND_oren_nayar_diffuse_bsdf"),
                                      makeNode("top", "ND_dielectric_bsdf")};
    for (int i = 1; i <= length; ++i)
        nodes.push_back(makeNode(numbered("n", i), "ND_add_bsdf", {},
                                 {{"in1", numbered("n", i - 1)}, {"in2", "n0"}}));
    // Rungs, of which the lowest is followed first, make a long chain known from below.
    nodes.push_back(makeNode("r1", "ND_add_bsdf", {},
                             {{"in1", numbered("n", step)}, {"in2", numbered("n", 2 * step)}}));
    for (int k = 2; k * step + step <= length; ++k)
        nodes.push_back(
            makeNode(numbered("r", k), "ND_add_bsdf", {},
                     {{"in1", numbered("r", k - 1)}, {"in2", numbered("n", (k + 1) * step)}}));
    nodes.push_back(layerNode("layer", "top", numbered("n", length)));
    nodes.push_back(makeNode("bsdf", "ND_add_bsdf", {},
                             {{"in1", numbered("r", length / step - 1)}, {"in2", "layer"}}));
    Compiled c(bsdfNetwork(nodes));
    EXPECT_TRUE(told(c, "more nodes follow each other than 1000 (--limit chain)"))
        << c.diagnostics.count();
    expectFinite(c);
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
            nodes.push_back(makeNode(half.back(), "ND_add_vector4", {},
                                     {{"in1", sums[i]}, {"in2", sums[i + 1]}}));
        }
        if (sums.size() % 2) half.push_back(sums.back());
        sums = half;
    }
    nodes.push_back(makeNode("e", "ND_extract_vector4", {}, {{"in", sums[0]}}));
    nodes.push_back(makeNode("bsdf", "ND_oren_nayar_diffuse_bsdf", {}, {{"roughness", "e"}}));
    Compiled c(bsdfNetwork(nodes));
    EXPECT_TRUE(told(c, "the material is too large")) << warnings(c);
    expectFinite(c);
}

TEST(HostileNetworks, ConstantLayersThatAreWalkedHaveAllRegisters) {
    const Compiled c(layered({makeNode("top", "ND_dielectric_bsdf"),
                              makeNode("base", "ND_oren_nayar_diffuse_bsdf")}),
                     {{"layering", "positionFree"}});
    const BsdfEval eval = c.lobes({0.6f, 0.0f, 0.8f}).eval({-0.6f, 0.0f, 0.8f});
    EXPECT_TRUE(std::isfinite(eval.pdf) && eval.pdf > 0.0f);
}

struct HostileDocuments : MtlxTest {
    ~HostileDocuments() override { setLimits({}); }
};

TEST_F(HostileDocuments, MaterialsTogetherHaveNoMoreNodesThanFiveTimesTheLimit) {
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

TEST_F(HostileDocuments, TextsThatNodesShareAreCopiedNoOftenerThanALimitAllows) {
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

} // namespace patina
