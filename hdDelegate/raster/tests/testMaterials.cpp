// SPDX-License-Identifier: Apache-2.0
// Programs of materials: shared by equal texts, and forgotten when networks have changed for long.

#include "hdDelegate/raster/scene/rasterMaterials.h"
#include "hdDelegate/raster/tests/rasterFixture.h"
#include "hdDelegate/scene/tests/prims.h"
#include "materialNetwork/tests/materialFixture.h"

using namespace patina;

namespace {

/// Outputs that programs are written for: each number is another text.
RenderSettings settingsOf(int number) {
    RenderSettings settings;
    settings.unusedPrograms = 2;
    settings.aovs = {"color"};
    for (int i = 0; i < number; ++i)
        settings.aovs.push_back("primvars:value" + std::to_string(i));
    return settings;
}

/// Diffuse lobes that are added up: each number is another text.
std::shared_ptr<const MaterialPrim> materialOf(int lobes) {
    std::vector<NetworkNode> nodes = {makeNode("surface", "ND_surface")};
    std::string sum;
    for (int i = 0; i < lobes; ++i) {
        const std::string lobe = "lobe" + std::to_string(i), add = "add" + std::to_string(i);
        nodes.push_back(makeNode(lobe, "ND_oren_nayar_diffuse_bsdf", {{"weight", number(0.1f)}}));
        if (i > 0)
            nodes.push_back(
                makeNode(add, "ND_add_bsdf", {}, {{"in1", {sum, ""}}, {"in2", {lobe, ""}}}));
        sum = i > 0 ? add : lobe;
    }
    nodes[0].connections["bsdf"] = {"/m/" + sum, ""};
    return makeMaterial("/material", nodes);
}

class RasterMaterialsTest : public testing::Test {
protected:
    std::shared_ptr<Scene> scene = std::make_shared<Scene>();
    CompiledScene compiled{scene};
    RasterMaterials materials{compiled};
};

} // namespace

TEST_F(RasterMaterialsTest, ForgetsProgramsThatAreLongUnused) {
    PATINA_NEED_CONTEXT();
    const auto state = scene->snapshot();
    const auto draw = [&](int number) {
        const RenderSettings settings = settingsOf(number);
        materials.update(*state, settings, RasterLightPlan());
        materials.get("", "", *state, settings);
    };
    for (int number = 0; number < 5; ++number)
        draw(number);
    EXPECT_EQ(materials.programsBuilt(), 5u);
    // In use is the last; when it was asked for, two more were left.
    EXPECT_LE(materials.programsKept(), 4u);
    draw(3); // the one before
    EXPECT_EQ(materials.programsBuilt(), 5u) << "what was used last is kept";
    draw(0);
    EXPECT_EQ(materials.programsBuilt(), 6u) << "what was used first is forgotten";
    EXPECT_LE(materials.programsKept(), 4u);
}

TEST_F(RasterMaterialsTest, EditsForgetProgramsThatAreLongUnused) {
    PATINA_NEED_CONTEXT();
    RenderSettings settings = settingsOf(0);
    const auto show = [&](int lobes, bool edited) {
        scene->edit().set(materialOf(lobes));
        const auto state = scene->snapshot();
        if (edited)
            EXPECT_TRUE(materials.edit({{"/material", {}}}, *state, settings)) << lobes;
        else
            materials.update(*state, settings, RasterLightPlan());
        materials.get("/material", "", *state, settings);
    };
    show(1, false);
    for (int lobes = 2; lobes < 6; ++lobes)
        show(lobes, true);
    EXPECT_EQ(materials.programsBuilt(), 5u);
    EXPECT_EQ(materials.programsKept(), 3u) << "the one in use and two more";
    show(3, true);
    EXPECT_EQ(materials.programsBuilt(), 5u) << "what was used last is kept";
    settings.unusedPrograms = 0;
    show(1, true);
    EXPECT_EQ(materials.programsBuilt(), 6u) << "what was used first is forgotten";
    EXPECT_EQ(materials.programsKept(), 1u);
}
