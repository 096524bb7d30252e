// SPDX-License-Identifier: Apache-2.0
// Each request of a material that is not served has a warning that names prim and input.
#include "materialNetwork/tests/materialFixture.h"

#include "materialNetwork/mtlx/document.h"

#include <cstdio>
#include <fstream>

namespace patina {

TEST(NotShown, LightsOfDocumentsAreTold) {
    const std::string path = testing::TempDir() + "patinaLights.mtlx";
    std::ofstream(path) << R"(<materialx version="1.39">
      <uniform_edf name="e" type="EDF"/>
      <light name="lamp" type="lightshader"><input name="edf" type="EDF" nodename="e"/></light>
      <standard_surface name="s" type="surfaceshader"/>
      <surfacematerial name="M" type="material">
        <input name="surfaceshader" type="surfaceshader" nodename="s"/></surfacematerial>
      </materialx>)";
    Diagnostics diagnostics;
    EXPECT_EQ(readMtlx(path, diagnostics).size(), 1u);
    std::remove(path.c_str());
    EXPECT_EQ(warnings(diagnostics),
              path + ":/lamp [] light shaders are drawn in documents without materials alone; "
                     "the node is ignored\n");
}

TEST(NotShown, AFallbackIsExplainedAsOne) {
    const auto explained = [](const char* shader, Diagnostics& diagnostics) {
        return explainMaterial(makeNetwork({makeNode("surface", shader)}), diagnostics);
    };
    const std::string sentence = "This material has no usable surface and is not shown.";
    Diagnostics diagnostics, clean;
    FakeTextures textures;
    for (const char* shader : {"ND_point_light", "ND_nobody_knows"}) {
        const std::string text = explained(shader, diagnostics);
        const size_t at = text.find(sentence);
        ASSERT_NE(at, std::string::npos) << shader << "\n" << text;
        // The network comes before it, and displayColor's plan after it.
        EXPECT_LT(text.find("network /m"), at);
        EXPECT_EQ(text.find("material /m"), std::string::npos);
        EXPECT_GT(text.find("material /displayColor"), at);
        EXPECT_NE(text.find("lobe 0"), std::string::npos);
        EXPECT_TRUE(planMaterialMethods(makeNetwork({makeNode("surface", shader)}), textures,
                                        diagnostics, {}, 0.0)
                        .fallback);
    }
    EXPECT_NE(warnings(diagnostics)
                  .find("/m/surface (ND_point_light) is not drawn: it is a detail of MaterialX's "
                        "shader generators and no part of the standard; lights of a stage are "
                        "prims of UsdLux; the terminal is ignored"),
              std::string::npos)
        << warnings(diagnostics);
    EXPECT_EQ(explained("UsdPreviewSurface", clean).find(sentence), std::string::npos);
    EXPECT_EQ(clean.count(), 0);
    EXPECT_FALSE(planMaterialMethods(previewNetwork(), textures, clean, {}, 0.0).fallback);
}

} // namespace patina
