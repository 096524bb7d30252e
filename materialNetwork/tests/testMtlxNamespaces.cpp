// SPDX-License-Identifier: Apache-2.0
// Namespaces of MaterialX documents.
#include "materialNetwork/tests/materialFixture.h"

#include "materialNetwork/mtlx/document.h"

#include <filesystem>
#include <fstream>

#include <stdlib.h>

namespace patina {

namespace {

class MtlxNamespaces : public testing::Test {
protected:
    void SetUp() override {
        std::string pattern = testing::TempDir() + "patinaSpacesXXXXXX";
        ASSERT_NE(::mkdtemp(&pattern[0]), nullptr);
        folder = pattern + "/";
    }
    void TearDown() override { std::filesystem::remove_all(folder); }

    std::vector<Network> read(const std::string& body, const std::string& attributes = "") {
        write("main.mtlx", body, attributes);
        return readMtlx(folder + "main.mtlx", diagnostics);
    }
    void write(const std::string& name, const std::string& body,
               const std::string& attributes = "") {
        std::ofstream(folder + name)
            << "<materialx version=\"1.39\" " << attributes << ">" << body << "</materialx>";
    }

    std::string folder;
    Diagnostics diagnostics;
};

/// A definition that is 0.75 everywhere.
std::string definition(const std::string& ofDef, const std::string& ofGraph,
                       const std::string& reference) {
    return "<nodedef name='ND_toon' node='toon_shade' " + ofDef +
           "><input name='x' type='float' value='0'/><output name='out' type='color3'/></nodedef>"
           "<nodegraph name='NG_toon' nodedef='" +
           reference + "' " + ofGraph +
           "><constant name='c' type='color3'><input name='value' type='color3' "
           "value='.75,.75,.75'/>"
           "</constant><output name='out' type='color3' nodename='c'/></nodegraph>";
}

std::string use(const std::string& category, const std::string& attributes = "") {
    return "<" + category + " name='t' type='color3' " + attributes +
           "/><oren_nayar_diffuse_bsdf name='d' type='BSDF'>"
           "<input name='color' type='color3' nodename='t'/></oren_nayar_diffuse_bsdf>"
           "<surface name='s' type='surfaceshader'><input name='bsdf' type='BSDF' nodename='d'/>"
           "</surface><surfacematerial name='M' type='material'>"
           "<input name='surfaceshader' type='surfaceshader' nodename='s'/></surfacematerial>";
}

float albedoOf(const Network& network) {
    const Compiled c(network);
    EXPECT_EQ(c.diagnostics.count(), 0) << warnings(c.diagnostics);
    ShadingPoint point;
    Bsdf bsdf;
    c.program->evaluate(point, bsdf);
    return bsdf.albedo().x;
}

} // namespace

// The elements that MaterialX's own library finds in these documents.
TEST_F(MtlxNamespaces, DefinitionsAreFoundByTheirQualifiedNames) {
    const std::string space = "namespace='npr_test'";
    for (const std::string& reference : {std::string("ND_toon"), std::string("npr_test:ND_toon")})
        for (const std::string& ofGraph : {space, std::string()}) {
            const auto networks =
                read(definition(space, ofGraph, reference) + use("npr_test:toon_shade"));
            ASSERT_EQ(networks.size(), 1u);
            EXPECT_NEAR(albedoOf(networks[0]), 0.75f, 1e-5f) << reference << " " << ofGraph;
        }
    // In a document of that namespace the short name means the same.
    for (const char* category : {"npr_test:toon_shade", "toon_shade"}) {
        const auto networks = read(definition("", "", "ND_toon") + use(category), space);
        ASSERT_EQ(networks.size(), 1u);
        EXPECT_NEAR(albedoOf(networks[0]), 0.75f, 1e-5f) << category;
    }
    for (const char* name : {"ND_toon", "npr_test:ND_toon"}) {
        const auto networks =
            read(definition(space, space, "ND_toon") +
                 use("npr_test:toon_shade", std::string("nodedef='") + name + "'"));
        ASSERT_EQ(networks.size(), 1u);
        EXPECT_NEAR(albedoOf(networks[0]), 0.75f, 1e-5f) << name;
    }
    EXPECT_EQ(diagnostics.count(), 0) << warnings(diagnostics);
}

TEST_F(MtlxNamespaces, OtherNamespacesAreNotMeant) {
    const std::string space = "namespace='npr_test'";
    for (const char* category : {"toon_shade", "other:toon_shade"}) {
        const auto networks = read(definition(space, space, "ND_toon") + use(category));
        ASSERT_EQ(networks.size(), 1u);
        const Compiled c(networks[0]);
        const std::string reported = warnings(c.diagnostics);
        EXPECT_NE(reported.find(std::string("unknown type '") + category + "'"), std::string::npos)
            << reported;
    }
    // Two definitions of one name in two namespaces.
    std::string other = definition("namespace='b'", "namespace='b'", "ND_b");
    other.replace(other.find("ND_toon"), 7, "ND_b");
    other.replace(other.find("NG_toon"), 7, "NG_b");
    other.replace(other.find(".75,.75,.75"), 11, ".25,.25,.25");
    auto networks = read(definition(space, space, "ND_toon") + other + use("b:toon_shade"));
    EXPECT_NEAR(albedoOf(networks.at(0)), 0.25f, 1e-5f);
    networks = read(definition(space, space, "ND_toon") + other + use("npr_test:toon_shade"));
    EXPECT_NEAR(albedoOf(networks.at(0)), 0.75f, 1e-5f);
}

// All names of two namespaces are alike: of definitions, of graphs that implementations give them,
// and of graphs that stand for themselves.
TEST_F(MtlxNamespaces, TheSameNamesInTwoNamespacesAreTold) {
    const auto in = [](const std::string& space, const std::string& value) {
        const std::string own = "namespace='" + space + "'";
        const std::string number = "<input name='value' type='color3' value='" + value + "'/>";
        return "<nodedef name='ND_toon' node='toon_shade' " + own +
               "><input name='x' type='color3' value='" + value +
               "'/><output name='out' type='color3'/></nodedef>"
               "<implementation name='I_toon' nodedef='ND_toon' nodegraph='" +
               space + ":NG_toon' " + own + "/><nodegraph name='NG_toon' " + own +
               "><constant name='c' type='color3'><input name='value' type='color3' "
               "interfacename='x'/></constant><output name='out' type='color3' nodename='c'/>"
               "</nodegraph><nodegraph name='G' " +
               own + "><constant name='c' type='color3'>" + number +
               "</constant><output name='out' type='color3' nodename='c'/></nodegraph>";
    };
    const std::string both = in("a", ".75,.75,.75") + in("b", ".25,.25,.25");
    EXPECT_NEAR(albedoOf(read(both + use("a:toon_shade")).at(0)), 0.75f, 1e-5f);
    EXPECT_NEAR(albedoOf(read(both + use("b:toon_shade")).at(0)), 0.25f, 1e-5f);
    for (const auto& [space, expected] : {std::pair{"a", 0.75f}, std::pair{"b", 0.25f}}) {
        std::string body = both + use("constant");
        const std::string node = "<constant name='t' type='color3' />";
        body.replace(body.find(node), node.size(),
                     "<constant name='t' type='color3'><input name='value' type='color3' "
                     "nodegraph='" +
                         std::string(space) + ":G' output='out'/></constant>");
        EXPECT_NEAR(albedoOf(read(body).at(0)), expected, 1e-5f) << space;
    }
    EXPECT_EQ(diagnostics.count(), 0) << warnings(diagnostics);
}

TEST_F(MtlxNamespaces, AnIncludedDocumentKeepsItsNamesApart) {
    write(
        "library.mtlx",
        definition("", "", "ND_toon") +
            "<constant name='k' type='color3'><input name='value' type='color3' value='.5,.5,.5'/>"
            "</constant>"
            "<nodegraph name='G'><multiply name='q' type='color3'>"
            "<input name='in1' type='color3' value='.5,.5,.5'/></multiply>"
            "<output name='out' type='color3' nodename='q'/></nodegraph>"
            "<multiply name='m' type='color3'><input name='in1' type='color3' nodename='k'/>"
            "<input name='in2' type='color3' nodegraph='G' output='out'/></multiply>",
        "namespace='lib'");
    const std::string include = "<xi:include href='library.mtlx'/>"
                                "<constant name='k' type='color3'/>"; // another one
    EXPECT_NEAR(albedoOf(read(include + use("lib:toon_shade")).at(0)), 0.75f, 1e-5f);
    const auto product = [&](const std::string& inputs) {
        std::string body = include + use("multiply");
        body.replace(body.find("<multiply name='t' type='color3' />"), 35,
                     "<multiply name='t' type='color3'>" + inputs + "</multiply>");
        return albedoOf(read(body).at(0));
    };
    EXPECT_NEAR(product("<input name='in1' type='color3' nodename='lib:k'/>"), 0.5f, 1e-5f);
    EXPECT_NEAR(product("<input name='in1' type='color3' nodegraph='lib:G' output='out'/>"), 0.5f,
                1e-5f);
    // The library's own product is of its own nodes.
    EXPECT_NEAR(product("<input name='in1' type='color3' nodename='lib:m'/>"), 0.25f, 1e-5f);
    EXPECT_NEAR(product("<input name='in1' type='color3' nodename='k'/>"), 0.0f, 1e-5f);
    EXPECT_EQ(diagnostics.count(), 0) << warnings(diagnostics);
}

// Elements that changed with 1.39 are rewritten there too: names of 1.38 are those of the included
// document.
TEST_F(MtlxNamespaces, AnIncludedDocumentIsUpgraded) {
    write("library.mtlx",
          "<constant name='c' type='color3'><input name='value' type='color3' value='.2,.4,.6'/>"
          "</constant><dot name='k' type='color3'>"
          "<input name='in' type='color3' nodename='c' channels='bgr'/></dot>"
          "<thin_film_bsdf name='film' type='BSDF'/><dielectric_bsdf name='glass' type='BSDF'/>"
          "<layer name='coated' type='BSDF'><input name='top' type='BSDF' nodename='film'/>"
          "<input name='base' type='BSDF' nodename='glass'/></layer>",
          "namespace='lib'");
    const auto networks = read("<xi:include href='library.mtlx'/>"
                               "<oren_nayar_diffuse_bsdf name='d' type='BSDF'>"
                               "<input name='color' type='color3' nodename='lib:k'/>"
                               "</oren_nayar_diffuse_bsdf><layer name='l' type='BSDF'>"
                               "<input name='top' type='BSDF' nodename='lib:coated'/>"
                               "<input name='base' type='BSDF' nodename='d'/></layer>"
                               "<surface name='s' type='surfaceshader'>"
                               "<input name='bsdf' type='BSDF' nodename='l'/></surface>");
    ASSERT_EQ(networks.size(), 1u);
    EXPECT_EQ(diagnostics.count(), 0) << warnings(diagnostics);
    const NetworkNode* glass = networks[0].find("/lib:glass");
    ASSERT_NE(glass, nullptr);
    EXPECT_EQ(glass->inputs.count("thinfilm_thickness"), 1u);
    const Compiled c(networks[0]);
    EXPECT_EQ(c.diagnostics.count(), 0) << warnings(c.diagnostics);
    EXPECT_NE(dumpNetwork(networks[0]).find("/lib:k_in"), std::string::npos)
        << dumpNetwork(networks[0]);
}

} // namespace patina
