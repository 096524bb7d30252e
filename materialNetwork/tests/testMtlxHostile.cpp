// SPDX-License-Identifier: Apache-2.0
// MaterialX documents that ask for more stack, memory or time than there is.
#include "materialNetwork/tests/mtlxFixture.h"

#include "base/limits.h"
#include "materialNetwork/mtlx/xmlFile.h"

#include <sys/stat.h>

using namespace patina;

namespace {

std::string repeated(const std::string& text, size_t times) {
    std::string all;
    all.reserve(text.size() * times);
    for (size_t i = 0; i < times; ++i)
        all += text;
    return all;
}

std::string nested(const std::string& element, size_t depth) {
    return repeated("<" + element + ">", depth) + repeated("</" + element + ">", depth);
}

const std::string material = "<standard_surface name='s' type='surfaceshader'/>" + materialOf("s");

using MtlxHostile = MtlxTest;

/// Definitions of which each uses the one below twice, or once; the lowest is a constant.
std::string doublings(int levels, bool twice = true) {
    std::string text;
    for (int i = 0; i < levels; ++i) {
        const std::string below = numbered("l", i - 1),
                          sum = "<" + below + " name='a' type='float'/><" +
                                (twice ? below : "constant") +
                                " name='b' type='float'/><add name='c' type='float'>" +
                                inputFrom("in1", "float", "a") + inputFrom("in2", "float", "b") +
                                "</add>";
        text += definition(numbered("l", i), numbered("l", i), "",
                           i ? sum : "<constant name='c' type='float'/>", "float");
    }
    return text;
}

std::string shown(const std::string& category) {
    return "<" + category + " name='top' type='float'/><surface name='s' type='surfaceshader'>" +
           inputFrom("opacity", "float", "top") + "</surface>" + materialOf("s");
}

} // namespace

TEST_F(MtlxHostile, GraphsNestedTooDeeplyAreNoDocument) {
    EXPECT_TRUE(read(nested("nodegraph", 20000) + material).empty());
    EXPECT_TRUE(
        reported("main.mtlx [] has elements nested more levels deep than 64 (--limit nesting); "
                 "the document is ignored"));
    EXPECT_EQ(read(nested("nodegraph", 60) + material).size(), 1u);
}

TEST_F(MtlxHostile, IncludesNestedTooDeeplyAreLeftOut) {
    const size_t depth = 400000; // each takes tens of bytes of an 8 MiB stack where it is freed
    // In what is included, and in the element that includes.
    documents.write("deep.mtlx", nested("a", depth));
    EXPECT_EQ(read("<xi:include href='deep.mtlx'/>" + material).size(), 1u);
    EXPECT_TRUE(reported("'deep.mtlx' has elements nested more levels deep than 64 (--limit "
                         "nesting); it is left out"));
    EXPECT_TRUE(
        read("<xi:include href='deep.mtlx'>" + nested("a", depth) + "</xi:include>").empty());
    EXPECT_EQ(diagnostics.count(), 2) << warnings(diagnostics);
}

/// Each element takes some 500 bytes while it is read.
TEST_F(MtlxHostile, MoreElementsThanAreReadAreLeftOut) {
    const std::string many = repeated("<a/>", limitOf(Limit::markup) / 2),
                      few = repeated("<a b=''/>", 1000);
    documents.write("many.mtlx", many);
    documents.write("few.mtlx", few);
    const std::string twice = "<xi:include href='many.mtlx'/><xi:include href='few.mtlx'/>"
                              "<xi:include href='many.mtlx'/>";
    EXPECT_EQ(read(twice + material).size(), 1u);
    EXPECT_EQ(diagnostics.count(), 1) << warnings(diagnostics);
    EXPECT_TRUE(
        reported("'many.mtlx' holds more tags and attributes than the 2097152 (--limit markup)"));
    EXPECT_TRUE(read(many + many + material).empty());
    EXPECT_TRUE(reported("main.mtlx [] holds more tags and attributes than"));
}

