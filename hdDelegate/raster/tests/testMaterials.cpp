// SPDX-License-Identifier: Apache-2.0
// Programs of materials: shared by equal texts, and forgotten when networks have changed for long.

#include "hdDelegate/raster/scene/rasterMaterials.h"
#include "hdDelegate/raster/tests/rasterFixture.h"

using namespace patina;

namespace {

/// Outputs that programs are written for: each number is another text.
RenderSettings settingsOf(int number) {
    RenderSettings settings;
    settings.aovs = {"color"};
    for (int i = 0; i < number; ++i)
        settings.aovs.push_back("primvars:value" + std::to_string(i));
    return settings;
}

} // namespace

TEST(RasterMaterials, ForgetsProgramsThatAreLongUnused) {
    PATINA_NEED_CONTEXT();
    auto scene = std::make_shared<Scene>();
    CompiledScene compiled(scene);
    RasterMaterials materials(compiled);
    materials.keepUnused(2);
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
