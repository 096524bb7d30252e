// SPDX-License-Identifier: Apache-2.0
// Included documents, and documents of MaterialX 1.38.
#include "materialNetwork/tests/mtlxFixture.h"

#include "materialNetwork/network/translate.h"

using namespace patina;

namespace {

namespace fs = std::filesystem;

const std::string paint =
    R"(<image name="img" type="color3"><input name="file" type="filename" value="a.png" /></image>)" +
    surfaceOfColor("img");
const std::string ofPaint = version139 + " colorspace='srgb_texture' fileprefix='maps/'";

using MtlxInclude = MtlxTest;
using MtlxUpgrade = MtlxTest;

const std::string quarters = constantOf("c", "color4", "0.1, 0.2, 0.3, 0.4");

/// Of a document of MaterialX 1.38.
glm::vec3 oldLight(const std::string& body) {
    return lightOf(body, {}, {}, version138);
}

} // namespace

TEST_F(MtlxInclude, DocumentsKeepTheirFolderAndColorSpace) {
    documents.write("sub/paint.mtlx", paint, ofPaint);
    documents.write("sub/middle.mtlx", "<xi:include href='paint.mtlx' />");
    const auto networks = read("<xi:include href='sub/middle.mtlx' />" + materialOf("s"));
    EXPECT_TRUE(nothingTold(diagnostics));
    ASSERT_EQ(networks.size(), 1u);
    const Compiled c(networks[0]);
    ASSERT_EQ(c.textures.requests.size(), 1u);
    EXPECT_EQ(c.textures.requests[0].colorSpace, "srgb_texture");
    const fs::path file(c.textures.requests[0].file);
    EXPECT_EQ(file.parent_path().filename(), "maps");
    EXPECT_EQ(file.parent_path().parent_path().filename(), "sub");
}

TEST_F(MtlxInclude, WhatCannotBeReadIsReported) {
    documents.write("sub/paint.mtlx", paint, ofPaint);
    documents.writeText("broken.mtlx", "<materialx><a></materialx>");
    documents.write("circle.mtlx", "<xi:include href='main.mtlx' />");
    EXPECT_EQ(read(R"(<xi:include href="nothing.mtlx" /><xi:include href="broken.mtlx" />
      <xi:include href="circle.mtlx" /><xi:include href="" />
      <xi:include href="sub/paint.mtlx" />)")
                  .size(),
              1u);
    EXPECT_EQ(diagnostics.count(), 4) << warnings(diagnostics);
}

TEST_F(MtlxUpgrade, SwizzlesBecomeExtractsAndCombinations) {
    const auto swizzled = [](const std::string& type, const std::string& value,
                             const std::string& channels) {
        return oldLight(constantOf("c", type, value) + "<swizzle name='p' type='color3'>" +
                        inputFrom("in", type, "c") + inputOf("channels", "string", channels) +
                        "</swizzle>");
    };
    expectVector(swizzled("color3", "0.1, 0.2, 0.3", "bgr"), 0.3f, 0.2f, 0.1f);
    expectVector(swizzled("vector4", "0.1, 0.2, 0.3, 0.4", "ww1"), 0.4f, 0.4f, 1.0f);
    expectVector(swizzled("float", "0.7", "xx0"), 0.7f, 0.7f, 0.0f);
    // One channel of three, and a value instead of a connection.
    expectVector(oldLight("<swizzle name='f' type='float'>" + inputOf("in", "vector3", "1, 2, 3") +
                          inputOf("channels", "string", "z") + "</swizzle>" +
                          convertOf("float", "f")),
                 3, 3, 3);
}

TEST_F(MtlxUpgrade, ChannelsOfAConnection) {
    expectVector(oldLight(quarters + R"(<multiply name="p" type="color3">
        <input name="in1" type="color3" nodename="c" channels="rrb" />
        <input name="in2" type="float" nodename="c" channels="a" /></multiply>)"),
                 0.04f, 0.04f, 0.12f);
    read(R"(<constant name="c" type="color3" /><surface name="s" type="surfaceshader" />
      <add name="p" type="float"><input name="in1" type="float" nodename="c" channels="?" /></add>)",
         version138);
    EXPECT_EQ(diagnostics.count(), 0); // a channel that is none of them is 0
    read(R"(<add name="p" type="float">
      <input name="in1" type="float" nodename="nothing" channels="r" /></add>
      <surface name="s" type="surfaceshader" />)",
         version138);
    EXPECT_EQ(diagnostics.count(), 1) << warnings(diagnostics);
}

