// SPDX-License-Identifier: Apache-2.0
// Small networks whose nodes are shared so that each way through them is one of 2^n, and chains
// that are longer than a stack is deep. Without bounds these tests do not end, or crash.
#include "materialNetwork/tests/materialFixture.h"

#include "base/limits.h"
#include "materialNetwork/material.h"
#include "materialNetwork/mtlx/document.h"

#include <cmath>

namespace patina {

namespace {

constexpr int levels = 40;

std::string at(const std::string& name, int i) {
    return name + std::to_string(i);
}

/// NAME0, given, and NAME1 to NAMEn, each of which reads the one before twice.
void doubled(std::vector<NetworkNode>& nodes, const std::string& name, const std::string& id,
             NetworkNode first, int count = levels) {
    nodes.push_back(std::move(first));
    for (int i = 1; i <= count; ++i)
        nodes.push_back(makeNode(at(name, i), id, {},
                                 {{"in1", {at(name, i - 1), ""}}, {"in2", {at(name, i - 1), ""}}}));
}

void expectFinite(const Compiled& c) {
    ShadingPoint point;
    point.viewDirection = {0.6f, 0.0f, 0.8f};
    Bsdf bsdf;
    c.program->evaluate(point, bsdf);
    const glm::vec3 albedo = bsdf.albedo();
    EXPECT_TRUE(std::isfinite(albedo.x + albedo.y + albedo.z));
}

bool told(const Compiled& c, const std::string& part) {
    return warnings(c.diagnostics).find(part) != std::string::npos;
}

} // namespace

TEST(HostileNetworks, SharedClosuresUnderAFilmAreCoatedOnce) {
    std::vector<NetworkNode> nodes = {
        makeNode("film", "ND_thin_film_bsdf"),
        makeNode("bsdf", "ND_layer_bsdf", {},
                 {{"top", {"film", ""}}, {"base", {at("d", levels), ""}}})};
    doubled(nodes, "d", "ND_add_bsdf", makeNode("d0", "ND_dielectric_bsdf"));
    expectFinite(Compiled(bsdfNetwork(nodes)));
}

TEST(HostileNetworks, LayersOverSharedClosuresAreScaledByAlbedo) {
    std::vector<NetworkNode> nodes = {
        makeNode("base", "ND_oren_nayar_diffuse_bsdf"),
        makeNode("bsdf", "ND_layer_bsdf", {},
                 {{"top", {at("d", levels), ""}}, {"base", {"base", ""}}})};
    doubled(nodes, "d", "ND_add_bsdf", makeNode("d0", "ND_dielectric_bsdf"));
    Compiled scaled(bsdfNetwork(nodes));
    EXPECT_EQ(warnings(scaled.diagnostics), "");
    expectFinite(scaled);
    Compiled returned(bsdfNetwork(nodes), {{"layering", "returned"}});
    EXPECT_TRUE(told(returned, "its layers share too many closures"))
        << warnings(returned.diagnostics);
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
                    makeNode(at(name, i), kind.mix, {{"mix", number(share)}},
                             {{"fg", {at("a", i - 1), ""}}, {"bg", {at("b", i - 1), ""}}}));
        network.terminals[kind.terminal] = {"/m/" + at("a", levels), ""};
        expectFinite(Compiled(network));
    }
}

TEST(HostileNetworks, WhatAnIorReadsIsAskedOnce) {
    std::vector<NetworkNode> nodes = {makeNode("bsdf", "ND_dielectric_bsdf",
                                               {{"scatter_mode", text("RT")}},
                                               {{"ior", {at("f", levels), ""}}})};
    doubled(nodes, "f", "ND_add_float",
            makeNode("f0", "ND_geompropvalue_float", {{"geomprop", text("x")}}));
    Diagnostics diagnostics;
    EXPECT_FALSE(explainMaterial(bsdfNetwork(nodes), diagnostics).empty());
}

TEST(HostileNetworks, SlopesOfSlopesEnd) {
    std::vector<NetworkNode> nodes = {
        makeNode("uv", "ND_texcoord_vector2"),
        makeNode("h0", "ND_dotproduct_vector2", {}, {{"in1", {"uv", ""}}, {"in2", {"uv", ""}}})};
    for (int i = 1; i <= levels; ++i) {
        nodes.push_back(
            makeNode(at("n", i), "ND_heighttonormal_vector3", {}, {{"in", {at("h", i - 1), ""}}}));
        nodes.push_back(makeNode(at("h", i), "ND_dotproduct_vector3", {},
                                 {{"in1", {at("n", i), ""}}, {"in2", {at("n", i), ""}}}));
    }
    nodes.push_back(
        makeNode("bsdf", "ND_oren_nayar_diffuse_bsdf", {}, {{"roughness", {at("h", levels), ""}}}));
    Compiled c(bsdfNetwork(nodes));
    EXPECT_TRUE(told(c, "too much would have to be evaluated")) << warnings(c.diagnostics);
    expectFinite(c);
}

