// SPDX-License-Identifier: Apache-2.0
// MaterialX documents.
#include "materialNetwork/tests/materialFixture.h"

#include "materialNetwork/mtlx/document.h"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace patina {

namespace {

std::vector<Network> read(const std::string& body, Diagnostics& diagnostics) {
    const std::string path = testing::TempDir() + "patinaTest.mtlx";
    std::ofstream(path) << "<?xml version=\"1.0\"?>\n" << body;
    std::vector<Network> networks = readMtlx(path, diagnostics);
    std::remove(path.c_str());
    return networks;
}

const char* const graphDocument = R"(<materialx version="1.39" colorspace="srgb_texture">
  <nodegraph name="NG" fileprefix="maps/">
    <input name="tint" type="color3" value="0.5, 0.5, 0.5" />
    <image name="img" type="color3"><input name="file" type="filename" value="a.png" /></image>
    <multiply name="mul" type="color3">
      <input name="in1" type="color3" nodename="img" />
      <input name="in2" type="color3" interfacename="tint" />
    </multiply>
    <output name="out" type="color3" nodename="mul" />
  </nodegraph>
  <oren_nayar_diffuse_bsdf name="d" type="BSDF">
    <input name="color" type="color3" nodegraph="NG" output="out" />
  </oren_nayar_diffuse_bsdf>
  <surface name="s" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="d" /></surface>
  <surfacematerial name="M" type="material">
    <input name="surfaceshader" type="surfaceshader" nodename="s" />
  </surfacematerial>
</materialx>)";

const char* const nodeDefDocument = R"(<materialx version="1.39">
  <nodedef name="ND_paint" node="paint">
    <input name="shade" type="float" value="0.25" />
    <output name="out" type="surfaceshader" />
  </nodedef>
  <nodegraph name="NG_paint" nodedef="ND_paint">
    <convert name="c" type="color3"><input name="in" type="float" interfacename="shade" /></convert>
    <oren_nayar_diffuse_bsdf name="d" type="BSDF">
      <input name="color" type="color3" nodename="c" />
    </oren_nayar_diffuse_bsdf>
    <surface name="s" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="d" /></surface>
    <output name="out" type="surfaceshader" nodename="s" />
  </nodegraph>
  <paint name="p" type="surfaceshader"><input name="shade" type="float" value="0.75" /></paint>
  <surfacematerial name="M" type="material">
    <input name="surfaceshader" type="surfaceshader" nodename="p" />
  </surfacematerial>
</materialx>)";

glm::vec3 albedoOf(const Network& network) {
    Compiled c(network);
    EXPECT_EQ(c.diagnostics.count(), 0) << warnings(c.diagnostics);
    ShadingPoint point;
    Bsdf bsdf;
    c.program->evaluate(point, bsdf);
    return bsdf.albedo();
}

} // namespace

TEST(Mtlx, GraphsInterfacesAndFilePrefixes) {
    Diagnostics diagnostics;
    const auto networks = read(graphDocument, diagnostics);
    EXPECT_EQ(diagnostics.count(), 0) << warnings(diagnostics);
    ASSERT_EQ(networks.size(), 1u);
    EXPECT_EQ(networks[0].path.substr(networks[0].path.rfind(':')), ":M");
    const NetworkNode* image = networks[0].find("/NG/img");
    ASSERT_NE(image, nullptr);
    EXPECT_EQ(image->id, "ND_image_color3");
    const std::string file = image->inputs.at("file").text;
    EXPECT_EQ(file.substr(file.size() - 10), "maps/a.png");
    EXPECT_EQ(image->inputs.at("file").colorSpace, "srgb_texture");
    // The document's colour space holds for values too: 0.5 in sRGB.
    Compiled c(networks[0]);
    ASSERT_EQ(c.textures.requests.size(), 1u);
    EXPECT_EQ(c.textures.requests[0].colorSpace, "srgb_texture");
    const FakePrimvars primvars(*c.program, {{"st", glm::vec4(1, 1, 0, 0)}});
    ShadingPoint point;
    point.primvars = &primvars;
    Bsdf bsdf;
    c.program->evaluate(point, bsdf);
    EXPECT_NEAR(bsdf.albedo().x, 0.21404f, 1e-4f);
    EXPECT_NEAR(bsdf.albedo().z, 0.5f * 0.21404f, 1e-4f);
}

TEST(Mtlx, NodeDefinitionsOfTheDocument) {
    Diagnostics diagnostics;
    const auto networks = read(nodeDefDocument, diagnostics);
    EXPECT_EQ(diagnostics.count(), 0) << warnings(diagnostics);
    ASSERT_EQ(networks.size(), 1u);
    EXPECT_NEAR(albedoOf(networks[0]).x, 0.75f, 1e-5f);
}