TEST_F(MtlxUpgrade, ChannelsOfOutputs) {
    const std::string graph = "<nodegraph name='g'>" + quarters + R"(
        <output name="tint" type="color3" nodename="c" channels="bgr" />
        <output name="cover" type="float" nodename="c" channels="a" /></nodegraph>)";
    expectVector(oldLight(graph + R"(<multiply name="p" type="color3">
        <input name="in1" type="color3" nodegraph="g" output="tint" />
        <input name="in2" type="float" nodegraph="g" output="cover" /></multiply>)"),
                 0.12f, 0.08f, 0.04f);
    // Of a graph, and of a node with several outputs.
    expectVector(oldLight(graph + R"(<separate4 name="s4" type="multioutput">
        <input name="in" type="color4" value="0.1, 0.2, 0.3, 0.4" /></separate4>
      <multiply name="p" type="color3">
        <input name="in1" type="color3" nodegraph="g" output="tint" channels="rrr" />
        <input name="in2" type="float" nodename="s4" output="outb" channels="r" /></multiply>)"),
                 0.09f, 0.09f, 0.09f);
}

TEST_F(MtlxUpgrade, RenamedInputsAndNormalMaps) {
    expectVector(oldLight("<atan2 name='a' type='float'>" + inputOf("in1", "float", "1") +
                          inputOf("in2", "float", "1") + "</atan2>" + convertOf("float", "a")),
                 glm::vec3(0.7853982f));
    expectVector(
        oldLight("<normalmap name='n' type='vector3'>" + inputOf("in", "vector3", "0.8, 0.5, 0.9") +
                 inputOf("space", "string", "object") + "</normalmap>" + convertOf("vector3", "n")),
        0.6f, 0.0f, 0.8f);
}

TEST_F(MtlxUpgrade, ThinFilmsMoveIntoTheirBase) {
    const Network network = readOne(R"(
      <thin_film_bsdf name="film" type="BSDF">
        <input name="thickness" type="float" value="400" /></thin_film_bsdf>
      <conductor_bsdf name="metal" type="BSDF" />
      <dielectric_bsdf name="through" type="BSDF">
        <input name="scatter_mode" type="string" value="T" /></dielectric_bsdf>
      <mix name="both" type="BSDF"><input name="fg" type="BSDF" nodename="metal" />
        <input name="bg" type="BSDF" nodename="through" />
        <input name="mix" type="float" value="0.5" /></mix>
      <layer name="l" type="BSDF"><input name="top" type="BSDF" nodename="film" />
        <input name="base" type="BSDF" nodename="both" /></layer>)" +
                                        surfaceOfBsdf("l"),
                                    version138);
    const NetworkNode *metal = network.find("/metal"), *through = network.find("/through"),
                      *layer = network.find("/l");
    ASSERT_TRUE(metal && through && layer);
    EXPECT_EQ(metal->inputs.at("thinfilm_thickness").numbers[0], 400.0f);
    EXPECT_EQ(metal->inputs.at("thinfilm_ior").numbers[0], 1.5f);
    EXPECT_EQ(through->inputs.count("thinfilm_thickness"), 0u);
    EXPECT_EQ(layer->id, "ND_mix_bsdf");
}

TEST_F(MtlxUpgrade, ThinSurfacesHaveABack) {
    const Network network = readOne(R"(
      <oren_nayar_diffuse_bsdf name="f" type="BSDF" /><burley_diffuse_bsdf name="b" type="BSDF" />
      <thin_surface name="s" type="surfaceshader">
        <input name="front_bsdf" type="BSDF" nodename="f" />
        <input name="back_bsdf" type="BSDF" nodename="b" /></thin_surface>)" +
                                        materialOf("s"),
                                    version138);
    const NetworkNode* surface = network.find("/s");
    ASSERT_NE(surface, nullptr);
    EXPECT_EQ(surface->id, "ND_surface");
    EXPECT_EQ(surface->inputs.at("thin_walled").numbers[0], 1.0f);
    EXPECT_EQ(surface->connections.at("bsdf").node, "/f");
}

