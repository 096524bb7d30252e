// SPDX-License-Identifier: Apache-2.0
// Namespaces of MaterialX documents.
#include "materialNetwork/tests/mtlxFixture.h"

using namespace patina;

namespace {

using MtlxNamespaces = MtlxTest;

/// A definition that is 0.75 everywhere.
std::string toon(const std::string& ofDef, const std::string& ofGraph,
                 const std::string& reference) {
    return "<nodedef name='ND_toon' node='toon_shade' " + ofDef + ">" + inputOf("x", "float", "0") +
           "<output name='out' type='color3'/></nodedef><nodegraph name='NG_toon' nodedef='" +
           reference + "' " + ofGraph + ">" + constantOf("c", "color3", ".75,.75,.75") +
           "<output name='out' type='color3' nodename='c'/></nodegraph>";
}

/// A material that has the colour of node "t", of a category.
std::string use(const std::string& category, const std::string& attributes = "",
                const std::string& inputs = "") {
    return "<" + category + " name='t' type='color3' " + attributes + ">" + inputs + "</" +
           category + ">" + surfaceOfColor("t") + materialOf("s");
}

void expectGrey(const std::vector<Network>& networks, float expected) {
    ASSERT_EQ(networks.size(), 1u);
    EXPECT_NEAR(albedoOf(networks[0]).x, expected, 1e-5f);
}

} // namespace

// The elements that MaterialX's own library finds in these documents.
TEST_F(MtlxNamespaces, DefinitionsAreFoundByTheirQualifiedNames) {
    const std::string space = "namespace='npr_test'";
    for (const std::string reference : {"ND_toon", "npr_test:ND_toon"}) {
        SCOPED_TRACE(reference);
        for (const std::string& ofGraph : {space, std::string()})
            expectGrey(read(toon(space, ofGraph, reference) + use("npr_test:toon_shade")), 0.75f);
        expectGrey(read(toon(space, space, "ND_toon") +
                        use("npr_test:toon_shade", "nodedef='" + reference + "'")),
                   0.75f);
    }
    // In a document of that namespace the short name means the same.
    for (const char* category : {"npr_test:toon_shade", "toon_shade"}) {
        SCOPED_TRACE(category);
        expectGrey(read(toon("", "", "ND_toon") + use(category), version139 + " " + space), 0.75f);
    }
    EXPECT_TRUE(nothingTold(diagnostics));
}

TEST_F(MtlxNamespaces, OtherNamespacesAreNotMeant) {
    const std::string space = "namespace='npr_test'";
    for (const char* category : {"toon_shade", "other:toon_shade"}) {
        const auto networks = read(toon(space, space, "ND_toon") + use(category));
        ASSERT_EQ(networks.size(), 1u);
        EXPECT_TRUE(told(Compiled(networks[0]), std::string("unknown type '") + category + "'"));
    }
    // Two definitions of one name in two namespaces.
    std::string other = toon("namespace='b'", "namespace='b'", "ND_b");
    other.replace(other.find("ND_toon"), 7, "ND_b");
    other.replace(other.find("NG_toon"), 7, "NG_b");
    other.replace(other.find(".75,.75,.75"), 11, ".25,.25,.25");
    const std::string both = toon(space, space, "ND_toon") + other;
    expectGrey(read(both + use("b:toon_shade")), 0.25f);
    expectGrey(read(both + use("npr_test:toon_shade")), 0.75f);
}

