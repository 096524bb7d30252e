// SPDX-License-Identifier: Apache-2.0
// What a document defines itself: nodes, versions of them, tokens, geometric properties, units.
#include "materialNetwork/tests/mtlxFixture.h"

namespace patina {

namespace {

const std::string version139 = "1.39";

glm::vec3 light(const std::string& body, ShadingPoint point = {},
                std::map<std::string, glm::vec4> primvars = {}) {
    return lightOf(body, point, std::move(primvars), version139);
}

/// A definition whose colour is a constant.
std::string constantNode(const std::string& attributes, const std::string& color) {
    static int count = 0;
    const std::string name = "ND_c" + std::to_string(++count);
    return "<nodedef name=\"" + name + "\" node=\"shade\" " + attributes +
           "><output name=\"out\" type=\"color3\" /></nodedef><nodegraph name=\"G" + name +
           "\" nodedef=\"" + name +
           "\"><constant name=\"c\" type=\"color3\"><input name=\"value\" type=\"color3\" "
           "value=\"" +
           color +
           "\" /></constant><output name=\"out\" type=\"color3\" nodename=\"c\" /></nodegraph>";
}

} // namespace

TEST(MtlxDefinitions, InheritInputsAndOutputs) {
    const std::string defs = R"(
      <nodedef name="ND_parent" node="parent">
        <input name="a" type="color3" value="0.5, 0, 0" />
        <input name="b" type="color3" value="0, 0, 0.25" /><output name="out" type="color3" />
      </nodedef>
      <nodedef name="ND_child" node="child" inherit="ND_parent">
        <input name="b" type="color3" value="0, 0.75, 0" /></nodedef>
      <nodegraph name="G" nodedef="ND_child">
        <add name="sum" type="color3"><input name="in1" type="color3" interfacename="a" />
          <input name="in2" type="color3" interfacename="b" /></add>
        <output name="out" type="color3" nodename="sum" /></nodegraph>)";
    expectVector(light(defs + R"(<child name="p" type="color3" />)"), 0.5f, 0.75f, 0);
    expectVector(light(defs + R"(<child name="p" type="color3">
        <input name="a" type="color3" value="0, 0, 1" /></child>)"),
                 0, 0.75f, 1);
}

TEST(MtlxDefinitions, CirclesOfInheritanceEnd) {
    Diagnostics diagnostics;
    readBody(R"(<nodedef name="A" node="a" inherit="B"><output name="out" type="float" /></nodedef>
      <nodedef name="B" node="b" inherit="A" /><nodegraph name="G" nodedef="A" />
      <nodedef name="C" node="c" inherit="nobody"><output name="out" type="float" /></nodedef>
      <nodegraph name="H" nodedef="C" />)",
             diagnostics, version139);
    EXPECT_EQ(diagnostics.count(), 2) << warnings(diagnostics);
}

TEST(MtlxDefinitions, Versions) {
    const std::string two = constantNode("version=\"1.0\"", "1, 0, 0") +
                            constantNode("version=\"2.0\" isdefaultversion=\"true\"", "0, 1, 0") +
                            constantNode("version=\"3.0\"", "0, 0, 1");
    expectVector(light(two + R"(<shade name="p" type="color3" />)"), 0, 1, 0);
    expectVector(light(two + R"(<shade name="p" type="color3" version="1.0" />)"), 1, 0, 0);
    expectVector(light(two + R"(<shade name="p" type="color3" version="3.0" />)"), 0, 0, 1);
    Diagnostics diagnostics;
    readBody(two + R"(<shade name="p" type="color3" version="4.0" />)", diagnostics, version139);
    EXPECT_EQ(diagnostics.count(), 1) << warnings(diagnostics);
}