// Two definitions of one category: the types of the inputs say which is meant, and a definition of
// the library that fits better wins over one of the document.
TEST(Mtlx, TheBestFittingDefinitionIsTaken) {
    const auto document = [](const std::string& type, const std::string& value) {
        return R"(<materialx version="1.39">
  <nodedef name="ND_shade_float" node="shade">
    <input name="x" type="float" value="0" /><output name="out" type="color3" />
  </nodedef>
  <nodegraph name="NG_shade_float" nodedef="ND_shade_float">
    <constant name="c" type="color3"><input name="value" type="color3" value="0.25, 0, 0" /></constant>
    <output name="out" type="color3" nodename="c" />
  </nodegraph>
  <nodedef name="ND_shade_color3" node="shade">
    <input name="x" type="color3" value="0, 0, 0" /><output name="out" type="color3" />
  </nodedef>
  <nodegraph name="NG_shade_color3" nodedef="ND_shade_color3">
    <multiply name="c" type="color3"><input name="in1" type="color3" interfacename="x" /></multiply>
    <output name="out" type="color3" nodename="c" />
  </nodegraph>
  <nodedef name="ND_odd_multiply" node="multiply">
    <input name="in1" type="matrix33" /><output name="out" type="color3" />
  </nodedef>
  <nodegraph name="NG_odd_multiply" nodedef="ND_odd_multiply">
    <constant name="c" type="color3" />
    <output name="out" type="color3" nodename="c" />
  </nodegraph>
  <shade name="p" type="color3"><input name="x" type=")" +
               type + "\" value=\"" + value + R"(" /></shade>
  <oren_nayar_diffuse_bsdf name="d" type="BSDF">
    <input name="color" type="color3" nodename="p" />
  </oren_nayar_diffuse_bsdf>
  <surface name="s" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="d" /></surface>
</materialx>)";
    };
    Diagnostics diagnostics;
    auto networks = read(document("float", "0.5"), diagnostics);
    ASSERT_EQ(networks.size(), 1u);
    EXPECT_NEAR(albedoOf(networks[0]).x, 0.25f, 1e-5f);
    networks = read(document("color3", "0.5, 0.75, 0.5"), diagnostics);
    ASSERT_EQ(networks.size(), 1u);
    EXPECT_NEAR(albedoOf(networks[0]).y, 0.75f, 1e-5f);
    EXPECT_EQ(diagnostics.count(), 0) << warnings(diagnostics);
}

TEST(Mtlx, BrokenDocumentsAreReported) {
    for (const char* body : {"", "<materialx", "<other/>", "<materialx><a></materialx>"}) {
        Diagnostics diagnostics;
        EXPECT_TRUE(read(body, diagnostics).empty());
        EXPECT_EQ(diagnostics.count(), 1) << body;
    }
    Diagnostics diagnostics;
    EXPECT_TRUE(readMtlx("/no/such/file.mtlx", diagnostics).empty());
    EXPECT_EQ(diagnostics.count(), 1);
}

TEST(Mtlx, GraphsInACircleEnd) {
    Diagnostics diagnostics;
    const auto networks = read(R"(<materialx version="1.39">
      <nodegraph name="A"><output name="out" type="float" nodegraph="B" output="out"/></nodegraph>
      <nodegraph name="B"><output name="out" type="float" nodegraph="A" output="out"/></nodegraph>
      <surface name="s" type="surfaceshader">
        <input name="opacity" type="float" nodegraph="A" output="out"/></surface>
      <surfacematerial name="M" type="material">
        <input name="surfaceshader" type="surfaceshader" nodename="s" /></surfacematerial>
      </materialx>)",
                               diagnostics);
    ASSERT_EQ(networks.size(), 1u);
    Compiled c(networks[0]);
    EXPECT_TRUE(c.program->isOpaque());
}

TEST(Mtlx, AModelThatContainsItselfEnds) {
    Diagnostics diagnostics;
    const auto networks = read(R"(<materialx version="1.39">
      <nodedef name="ND_self" node="self"><output name="out" type="surfaceshader"/></nodedef>
      <nodegraph name="NG_self" nodedef="ND_self">
        <self name="s" type="surfaceshader"/>
        <output name="out" type="surfaceshader" nodename="s"/></nodegraph>
      <self name="p" type="surfaceshader"/>
      <surfacematerial name="M" type="material">
        <input name="surfaceshader" type="surfaceshader" nodename="p" /></surfacematerial>
      </materialx>)",
                               diagnostics);
    EXPECT_NE(warnings(diagnostics).find("nested too deeply"), std::string::npos);
}

TEST(Mtlx, ExampleDocumentsCompile) {
    const char* assets = std::getenv("PATINA_ASSETS");
    if (!assets) GTEST_SKIP() << "PATINA_ASSETS is not set: no example documents to read";
    namespace fs = std::filesystem;
    int documents = 0;
    for (const auto& entry : fs::recursive_directory_iterator(assets)) {
        if (entry.path().extension() != ".mtlx") continue;
        ++documents;
        Diagnostics diagnostics;
        for (const Network& network : readMtlx(entry.path().string(), diagnostics)) {
            Compiled c(network);
            ASSERT_NE(c.program, nullptr);
            ShadingPoint point;
            point.viewDirection = direction(40.0f);
            Bsdf bsdf;
            c.program->evaluate(point, bsdf);
            const glm::vec3 a = bsdf.albedo();
            EXPECT_TRUE(a.x >= 0.0f && a.x <= 1.01f) << entry.path() << " " << a.x;
        }
    }
    EXPECT_GT(documents, 0);
}

} // namespace patina