// All names of two namespaces are alike: of definitions, of graphs that implementations give them,
// and of graphs that stand for themselves.
TEST_F(MtlxNamespaces, TheSameNamesInTwoNamespacesAreTold) {
    const auto in = [](const std::string& space, const std::string& value) {
        const std::string own = "namespace='" + space + "'";
        return "<nodedef name='ND_toon' node='toon_shade' " + own + ">" +
               inputOf("x", "color3", value) +
               "<output name='out' type='color3'/></nodedef>"
               "<implementation name='I_toon' nodedef='ND_toon' nodegraph='" +
               space + ":NG_toon' " + own + "/><nodegraph name='NG_toon' " + own +
               "><constant name='c' type='color3'><input name='value' type='color3' "
               "interfacename='x'/></constant><output name='out' type='color3' nodename='c'/>"
               "</nodegraph><nodegraph name='G' " +
               own + ">" + constantOf("c", "color3", value) +
               "<output name='out' type='color3' nodename='c'/></nodegraph>";
    };
    const std::string both = in("a", ".75,.75,.75") + in("b", ".25,.25,.25");
    for (const auto& [space, expected] : {std::pair(std::string("a"), 0.75f), {"b", 0.25f}}) {
        SCOPED_TRACE(space);
        expectGrey(read(both + use(space + ":toon_shade")), expected);
        expectGrey(read(both + use("constant", "",
                                   "<input name='value' type='color3' nodegraph='" + space +
                                       ":G' output='out'/>")),
                   expected);
    }
    EXPECT_TRUE(nothingTold(diagnostics));
}

TEST_F(MtlxNamespaces, AnIncludedDocumentKeepsItsNamesApart) {
    documents.write("library.mtlx",
                    toon("", "", "ND_toon") + constantOf("k", "color3", ".5,.5,.5") +
                        "<nodegraph name='G'><multiply name='q' type='color3'>" +
                        inputOf("in1", "color3", ".5,.5,.5") +
                        "</multiply><output name='out' type='color3' nodename='q'/></nodegraph>"
                        "<multiply name='m' type='color3'>" +
                        inputFrom("in1", "color3", "k") +
                        "<input name='in2' type='color3' nodegraph='G' output='out'/></multiply>",
                    version139 + " namespace='lib'");
    const std::string include = "<xi:include href='library.mtlx'/>"
                                "<constant name='k' type='color3'/>"; // another one
    expectGrey(read(include + use("lib:toon_shade")), 0.75f);
    const auto product = [&](const std::string& input) {
        return read(include + use("multiply", "", input));
    };
    expectGrey(product(inputFrom("in1", "color3", "lib:k")), 0.5f);
    expectGrey(product("<input name='in1' type='color3' nodegraph='lib:G' output='out'/>"), 0.5f);
    // The library's own product is of its own nodes.
    expectGrey(product(inputFrom("in1", "color3", "lib:m")), 0.25f);
    expectGrey(product(inputFrom("in1", "color3", "k")), 0.0f);
    EXPECT_TRUE(nothingTold(diagnostics));
}

// Elements that changed with 1.39 are rewritten there too: names of 1.38 are those of the included
// document.
TEST_F(MtlxNamespaces, AnIncludedDocumentIsUpgraded) {
    documents.write(
        "library.mtlx",
        constantOf("c", "color3", ".2,.4,.6") +
            "<dot name='k' type='color3'>"
            "<input name='in' type='color3' nodename='c' channels='bgr'/></dot>"
            "<thin_film_bsdf name='film' type='BSDF'/>"
            "<dielectric_bsdf name='glass' type='BSDF'/><layer name='coated' type='BSDF'>" +
            inputFrom("top", "BSDF", "film") + inputFrom("base", "BSDF", "glass") + "</layer>",
        version139 + " namespace='lib'");
    const auto networks = read(
        "<xi:include href='library.mtlx'/><oren_nayar_diffuse_bsdf name='diffuse' type='BSDF'>" +
        inputFrom("color", "color3", "lib:k") +
        "</oren_nayar_diffuse_bsdf><layer name='l' type='BSDF'>" +
        inputFrom("top", "BSDF", "lib:coated") + inputFrom("base", "BSDF", "diffuse") + "</layer>" +
        surfaceOfBsdf("l"));
    ASSERT_EQ(networks.size(), 1u);
    EXPECT_TRUE(nothingTold(diagnostics));
    const NetworkNode* glass = networks[0].find("/lib:glass");
    ASSERT_NE(glass, nullptr);
    EXPECT_EQ(glass->inputs.count("thinfilm_thickness"), 1u);
    EXPECT_TRUE(nothingTold(Compiled(networks[0])));
    EXPECT_TRUE(has(dumpNetwork(networks[0]), "/lib:k_in"));
}
