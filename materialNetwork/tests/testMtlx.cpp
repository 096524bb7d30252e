// SPDX-License-Identifier: Apache-2.0
// MaterialX documents.
#include "materialNetwork/tests/mtlxFixture.h"

#include <cstdlib>

using namespace patina;

using Mtlx = MtlxTest;

TEST_F(Mtlx, GraphsInterfacesAndFilePrefixes) {
    const auto networks = read(R"(
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
  </oren_nayar_diffuse_bsdf>)" + surfaceOfBsdf("d") +
                                   materialOf("s"),
                               version139 + " colorspace='srgb_texture'");
    EXPECT_TRUE(nothingTold(diagnostics));
    ASSERT_EQ(networks.size(), 1u);
    EXPECT_EQ(networks[0].path.substr(networks[0].path.rfind(':')), ":M");
    const NetworkNode* image = networks[0].find("/NG/img");
    ASSERT_NE(image, nullptr);
    EXPECT_EQ(image->id, "ND_image_color3");
    const std::string file = image->inputs.at("file").text;
    EXPECT_EQ(file.substr(file.size() - 10), "maps/a.png");
    EXPECT_EQ(image->inputs.at("file").colorSpace, "srgb_texture");
    // The document's colour space holds for values too: 0.5 in sRGB.
    const Compiled c(networks[0]);
    ASSERT_EQ(c.textures.requests.size(), 1u);
    EXPECT_EQ(c.textures.requests[0].colorSpace, "srgb_texture");
    const glm::vec3 albedo =
        c.lobes(PointWith(*c.program, {{"st", glm::vec4(1, 1, 0, 0)}})).albedo();
    EXPECT_NEAR(albedo.x, 0.21404f, 1e-4f);
    EXPECT_NEAR(albedo.z, 0.5f * 0.21404f, 1e-4f);
}

TEST_F(Mtlx, NodeDefinitionsOfTheDocument) {
    const Network network = readOne(R"(
  <nodedef name="ND_paint" node="paint">
    <input name="shade" type="float" value="0.25" />
    <output name="out" type="surfaceshader" />
  </nodedef>
  <nodegraph name="NG_paint" nodedef="ND_paint">
    <convert name="c" type="color3"><input name="in" type="float" interfacename="shade" /></convert>
    )" + surfaceOfColor("c") + R"(
    <output name="out" type="surfaceshader" nodename="s" />
  </nodegraph>
  <paint name="p" type="surfaceshader"><input name="shade" type="float" value="0.75" /></paint>)" +
                                    materialOf("p"));
    EXPECT_NEAR(albedoOf(network).x, 0.75f, 1e-5f);
}

// Two definitions of one category: the types of the inputs say which is meant, and a definition of
// the library that fits better wins over one of the document.
TEST_F(Mtlx, TheBestFittingDefinitionIsTaken) {
    const auto albedo = [](const std::string& type, const std::string& value) {
        return albedoOf(readOne(
            definition("shade_float", "shade", inputOf("x", "float", "0"),
                       constantOf("c", "color3", "0.25, 0, 0")) +
            definition("shade_color3", "shade", inputOf("x", "color3", "0, 0, 0"),
                       R"(<multiply name="c" type="color3">
                         <input name="in1" type="color3" interfacename="x" /></multiply>)") +
            definition("odd_multiply", "multiply", R"(<input name="in1" type="matrix33" />)",
                       R"(<constant name="c" type="color3" />)") +
            "<shade name='p' type='color3'>" + inputOf("x", type, value) + "</shade>" +
            surfaceOfColor("p")));
    };
    EXPECT_NEAR(albedo("float", "0.5").x, 0.25f, 1e-5f);
    EXPECT_NEAR(albedo("color3", "0.5, 0.75, 0.5").y, 0.75f, 1e-5f);
}

TEST_F(Mtlx, BrokenDocumentsAreReported) {
    for (const char* text : {"", "<materialx", "<other/>", "<materialx><a></materialx>"}) {
        Diagnostics found;
        documents.writeText("broken.mtlx", text);
        EXPECT_TRUE(documents.read("broken.mtlx", found).empty());
        EXPECT_EQ(found.count(), 1) << text;
    }
    EXPECT_TRUE(readMtlx("/no/such/file.mtlx", diagnostics).empty());
    EXPECT_EQ(diagnostics.count(), 1);
}

TEST_F(Mtlx, GraphsInACircleEnd) {
    const auto networks = read(R"(
      <nodegraph name="A"><output name="out" type="float" nodegraph="B" output="out"/></nodegraph>
      <nodegraph name="B"><output name="out" type="float" nodegraph="A" output="out"/></nodegraph>
      <surface name="s" type="surfaceshader">
        <input name="opacity" type="float" nodegraph="A" output="out"/></surface>)" +
                               materialOf("s"));
    ASSERT_EQ(networks.size(), 1u);
    EXPECT_TRUE(Compiled(networks[0])->isOpaque());
}

TEST_F(Mtlx, AModelThatContainsItselfEnds) {
    read(R"(
      <nodedef name="ND_self" node="self"><output name="out" type="surfaceshader"/></nodedef>
      <nodegraph name="NG_self" nodedef="ND_self">
        <self name="s" type="surfaceshader"/>
        <output name="out" type="surfaceshader" nodename="s"/></nodegraph>
      <self name="p" type="surfaceshader"/>)" +
         materialOf("p"));
    EXPECT_TRUE(reported("nested too deeply"));
}

TEST_F(Mtlx, ExampleDocumentsCompile) {
    const char* assets = std::getenv("PATINA_ASSETS");
    if (!assets) GTEST_SKIP() << "PATINA_ASSETS is not set: no example documents to read";
    namespace fs = std::filesystem;
    int count = 0;
    for (const auto& entry : fs::recursive_directory_iterator(assets)) {
        if (entry.path().extension() != ".mtlx") continue;
        ++count;
        for (const Network& network : readMtlx(entry.path().string(), diagnostics)) {
            const Compiled c(network);
            ASSERT_NE(c.program, nullptr);
            const glm::vec3 a = c.albedo(direction(40.0f));
            EXPECT_TRUE(a.x >= 0.0f && a.x <= 1.01f) << entry.path() << " " << a.x;
        }
    }
    EXPECT_GT(count, 0);
}