TEST(MtlxDefinitions, GeometricPropertiesOfGraphsAndDocuments) {
    ShadingPoint point;
    point.objectPosition = {0.1f, 0.2f, 0.3f};
    const std::string graph = R"(<nodegraph name="g">
        <input name="uv" type="vector2" defaultgeomprop="UV0" />
        <separate2 name="s2" type="multioutput">
          <input name="in" type="vector2" interfacename="uv" /></separate2>
        <combine3 name="c" type="color3"><input name="in1" type="float" nodename="s2" output="outx" />
          <input name="in2" type="float" nodename="s2" output="outy" /></combine3>
        <output name="o" type="color3" nodename="c" /></nodegraph>
      <dot name="p" type="color3"><input name="in" type="color3" nodegraph="g" output="only" /></dot>)";
    expectVector(light(graph, point, {{"st", {0.25f, 0.75f, 0, 0}}}), 0.25f, 0.75f, 0);

    const auto defaultsTo = [&](const std::string& def, const std::string& type) {
        return light(def + "<nodedef name=\"ND_w\" node=\"where\"><input name=\"x\" type=\"" +
                         type +
                         "\" defaultgeomprop=\"mine\" /><output name=\"out\" type=\"color3\" />"
                         "</nodedef><nodegraph name=\"G\" nodedef=\"ND_w\"><convert name=\"c\" "
                         "type=\"color3\"><input name=\"in\" type=\"" +
                         type +
                         "\" interfacename=\"x\" /></convert><output name=\"out\" type=\"color3\" "
                         "nodename=\"c\" /></nodegraph><where name=\"p\" type=\"color3\" />",
                     point, {{"st1", {0.5f, 0.125f, 0, 0}}, {"mine", {0.7f, 0.7f, 0.7f, 0}}});
    };
    expectVector(defaultsTo(R"(<geompropdef name="mine" type="vector3" geomprop="position"
        space="object" />)",
                            "vector3"),
                 0.1f, 0.2f, 0.3f);
    expectVector(defaultsTo(R"(<geompropdef name="mine" type="vector3" geomprop="texcoord"
        index="1" />)",
                            "vector3"),
                 0.5f, 0.125f, 0);
    expectVector(defaultsTo(R"(<geompropdef name="mine" type="float" />)", "float"), 0.7f, 0.7f,
                 0.7f);
    Diagnostics diagnostics;
    readBody(R"(<geompropdef name="mine" type="float" geomprop="smell" />)", diagnostics,
             version139);
    EXPECT_EQ(diagnostics.count(), 1) << warnings(diagnostics);
}

TEST(MtlxDefinitions, TokensInFileNames) {
    const auto filesOf = [](const std::string& body) {
        Diagnostics diagnostics;
        const auto networks = readBody(body + R"(
          <surface_unlit name="s" type="surfaceshader">
            <input name="emission_color" type="color3" nodename="p" /></surface_unlit>)",
                                       diagnostics, version139);
        EXPECT_EQ(diagnostics.count(), 0) << warnings(diagnostics);
        Compiled c(networks.at(0));
        std::vector<std::string> names;
        for (const TextureRequest& request : c.textures.requests)
            names.push_back(std::filesystem::path(request.file).filename().string());
        return names;
    };
    using Names = std::vector<std::string>;
    // Of the document and of the node itself; what nobody knows stays.
    EXPECT_EQ(filesOf(R"(<token name="kind" type="string" value="wood" />
      <image name="p" type="color3"><token name="n" type="integer" value="7" />
        <input name="file" type="filename" value="[kind]_[n]_[x].png" /></image>)"),
              Names{"wood_7_[x].png"});
    // Of a definition, which its instance may replace, through two levels.
    const std::string defs = R"(
      <nodedef name="ND_inner" node="inner"><token name="i" type="string" value="none" />
        <output name="out" type="color3" /></nodedef>
      <nodegraph name="GI" nodedef="ND_inner"><image name="m" type="color3">
          <input name="file" type="filename" value="[i].<UDIM>.png" /></image>
        <output name="out" type="color3" nodename="m" /></nodegraph>
      <nodedef name="ND_outer" node="outer"><token name="o" type="string" value="oak" />
        <output name="out" type="color3" /></nodedef>
      <nodegraph name="GO" nodedef="ND_outer"><inner name="k" type="color3">
          <token name="i" type="string" value="big_[o]" /></inner>
        <output name="out" type="color3" nodename="k" /></nodegraph>)";
    const auto escaped = [](std::string text) {
        text.replace(text.find("<UDIM>"), 6, "&lt;UDIM&gt;");
        return text;
    };
    EXPECT_EQ(filesOf(escaped(defs) + R"(<inner name="p" type="color3" />)"),
              Names{"none.<UDIM>.png"});
    EXPECT_EQ(filesOf(escaped(defs) + R"(<outer name="p" type="color3" />)"),
              Names{"big_oak.<UDIM>.png"});
    EXPECT_EQ(filesOf(escaped(defs) + R"(<outer name="p" type="color3">
        <token name="o" type="string" value="ash" /></outer>)"),
              Names{"big_ash.<UDIM>.png"});
    // An heir has the tokens of what it inherits from.
    const std::string heir = R"(<nodedef name="ND_heir" node="heir" inherit="ND_inner" />
      <nodegraph name="GH" nodedef="ND_heir"><image name="m" type="color3">
          <input name="file" type="filename" value="[i].png" /></image>
        <output name="out" type="color3" nodename="m" /></nodegraph>)";
    EXPECT_EQ(filesOf(escaped(defs) + heir + R"(<heir name="p" type="color3">
        <token name="i" type="string" value="elm" /></heir>)"),
              Names{"elm.png"});
}