Network upgradedNetwork(Network network) {
    Diagnostics diagnostics;
    upgradeNetwork(network, diagnostics);
    EXPECT_TRUE(nothingTold(diagnostics));
    return network;
}

/// The colour that a network of a stage emits, which says nothing of its version.
glm::vec3 stageLight(std::vector<NetworkNode> nodes) {
    return emitted(upgradedNetwork(
        modelNetwork("ND_surface_unlit", {}, {{"emission_color", "p.out"}}, std::move(nodes))));
}

TEST_F(MtlxUpgrade, NetworksOfStages) {
    const auto swizzled = [](const char* channels) {
        return stageLight({makeNode("v", "ND_constant_vector3", {{"value", vector(.1f, .2f, .3f)}}),
                           makeNode("p", "ND_swizzle_vector3_color3", {{"channels", channels}},
                                    {{"in", "v.out"}})});
    };
    expectVector(swizzled("zx1"), 0.3f, 0.1f, 1.0f);
    // Fewer channels than there are components: the first one stands in.
    expectVector(swizzled("y"), 0.2f, 0.1f, 0.1f);
    const auto converted = [](const char* id, const Inputs& inputs, const char* type = "float") {
        return stageLight(
            {makeNode("f", id, inputs),
             makeNode("p", std::string("ND_convert_") + type + "_color3", {}, {{"in", "f.out"}})});
    };
    expectVector(converted("ND_swizzle_color3_float", {{"channels", "g"}, {"in", color(1, 2, 3)}}),
                 2, 2, 2);
    expectVector(converted("ND_atan2_float", {{"in1", 2.0f}, {"in2", 1.0f}}),
                 glm::vec3(1.1071487f));
    expectVector(
        converted("ND_normalmap", {{"in", vector(.8f, .5f, .9f)}, {"space", "object"}}, "vector3"),
        0.6f, 0.0f, 0.8f);
    const auto chosen = [&](float which) {
        return stageLight(
            {makeNode("p", "ND_switch_color3",
                      {{"in1", color(1, 0, 0)}, {"in3", color(0, 0, 1)}, {"which", which}})});
    };
    expectVector(chosen(2.0f), 0, 0, 1);
    expectVector(chosen(7.0f), 1, 0, 0); // out of the range of 1.38, which had five inputs
}

TEST_F(MtlxUpgrade, BitangentsOf138AreMadeOfNormalAndTangent) {
    const auto bent = [](bool before139) {
        const Network network =
            modelNetwork("ND_surface_unlit", {}, {{"emission_color", "p.out"}},
                         {makeNode("n", "ND_normalmap_float",
                                   {{"in", vector(0.5f, 1.0f, 0.5f)},
                                    {"normal", vector(0, 0, 1)},
                                    {"tangent", vector(0, -1, 0)}}),
                          makeNode("p", "ND_convert_vector3_color3", {}, {{"in", "n.out"}})});
        return emitted(before139 ? upgradedNetwork(network) : network);
    };
    // Along the bitangent: the cross product of both, or the surface's own, which is y.
    expectVector(bent(true), 1, 0, 0);
    expectVector(bent(false), 0, 1, 0);
}

TEST_F(MtlxUpgrade, ThinSurfacesOfStagesHaveABack) {
    const Network network = upgradedNetwork(
        modelNetwork("ND_thin_surface", {}, {{"front_edf", "f.out"}, {"back_edf", "b.out"}},
                     {makeNode("f", "ND_uniform_edf", {{"color", color(1, 0, 0)}}),
                      makeNode("b", "ND_uniform_edf", {{"color", color(0, 1, 0)}})}));
    expectVector(emitted(network), 1, 0, 0);
    expectVector(emitted(network, seenFrom({0, 0, -1})), 0, 1, 0);
}

TEST_F(MtlxUpgrade, ThinFilmsOfStages) {
    const Network network = upgradedNetwork(
        bsdfNetwork({makeNode("film", "ND_thin_film_bsdf", {{"thickness", 400.0f}}),
                     makeNode("metal", "ND_conductor_bsdf"), layerNode("bsdf", "film", "metal")}));
    EXPECT_EQ(network.find("/m/metal")->inputs.at("thinfilm_thickness").numbers[0], 400.0f);
    const CleanCompiled c(network);
}