TEST_F(MtlxHostile, ValuesThatAreNotOfTheirTypeAreToldAndNotUsed) {
    const auto albedo = [&](const std::string& type, const std::string& value) {
        const bool color = type == "color3";
        const auto networks = read(constantOf("c", type, value) +
                                   (color ? ""
                                          : "<convert name='v' type='color3'>" +
                                                inputFrom("in", type, "c") + "</convert>") +
                                   surfaceOfColor(color ? "c" : "v"));
        if (networks.size() != 1) return glm::vec3(-1);
        const Compiled compiled(networks[0]);
        for (const Diagnostic& d : compiled.diagnostics.all())
            diagnostics.warn(d.prim, d.input, d.what);
        return compiled.albedo();
    };
    EXPECT_EQ(albedo("color3", "0.25, 0.5 ,0.75"), glm::vec3(0.25f, 0.5f, 0.75f));
    EXPECT_EQ(albedo("color3", "0.25"), glm::vec3(0.25f));
    EXPECT_EQ(albedo("boolean", "true"), glm::vec3(1));
    EXPECT_TRUE(nothingTold(diagnostics));
    int expected = 0;
    for (const std::string value :
         {"", "1,1", "1,1,1,1", "1;1;1", "0x10,1,1", "1,1,1 one", "nan,1,1"}) {
        EXPECT_EQ(albedo("color3", value), glm::vec3(0)) << value;
        EXPECT_EQ(diagnostics.count(), ++expected) << value << warnings(diagnostics);
        EXPECT_TRUE(reported("'" + value + "' is not color3; the default is used"));
    }
    EXPECT_EQ(albedo("float", "0.5f"), glm::vec3(0));
    EXPECT_TRUE(reported("'0.5f' is not float"));
    EXPECT_EQ(albedo("boolean", "yes"), glm::vec3(0));
    EXPECT_TRUE(reported("'yes' is not boolean"));
}

TEST_F(MtlxHostile, LongChainsOfClosuresTakeAFilm) {
    std::string body = "<thin_film_bsdf name='film' type='BSDF'/><layer name='top' type='BSDF'>" +
                       inputFrom("top", "BSDF", "film") + inputFrom("base", "BSDF", "m0") +
                       "</layer>";
    const int links = 100000; // a step of recursion each would not fit the stack
    for (int i = 0; i < links; ++i)
        body += "<multiply name='" + numbered("m", i) + "' type='BSDF'>" +
                inputFrom("in1", "BSDF", numbered("m", i + 1)) + "</multiply>";
    body += "<dielectric_bsdf name='" + numbered("m", links) + "' type='BSDF'/>";
    const auto networks = parse(body + surfaceOfBsdf("top"), version138);
    ASSERT_EQ(networks.size(), 1u);
    const NetworkNode* last = networks[0].find(numbered("/m", links));
    ASSERT_NE(last, nullptr);
    EXPECT_EQ(last->inputs.count("thinfilm_thickness"), 1u);
}

TEST_F(MtlxHostile, OnlyRegularFilesAreDocuments) {
    ASSERT_EQ(::mkfifo(documents.path("pipe.mtlx").c_str(), 0600), 0);
    EXPECT_EQ(read("<xi:include href='/dev/zero'/><xi:include href='pipe.mtlx'/>"
                   "<xi:include href='.'/><xi:include href='none.mtlx'/>" +
                   material)
                  .size(),
              1u);
    EXPECT_TRUE(reported("'/dev/zero' is a device, not a regular file; it is left out"));
    EXPECT_TRUE(reported("'pipe.mtlx' is a named pipe, not a regular file; it is left out"));
    EXPECT_TRUE(reported("'.' is a folder, not a regular file; it is left out"));
    EXPECT_TRUE(reported("'none.mtlx' does not exist; it is left out"));
    EXPECT_TRUE(readMtlx("/dev/zero", diagnostics).empty());
    EXPECT_TRUE(documents.read("pipe.mtlx", diagnostics).empty());
    EXPECT_TRUE(reported("/dev/zero [] the file is a device, not a regular file"));
}

