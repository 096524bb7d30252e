// SPDX-License-Identifier: Apache-2.0
// What a document defines itself: nodes, versions of them, tokens, geometric properties, units.
#include "materialNetwork/tests/mtlxFixture.h"

using namespace patina;

using DocumentDefinitions = MtlxTest;

TEST_F(DocumentDefinitions, InheritInputsAndOutputs) {
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
    expectVector(lightOf(defs + R"(<child name="p" type="color3" />)"), 0.5f, 0.75f, 0);
    expectVector(lightOf(defs + R"(<child name="p" type="color3">
        <input name="a" type="color3" value="0, 0, 1" /></child>)"),
                 0, 0.75f, 1);
}

TEST_F(DocumentDefinitions, CirclesOfInheritanceEnd) {
    read(R"(<nodedef name="A" node="a" inherit="B"><output name="out" type="float" /></nodedef>
      <nodedef name="B" node="b" inherit="A" /><nodegraph name="G" nodedef="A" />
      <nodedef name="C" node="c" inherit="nobody"><output name="out" type="float" /></nodedef>
      <nodegraph name="H" nodedef="C" />)");
    EXPECT_EQ(diagnostics.count(), 2) << warnings(diagnostics);
}

TEST_F(DocumentDefinitions, MaterialsOfOldDocumentsAreTold) {
    EXPECT_TRUE(read(R"(<material name="gold"><shaderref name="s" node="standard_surface">
        <bindinput name="metalness" type="float" value="1" /></shaderref></material>)")
                    .empty());
    EXPECT_TRUE(reported("up to 1.37"));
}

TEST_F(DocumentDefinitions, MaterialsAndNodesInherit) {
    const std::string base = R"(
      <surface_unlit name="S" type="surfaceshader">
        <input name="emission_color" type="color3" value="0.3, 0.2, 0.1" />
        <input name="emission" type="float" value="0.5" /></surface_unlit>
      <surface_unlit name="T" type="surfaceshader" inherit="S">
        <input name="emission" type="float" value="2" /></surface_unlit>
      <surfacematerial name="B" type="material">
        <input name="surfaceshader" type="surfaceshader" nodename="S" /></surfacematerial>
      <surfacematerial name="M" type="material" inherit="B"/>
      <surfacematerial name="N" type="material" inherit="M">
        <input name="surfaceshader" type="surfaceshader" nodename="T" /></surfacematerial>)";
    const auto lightOfMaterial = [&](const std::string& name) {
        for (const Network& network : read(base))
            if (network.path.find(":" + name) != std::string::npos) return emitted(network);
        return glm::vec3(-1);
    };
    expectVector(lightOfMaterial("B"), 0.15f, 0.1f, 0.05f);
    expectVector(lightOfMaterial("M"), 0.15f, 0.1f, 0.05f);
    expectVector(lightOfMaterial("N"), 0.6f, 0.4f, 0.2f);
    // Nodes of a graph inherit from those of the document.
    expectVector(lightOf(R"(
      <constant name="dim" type="color3"><input name="value" type="color3" value="0.5, 0.25, 1" />
        </constant>
      <nodegraph name="G"><constant name="c" type="color3" inherit="dim" />
        <output name="out" type="color3" nodename="c" /></nodegraph>
      <dot name="p" type="color3"><input name="in" type="color3" nodegraph="G" /></dot>)"),
                 0.5f, 0.25f, 1);
    EXPECT_TRUE(nothingTold(diagnostics));
    read(R"(<surfacematerial name="M" type="material" inherit="nobody" />
      <surfacematerial name="A" type="material" inherit="B" />
      <surfacematerial name="B" type="material" inherit="A" />)");
    EXPECT_TRUE(reported("'nobody'"));
}

TEST_F(DocumentDefinitions, OutputsOfTheDocument) {
    const std::string outputs = constantOf("c", "color3", "0.3, 0.2, 0.1") + R"(
      <output name="o" type="color3" nodename="c" /><output name="again" type="color3" output="o" />
      <output name="circle" type="color3" output="circle" />)";
    const auto through = [&](const std::string& output) {
        return lightOf(outputs + R"(<constant name="p" type="color3">
            <input name="value" type="color3" output=")" +
                       output + R"(" /></constant>)");
    };
    expectVector(through("o"), 0.3f, 0.2f, 0.1f);
    expectVector(through("again"), 0.3f, 0.2f, 0.1f);
    expectVector(through("circle"), 0, 0, 0);
    read(outputs + R"(<constant name="d" type="color3">
        <input name="value" type="color3" output="nobody" /></constant>)");
    EXPECT_TRUE(reported("no output 'nobody'"));
}

TEST_F(DocumentDefinitions, Versions) {
    const auto version = [](const std::string& number, const std::string& color,
                            const std::string& more = "") {
        return definition("c" + number, "shade", "", constantOf("c", "color3", color), "color3",
                          "version='" + number + ".0'" + more);
    };
    const std::string all = version("1", "1, 0, 0") +
                            version("2", "0, 1, 0", " isdefaultversion='true'") +
                            version("3", "0, 0, 1");
    expectVector(lightOf(all + R"(<shade name="p" type="color3" />)"), 0, 1, 0);
    expectVector(lightOf(all + R"(<shade name="p" type="color3" version="1.0" />)"), 1, 0, 0);
    expectVector(lightOf(all + R"(<shade name="p" type="color3" version="3.0" />)"), 0, 0, 1);
    read(all + R"(<shade name="p" type="color3" version="4.0" />)");
    EXPECT_EQ(diagnostics.count(), 1) << warnings(diagnostics);
}