TEST(HostileNetworks, ChainsAreNotMadeLongPieceByPiece) {
    constexpr int length = 40000, step = 500;
    std::vector<NetworkNode> nodes = {makeNode("n0", "ND_oren_nayar_diffuse_bsdf"),
                                      makeNode("top", "ND_dielectric_bsdf")};
    for (int i = 1; i <= length; ++i)
        nodes.push_back(makeNode(at("n", i), "ND_add_bsdf", {},
                                 {{"in1", {at("n", i - 1), ""}}, {"in2", {"n0", ""}}}));
    // Rungs, of which the lowest is followed first, make a long chain known from below.
    nodes.push_back(makeNode("r1", "ND_add_bsdf", {},
                             {{"in1", {at("n", step), ""}}, {"in2", {at("n", 2 * step), ""}}}));
    for (int k = 2; k * step + step <= length; ++k)
        nodes.push_back(
            makeNode(at("r", k), "ND_add_bsdf", {},
                     {{"in1", {at("r", k - 1), ""}}, {"in2", {at("n", (k + 1) * step), ""}}}));
    nodes.push_back(makeNode("layer", "ND_layer_bsdf", {},
                             {{"top", {"top", ""}}, {"base", {at("n", length), ""}}}));
    nodes.push_back(makeNode("bsdf", "ND_add_bsdf", {},
                             {{"in1", {at("r", length / step - 1), ""}}, {"in2", {"layer", ""}}}));
    Compiled c(bsdfNetwork(nodes));
    EXPECT_TRUE(told(c, "more nodes follow each other than 1000 (--limit chain)"))
        << c.diagnostics.count();
    expectFinite(c);
}

TEST(HostileNetworks, ConstantMatricesCountAsTheirRows) {
    std::vector<NetworkNode> nodes = {
        makeNode("x", "ND_geompropvalue_vector4", {{"geomprop", text("x")}})};
    std::vector<std::string> sums;
    for (int i = 0; i < 16400; ++i) {
        Value matrix;
        matrix.type = ValueType::Matrix44;
        for (int k = 0; k < 16; ++k)
            matrix.numbers.push_back(float(i + k));
        nodes.push_back(makeNode(at("t", i), "ND_transformmatrix_vector4", {{"mat", matrix}},
                                 {{"in", {"x", ""}}}));
        sums.push_back(at("t", i));
    }
    for (int number = 0; sums.size() > 1;) {
        std::vector<std::string> half;
        for (size_t i = 0; i + 1 < sums.size(); i += 2) {
            half.push_back(at("s", number++));
            nodes.push_back(makeNode(half.back(), "ND_add_vector4", {},
                                     {{"in1", {sums[i], ""}}, {"in2", {sums[i + 1], ""}}}));
        }
        if (sums.size() % 2) half.push_back(sums.back());
        sums = half;
    }
    nodes.push_back(makeNode("e", "ND_extract_vector4", {}, {{"in", {sums[0], ""}}}));
    nodes.push_back(makeNode("bsdf", "ND_oren_nayar_diffuse_bsdf", {}, {{"roughness", {"e", ""}}}));
    Compiled c(bsdfNetwork(nodes));
    EXPECT_TRUE(told(c, "the material is too large")) << warnings(c.diagnostics);
    expectFinite(c);
}

TEST(HostileNetworks, ConstantLayersThatAreWalkedHaveAllRegisters) {
    const Network network = bsdfNetwork(
        {makeNode("top", "ND_dielectric_bsdf"), makeNode("base", "ND_oren_nayar_diffuse_bsdf"),
         makeNode("bsdf", "ND_layer_bsdf", {}, {{"top", {"top", ""}}, {"base", {"base", ""}}})});
    FakeTextures textures;
    Diagnostics diagnostics;
    const auto program =
        compileMaterial(network, textures, diagnostics, {{"layering", "positionFree"}});
    ShadingPoint point;
    point.viewDirection = {0.6f, 0.0f, 0.8f};
    Bsdf bsdf;
    program->evaluate(point, bsdf);
    const BsdfEval eval = bsdf.eval({-0.6f, 0.0f, 0.8f});
    EXPECT_TRUE(std::isfinite(eval.pdf) && eval.pdf > 0.0f);
}

class HostileDocuments : public testing::Test {
protected:
    ~HostileDocuments() override { setLimits({}); }
    void parse(const std::string& body) {
        ASSERT_TRUE(parseMtlx("<materialx version='1.39'>" + body + "</materialx>", "a.mtlx", true,
                              document, diagnostics));
    }
    MtlxDocument document;
    Diagnostics diagnostics;
};

TEST_F(HostileDocuments, MaterialsTogetherHaveNoMoreNodesThanFiveTimesTheLimit) {
    setLimits({{"nodes", 10}});
    std::string body = "<add name='n0' type='float'/>";
    for (int i = 1; i < 20; ++i)
        body += "<add name='" + at("n", i) +
                "' type='float'><input name='in1' type='float' nodename='" + at("n", i - 1) +
                "'/></add>";
    body += "<surface_unlit name='s' type='surfaceshader'><input name='emission' type='float' "
            "nodename='n19'/></surface_unlit>";
    for (int i = 0; i < 9; ++i)
        body += "<surfacematerial name='" + at("m", i) +
                "' type='material'><input name='surfaceshader' type='surfaceshader' "
                "nodename='s'/></surfacematerial>";
    parse(body);
    size_t nodes = 0;
    for (const Network& material : document.materials)
        nodes += material.nodes.size();
    EXPECT_EQ(document.materials.size(), 9u);
    EXPECT_LE(nodes, 50u);
    EXPECT_GE(nodes, 20u);
    EXPECT_NE(warnings(diagnostics).find("more nodes than five times 10"), std::string::npos);
}

TEST_F(HostileDocuments, TextsThatNodesShareAreCopiedNoOftenerThanALimitAllows) {
    setLimits({{"documentBytes", 30000}});
    std::string body = "<nodegraph name='g'><input name='f' type='string' value='" +
                       std::string(1000, 'x') + "'/>";
    for (int i = 0; i < 100; ++i)
        body += "<geompropvalue name='" + at("p", i) +
                "' type='float'><input name='geomprop' type='string' interfacename='f'/>"
                "</geompropvalue>";
    parse(body + "</nodegraph>");
    EXPECT_NE(warnings(diagnostics).find("take more bytes than 30000"), std::string::npos);
    EXPECT_EQ(diagnostics.count(), 1);
}

} // namespace patina