TEST_F(MtlxHostile, MaterialsHoldTheNodesThatTheyReach) {
    constexpr int materials = 300, sums = 8;
    std::string body =
        "<constant name='shared' type='color3'/><constant name='idle' type='color3'/>";
    for (int i = 0; i < materials; ++i) {
        std::string last = "shared";
        for (int k = 0; k < sums; ++k) {
            const std::string name = numbered(numbered("n", i) + "_", k);
            body += "<add name='" + name + "' type='color3'>" + inputFrom("in1", "color3", last) +
                    "</add>";
            last = name;
        }
        body += "<standard_surface name='" + numbered("s", i) + "' type='surfaceshader'>" +
                inputFrom("base_color", "color3", last) + "</standard_surface>" +
                materialOf(numbered("s", i), numbered("M", i));
    }
    const auto networks = parse(body);
    ASSERT_EQ(networks.size(), size_t(materials));
    // The terminal leads past the material itself to the shader, its sums and the shared constant.
    for (const Network& network : networks)
        ASSERT_EQ(network.nodes.size(), size_t(1 + sums + 1)) << network.path;
    EXPECT_EQ(networks[7].nodes.front().path, "/shared"); // in the document's order
    EXPECT_TRUE(nothingTold(diagnostics));
}

TEST_F(MtlxHostile, DefinitionsThatMultiplyAreGivenUp) {
    const auto networks = read(doublings(40) + shown("l39"));
    ASSERT_EQ(networks.size(), 1u);
    EXPECT_TRUE(networks[0].empty());
    EXPECT_TRUE(networks[0].nodes.empty());
    EXPECT_TRUE(reported(
        "main.mtlx:M [] the material expands to more nodes than 200000 (--limit nodes); it "
        "is left out"));
    EXPECT_EQ(diagnostics.count(), 1) << warnings(diagnostics);
}

TEST_F(MtlxHostile, MaterialsThatMultiplyAreGivenUpTogether) {
    std::string body = doublings(40) + shown("l39");
    constexpr int materials = 1000;
    for (int i = 1; i < materials; ++i)
        body += materialOf("s", numbered("M", i));
    const auto networks = read(body);
    ASSERT_EQ(networks.size(), size_t(materials));
    for (const Network& network : networks)
        EXPECT_TRUE(network.empty() && network.nodes.empty());
    // Six times 200000 is beyond the bound of the document.
    EXPECT_TRUE(reported(
        "the materials expand to more nodes than five times 200000 (--limit nodes); the last "
        "994 are left out"));
    EXPECT_EQ(diagnostics.count(), 6 + 1);
}

TEST_F(MtlxHostile, DefinitionsThatMultiplyALittleAreNot) {
    const auto networks = read(doublings(12) + shown("l11"));
    ASSERT_EQ(networks.size(), 1u);
    EXPECT_TRUE(nothingTold(diagnostics));
    // 2^11 constants, 2^11 - 1 sums and the surface.
    EXPECT_EQ(networks[0].nodes.size(), size_t(2048 + 2047 + 1));
}

TEST_F(MtlxHostile, DefinitionsNestedTooDeeplyAreToldOnce) {
    // Sixteen levels are taken in; what is below of the last is left out, and its sum has a
    // default.
    const auto networks = read(doublings(40, false) + shown("l39"));
    ASSERT_EQ(networks.size(), 1u);
    EXPECT_EQ(networks[0].nodes.size(), size_t(16 * 2 + 1));
    EXPECT_TRUE(reported("does ND_l23 contain itself?); the node is left out"));
    const Compiled c(networks[0]);
    EXPECT_EQ(diagnostics.count() + c.diagnostics.count(), 1) << warnings(c);
}
