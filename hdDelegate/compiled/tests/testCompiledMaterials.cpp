// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/compiled/compiledMaterials.h"
#include "hdDelegate/image/textureSystem.h"
#include "hdDelegate/scene/tests/prims.h"

#include "base/tests/testTools.h"

namespace patina {
namespace {

class SharedMaterials : public ::testing::Test {
protected:
    static std::shared_ptr<const MaterialPrim> material(const std::string& path) {
        auto prim = makePrim<MaterialPrim>(path);
        prim->network = makeDisplayColorNetwork();
        return prim;
    }

    Diagnostics diagnostics;
    TextureSystem textures{diagnostics};
    CompiledMaterials materials{textures, diagnostics};
};

TEST_F(SharedMaterials, SharesTheProgramOfOneMaterial) {
    const auto prim = material("/a");
    const auto first = materials.program(prim, {}, -1.0);
    EXPECT_EQ(materials.program(prim, {}, -1.0), first);
    EXPECT_EQ(materials.programsBuilt(), 1u);
    EXPECT_NE(materials.program(material("/a"), {}, -1.0), first) << "an edit makes a new prim";
    EXPECT_EQ(materials.programsBuilt(), 2u);
}

TEST_F(SharedMaterials, CompilesForEachChoiceOfMethods) {
    const auto prim = material("/a");
    const auto plain = materials.program(prim, {}, -1.0);
    EXPECT_NE(materials.program(prim, {{"sheen", "fitted"}}, -1.0), plain);
    EXPECT_NE(materials.program(prim, {}, 0.01), plain);
    EXPECT_EQ(materials.program(prim, {}, -1.0), plain);
}

TEST_F(SharedMaterials, ForgetsWhatNobodyHolds) {
    const auto prim = material("/a");
    materials.program(prim, {}, -1.0);
    EXPECT_EQ(prim.use_count(), 1) << "the material is still held";
    const auto again = materials.program(prim, {}, -1.0);
    EXPECT_EQ(materials.programsBuilt(), 2u);
}

TEST_F(SharedMaterials, CompilesOnceForThreadsThatAskTogether) {
    const auto prim = material("/a");
    std::vector<std::shared_ptr<const MaterialProgram>> programs(8);
    onThreads(8, [&](int i) { programs[size_t(i)] = materials.program(prim, {}, -1.0); });
    for (const auto& program : programs)
        EXPECT_EQ(program, programs[0]);
    EXPECT_EQ(materials.programsBuilt(), 1u);
}

TEST_F(SharedMaterials, NamesThePrimOfAMaterialThatIsNotThere) {
    Scene scene;
    EXPECT_EQ(materials.find("/none", "/user", *scene.snapshot(), RenderSettings()), nullptr);
    const std::string told = onlyWarning(diagnostics);
    EXPECT_TRUE(has(told, "/user ") && has(told, "/none")) << told;
    EXPECT_EQ(materials.find("", "/user", *scene.snapshot(), RenderSettings()), nullptr);
    EXPECT_EQ(diagnostics.all().size(), 1u) << "no material is no mistake";
}

} // namespace
} // namespace patina