TEST_F(DocumentDefinitions, GeometricPropertiesOfGraphsAndDocuments) {
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
    expectVector(lightOf(graph, point, {{"st", {0.25f, 0.75f, 0, 0}}}), 0.25f, 0.75f, 0);

    const auto defaultsTo = [&](const std::string& property, const std::string& type) {
        return lightOf(
            "<geompropdef name='mine' type='" + type + "' " + property + "/>" +
                definition("w", "where",
                           "<input name='x' type='" + type + "' defaultgeomprop='mine'/>",
                           "<convert name='c' type='color3'><input name='in' type='" + type +
                               "' interfacename='x'/></convert>") +
                "<where name='p' type='color3'/>",
            point, {{"st1", {0.5f, 0.125f, 0, 0}}, {"mine", {0.7f, 0.7f, 0.7f, 0}}});
    };
    expectVector(defaultsTo("geomprop='position' space='object'", "vector3"), point.objectPosition);
    expectVector(defaultsTo("geomprop='texcoord' index='1'", "vector3"), 0.5f, 0.125f, 0);
    expectVector(defaultsTo("", "float"), glm::vec3(0.7f));
    read(R"(<geompropdef name="mine" type="float" geomprop="smell" />)");
    EXPECT_EQ(diagnostics.count(), 1) << warnings(diagnostics);
}

TEST_F(DocumentDefinitions, TokensInFileNames) {
    const auto filesOf = [](const std::string& body) {
        const Compiled c(readOne(body + "<surface_unlit name='s' type='surfaceshader'>" +
                                 inputFrom("emission_color", "color3", "p") + "</surface_unlit>"));
        std::string names;
        for (const TextureRequest& request : c.textures.requests)
            names += std::filesystem::path(request.file).filename().string() + " ";
        return names;
    };
    const auto image = [](const std::string& name, const std::string& file,
                          const std::string& token = "") {
        return "<image name='" + name + "' type='color3'>" + token +
               inputOf("file", "filename", file) + "</image>";
    };
    const auto token = [](const std::string& name, const std::string& value) {
        return "<token name='" + name + "' type='string' value='" + value + "'/>";
    };
    // Of the document and of the node itself; what nobody knows stays.
    EXPECT_EQ(filesOf(token("kind", "wood") + image("p", "[kind]_[n]_[x].png",
                                                    "<token name='n' type='integer' value='7'/>")),
              "wood_7_[x].png ");
    // Of a definition, which its instance may replace, through two levels.
    const std::string defs =
        definition("inner", "inner", token("i", "none"), image("c", "[i].&lt;UDIM&gt;.png")) +
        definition("outer", "outer", token("o", "oak"),
                   "<inner name='c' type='color3'>" + token("i", "big_[o]") + "</inner>");
    EXPECT_EQ(filesOf(defs + "<inner name='p' type='color3'/>"), "none.<UDIM>.png ");
    EXPECT_EQ(filesOf(defs + "<outer name='p' type='color3'/>"), "big_oak.<UDIM>.png ");
    EXPECT_EQ(filesOf(defs + "<outer name='p' type='color3'>" + token("o", "ash") + "</outer>"),
              "big_ash.<UDIM>.png ");
    // An heir has the tokens of what it inherits from.
    const std::string heir = "<nodedef name='ND_heir' node='heir' inherit='ND_inner'/>"
                             "<nodegraph name='GH' nodedef='ND_heir'>" +
                             image("m", "[i].png") +
                             "<output name='out' type='color3' nodename='m'/></nodegraph>";
    EXPECT_EQ(
        filesOf(defs + heir + "<heir name='p' type='color3'>" + token("i", "elm") + "</heir>"),
        "elm.png ");
}

TEST_F(DocumentDefinitions, Units) {
    const auto measured = [&](const std::string& attributes, double metersPerUnit) {
        documents.write("a.mtlx",
                        R"(
          <unitdef name="U" unittype="distance"><unit name="span" scale="0.2" /></unitdef>
          <constant name="p" type="float"><input name="value" type="float" )" +
                            attributes +
                            " /></constant><surface_unlit name='s' type='surfaceshader'>" +
                            inputFrom("emission", "float", "p") + "</surface_unlit>");
        return emitted(documents.read("a.mtlx", diagnostics, metersPerUnit).at(0)).x;
    };
    const char* const inches = R"(value="10" unit="inch" unittype="distance")";
    EXPECT_FLOAT_EQ(measured(inches, 1.0), 0.254f);
    EXPECT_FLOAT_EQ(measured(inches, 0.01), 25.4f);
    EXPECT_FLOAT_EQ(measured(R"(value="3" unit="span" unittype="distance")", 1.0), 0.6f);
    EXPECT_FLOAT_EQ(measured(R"(value="1" unit="radian" unittype="angle")", 1.0), 57.29578f);
    EXPECT_FLOAT_EQ(measured(R"(value="10")", 0.01), 10.0f);
}

TEST_F(DocumentDefinitions, UnitsOfInputsThatHaveTheirOwn) {
    const auto networks = read(R"(
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
          unittype="mass" /></constant>)");
    EXPECT_EQ(diagnostics.count(), 1) << warnings(diagnostics); // of the stone
    ASSERT_EQ(networks.size(), 1u);
    EXPECT_FLOAT_EQ(networks[0].find("/c")->inputs.at("thinfilm_thickness").numbers[0], 400.0f);
    EXPECT_FLOAT_EQ(networks[0].find("/half/r")->inputs.at("amount").numbers[0], 28.64789f);
    EXPECT_FLOAT_EQ(networks[0].find("/one/r")->inputs.at("amount").numbers[0], 57.29578f);
}
