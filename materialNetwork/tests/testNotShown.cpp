// SPDX-License-Identifier: Apache-2.0
// Each request of a material that is not served has a warning that names prim and input.
#include "materialNetwork/tests/mtlxFixture.h"

using namespace patina;

using NotShown = MtlxTest;

TEST_F(NotShown, LightsOfDocumentsAreTold) {
    EXPECT_EQ(read(R"(<uniform_edf name="e" type="EDF"/>
      <light name="lamp" type="lightshader"><input name="edf" type="EDF" nodename="e"/></light>
      <standard_surface name="s" type="surfaceshader"/>)" +
                   materialOf("s"))
                  .size(),
              1u);
    EXPECT_EQ(warnings(diagnostics),
              documents.path("main.mtlx") +
                  ":/lamp [] light shaders are drawn in documents without materials alone; "
                  "the node is ignored\n");
}

TEST_F(NotShown, AFallbackIsExplainedAsOne) {
    const auto explained = [](const char* shader, Diagnostics& diagnostics) {
        return explainMaterial(modelNetwork(shader), diagnostics);
    };
    const std::string sentence = "This material has no usable surface and is not shown.";
    Diagnostics clean;
    FakeTextures textures;
    for (const char* shader : {"ND_point_light", "ND_nobody_knows"}) {
        const std::string text = explained(shader, diagnostics);
        const size_t at = text.find(sentence);
        ASSERT_NE(at, std::string::npos) << shader << "\n" << text;
        // The network comes before it, and displayColor's plan after it.
        EXPECT_LT(text.find("network /m"), at);
        EXPECT_EQ(text.find("material /m"), std::string::npos);
        EXPECT_GT(text.find("material /displayColor"), at);
        EXPECT_TRUE(has(text, "lobe 0"));
        EXPECT_TRUE(
            planMaterialMethods(modelNetwork(shader), textures, diagnostics, {}, 0.0).fallback);
    }
    EXPECT_TRUE(told(diagnostics,
                     "/m/surface (ND_point_light) is not drawn: it is a detail of MaterialX's "
                     "shader generators and no part of the standard; lights of a stage are "
                     "prims of UsdLux; the terminal is ignored"));
    EXPECT_EQ(explained("UsdPreviewSurface", clean).find(sentence), std::string::npos);
    EXPECT_EQ(clean.count(), 0);
    EXPECT_FALSE(planMaterialMethods(previewNetwork(), textures, clean, {}, 0.0).fallback);
}
