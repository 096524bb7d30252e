// SPDX-License-Identifier: Apache-2.0
#include "base/limits.h"
#include "materialNetwork/tests/materialFixture.h"

namespace patina {
namespace {

struct Limits : ::testing::Test {
    Diagnostics diagnostics;
    ~Limits() override { setLimits({}); }
};

TEST_F(Limits, AreSetTogetherOrNotAtAll) {
    const uint64_t nodes = limitOf(Limit::nodes);
    EXPECT_EQ(setLimits({{"nodes", 7}}), "");
    EXPECT_EQ(limitOf(Limit::nodes), 7u);
    EXPECT_EQ(limitText(Limit::nodes), "7 (--limit nodes)");
    EXPECT_TRUE(has(setLimits({{"nodes", 9}, {"nothing", 1}}), "no limit 'nothing'"));
    EXPECT_EQ(setLimits({{"nesting", 1}}), "the limit nesting is from 8 to 1000");
    EXPECT_EQ(limitOf(Limit::nodes), 7u);
    EXPECT_EQ(setLimits({}), "");
    EXPECT_EQ(limitOf(Limit::nodes), nodes);
}

TEST_F(Limits, TextsThatAreTooLongAreLeftOutAndNamed) {
    setLimits({{"textLength", 8}});
    const Network network =
        makeNetwork({makeNode("image", "ND_image_color3",
                              {{"file", file("123456789")}, {"uaddressmode", "12345678"}})},
                    "image");
    const Network found = expand(network, diagnostics);
    ASSERT_EQ(found.nodes.size(), 1u);
    EXPECT_EQ(found.nodes[0].inputs.count("file"), 0u);
    EXPECT_EQ(found.nodes[0].inputs.count("uaddressmode"), 1u);
    ASSERT_EQ(diagnostics.count(), 1);
    const Diagnostic told = diagnostics.all()[0];
    EXPECT_EQ(told.prim + " " + told.input + ": " + told.message,
              "/m/image file: the text is longer than 8 (--limit textLength); the default is used");
}

} // namespace
} // namespace patina
