// SPDX-License-Identifier: Apache-2.0
// Which of overlapping objects a path is in, and what their surfaces border on.
#include "hdDelegate/embree/media/mediumStack.h"
#include "materialNetwork/tests/materialFixture.h"

namespace patina {

namespace {

std::shared_ptr<const MaterialProgram> dielectric(float ior) {
    return Compiled(bsdfNetwork({makeNode("bsdf", "ND_dielectric_bsdf",
                                          {{"ior", number(ior)},
                                           {"roughness", pair(0.0f)},
                                           {"scatter_mode", text("RT")}})}))
        .program;
}

/// A point whose front or back is seen.
ShadingPoint seen(bool front) {
    ShadingPoint point;
    point.viewDirection = glm::vec3(0.0f, 0.0f, front ? 1.0f : -1.0f);
    return point;
}

} // namespace

TEST(MediumStack, AHigherPriorityHidesSurfacesAndFillsThePlace) {
    const auto glass = dielectric(1.5f), water = dielectric(1.33f);
    ASSERT_TRUE(glass->encloses() && !glass->hasInterior());
    MediumStack media;
    EXPECT_FALSE(media.ranked());
    EXPECT_EQ(media.iorAround(*water, seen(true), 1), 1.0f);
    media.cross(*glass, seen(true), 2, 1.5f);
    EXPECT_TRUE(media.ranked());
    EXPECT_TRUE(media.hides(*water, seen(true), 1)); // enters water within glass
    media.cross(*water, seen(true), 1, 1.33f);
    EXPECT_EQ(media.size(), 2);
    // Leaves the glass: it borders on the water, and is there.
    EXPECT_FALSE(media.hides(*glass, seen(false), 2));
    EXPECT_EQ(media.iorAround(*glass, seen(false), 2), 1.33f);
    media.cross(*glass, seen(false), 2);
    EXPECT_EQ(media.size(), 1);
    // Leaves the water for the air.
    EXPECT_FALSE(media.hides(*water, seen(false), 1));
    EXPECT_EQ(media.iorAround(*water, seen(false), 1), 1.0f);
    media.cross(*water, seen(false), 1);
    EXPECT_TRUE(media.empty());
}

TEST(MediumStack, OfOnePriorityTheLastCounts) {
    const auto ice = dielectric(1.31f), water = dielectric(1.33f);
    MediumStack media;
    media.cross(*water, seen(true), 1, 1.33f);
    EXPECT_FALSE(media.hides(*ice, seen(true), 1));
    EXPECT_EQ(media.iorAround(*ice, seen(true), 1), 1.33f);
    media.cross(*ice, seen(true), 1, 1.31f);
    // Another piece of the same: nothing to leave when it is entered, itself when it is left.
    EXPECT_EQ(media.iorAround(*ice, seen(true), 1), 1.31f);
    EXPECT_EQ(media.iorAround(*ice, seen(false), 1), 1.33f);
}

TEST(MediumStack, WithoutPrioritiesClearGlassIsNoMedium) {
    const auto glass = dielectric(1.5f);
    MediumStack media;
    media.cross(*glass, seen(true));
    EXPECT_TRUE(media.empty());
    media.cross(*glass, seen(false), 3); // never entered
    EXPECT_TRUE(media.empty());
    for (int i = 0; i < 20; ++i) // deeper than it holds
        media.cross(*glass, seen(true), 3, 1.5f);
    for (int i = 0; i < 20; ++i)
        media.cross(*glass, seen(false), 3);
    EXPECT_TRUE(media.empty());
}

TEST(MediumStack, SurroundingsDivideTheIorOfDielectrics) {
    const auto ice = dielectric(1.31f);
    ShadingPoint point = seen(true);
    Bsdf alone, inWater;
    ice->evaluate(point, alone);
    point.surroundingIor = 1.33f;
    ice->evaluate(point, inWater);
    EXPECT_FLOAT_EQ(alone.ior(), 1.31f);
    EXPECT_FLOAT_EQ(inWater.ior(), 1.31f / 1.33f);
    // Fresnel's equations at normal incidence, of what a smooth lobe reflects.
    const auto reflected = [](const Bsdf& bsdf) {
        for (float u = 0.0f; u < 1.0f; u += 1.0f / 4096.0f) {
            const BsdfSample s = bsdf.sample(glm::vec3(0.5f, 0.5f, u), u);
            if ((s.event & sh::LOBE_REFLECT) != 0) return s.weight.x * s.pdf;
        }
        return 0.0f;
    };
    const auto fresnel = [](float n) {
        return (n - 1.0f) * (n - 1.0f) / ((n + 1.0f) * (n + 1.0f));
    };
    EXPECT_NEAR(reflected(alone), fresnel(1.31f), 1e-5f);
    EXPECT_NEAR(reflected(inWater), fresnel(1.31f / 1.33f), 1e-6f);
}

} // namespace patina
