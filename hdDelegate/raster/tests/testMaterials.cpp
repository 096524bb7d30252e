// SPDX-License-Identifier: Apache-2.0
// Programs of materials: shared by equal texts, and forgotten when networks have changed for long.

#include "hdDelegate/raster/scene/rasterMaterials.h"
#include "hdDelegate/raster/tests/rasterFixture.h"

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
    auto material = std::make_shared<MaterialPrim>();
    material->path = material->network.path = "/material";
    NetworkNode surface;
    surface.path = "/material/surface";
    surface.id = "ND_surface";
    std::string sum;
    for (int i = 0; i < lobes; ++i) {
        const std::string number = std::to_string(i);
        NetworkNode lobe;
        lobe.path = "/material/lobe" + number;
        lobe.id = "ND_oren_nayar_diffuse_bsdf";
        lobe.inputs["weight"] = Value::makeFloat(0.1f);
        material->network.nodes.push_back(lobe);
        if (i == 0) {
            sum = lobe.path;
            continue;
        }
        NetworkNode add;
        add.path = "/material/add" + number;
        add.id = "ND_add_bsdf";
        add.connections["in1"] = {sum, ""};
        add.connections["in2"] = {lobe.path, ""};
        sum = add.path;
        material->network.nodes.push_back(add);
    }
    surface.connections["bsdf"] = {sum, ""};
    material->network.nodes.push_back(surface);
    material->network.terminals["surface"] = {surface.path, ""};
    return material;
}

} // namespace

TEST(RasterMaterials, ForgetsProgramsThatAreLongUnused) {
    PATINA_NEED_CONTEXT();
    auto scene = std::make_shared<Scene>();
    CompiledScene compiled(scene);
    RasterMaterials materials(compiled);
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

TEST(RasterMaterials, EditsForgetProgramsThatAreLongUnused) {
    PATINA_NEED_CONTEXT();
    auto scene = std::make_shared<Scene>();
    CompiledScene compiled(scene);
    RasterMaterials materials(compiled);
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