TEST(MtlxDefinitions, Units) {
    const auto measured = [](const std::string& attributes, double metersPerUnit) {
        const Documents documents("patinaUnits");
        documents.write("a.mtlx", R"(<materialx version="1.39">
          <unitdef name="U" unittype="distance"><unit name="span" scale="0.2" /></unitdef>
          <constant name="p" type="float"><input name="value" type="float" )" +
                                      attributes + R"( /></constant>
          <surface_unlit name="s" type="surfaceshader">
            <input name="emission" type="float" nodename="p" /></surface_unlit></materialx>)");
        Diagnostics diagnostics;
        return emitted(documents.read("a.mtlx", diagnostics, metersPerUnit).at(0)).x;
    };
    const char* const inches = R"(value="10" unit="inch" unittype="distance")";
    EXPECT_FLOAT_EQ(measured(inches, 1.0), 0.254f);
    EXPECT_FLOAT_EQ(measured(inches, 0.01), 25.4f);
    EXPECT_FLOAT_EQ(measured(R"(value="3" unit="span" unittype="distance")", 1.0), 0.6f);
    EXPECT_FLOAT_EQ(measured(R"(value="1" unit="radian" unittype="angle")", 1.0), 57.29578f);
    EXPECT_FLOAT_EQ(measured(R"(value="10")", 0.01), 10.0f);
}

TEST(MtlxDefinitions, UnitsOfInputsThatHaveTheirOwn) {
    Diagnostics diagnostics;
    const auto networks = readBody(R"(
      <conductor_bsdf name="c" type="BSDF">
        <input name="thinfilm_thickness" type="float" value="0.4" unit="micron" unittype="distance" />
      </conductor_bsdf>
      <nodedef name="ND_bent" node="bent"><input name="by" type="float" value="0.5" unit="radian"
          unittype="angle" /><output name="out" type="vector2" /></nodedef>
      <nodegraph name="G" nodedef="ND_bent"><rotate2d name="r" type="vector2">
          <input name="amount" type="float" interfacename="by" /></rotate2d>
        <output name="out" type="vector2" nodename="r" /></nodegraph>
      <bent name="half" type="vector2" /><bent name="one" type="vector2">
        <input name="by" type="float" value="1" /></bent>
      <dotproduct name="d" type="float"><input name="in1" type="vector2" nodename="half" />
        <input name="in2" type="vector2" nodename="one" /></dotproduct>
      <surface name="s" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="c" />
        <input name="opacity" type="float" nodename="d" /></surface>
      <constant name="odd" type="float"><input name="value" type="float" value="2" unit="stone"
          unittype="mass" /></constant>)",
                                   diagnostics, version139);
    EXPECT_EQ(diagnostics.count(), 1) << warnings(diagnostics); // of the stone
    ASSERT_EQ(networks.size(), 1u);
    EXPECT_FLOAT_EQ(networks[0].find("/c")->inputs.at("thinfilm_thickness").numbers[0], 400.0f);
    EXPECT_FLOAT_EQ(networks[0].find("/half/r")->inputs.at("amount").numbers[0], 28.64789f);
    EXPECT_FLOAT_EQ(networks[0].find("/one/r")->inputs.at("amount").numbers[0], 57.29578f);
}

} // namespace patina
