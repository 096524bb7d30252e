// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/compiled/distortionMap.h"

#include "base/tests/testTools.h"

#include <cmath>

namespace patina {
namespace {

/// The map that shows every place moved.
DistortionMap moved(int width, int height, vec2 by) {
    std::vector<vec2> places;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            places.push_back(vec2(float((x + 0.5) / width), float((height - y - 0.5) / height)) +
                             by);
    return DistortionMap(width, height, places);
}

} // namespace

TEST(DistortionMap, AnIdentityMovesNothingToTheBit) {
    const DistortionMap map = moved(37, 23, vec2(0.0f));
    for (float x : {-0.1f, 0.0f, 0.012345f, 0.3333333f, 0.777f, 1.0f, 1.01f})
        for (float y : {-0.1f, 0.0f, 0.54321f, 0.999f, 1.0f})
            EXPECT_EQ(map.shown({x, y}), vec2(x, y));
}

TEST(DistortionMap, UpInTheMapIsUpOnTheFilm) {
    const vec2 shown = moved(8, 8, {0.5f, 0.25f}).shown({0.25f, 0.75f});
    EXPECT_NEAR(shown.x, 0.75f, 1e-6f);
    EXPECT_NEAR(shown.y, 0.5f, 1e-6f);
}

TEST(DistortionMap, WaysAreInterpolated) {
    const DistortionMap map(2, 1, {{0.25f, 0.5f}, {0.95f, 0.5f}}); // the right texel shows 0.2 more
    EXPECT_NEAR(map.shown({0.5f, 0.5f}).x, 0.6f, 1e-6f);
    EXPECT_NEAR(map.shown({1.0f, 0.5f}).x, 1.2f, 1e-6f);
}

TEST(DistortionMap, WithoutAFileThereIsNone) {
    Diagnostics diagnostics;
    Camera camera;
    camera.path = "/camera";
    EXPECT_EQ(DistortionMap::read(camera, diagnostics), nullptr);
    EXPECT_EQ(diagnostics.count(), 0);
    camera.lens.distortionMap = "/no/such/map.exr";
    EXPECT_EQ(DistortionMap::read(camera, diagnostics), nullptr);
    const std::string told = onlyWarning(diagnostics);
    EXPECT_EQ(told.find("/camera patina:distortionMap "), 0u) << told;
    EXPECT_TRUE(has(told, "/no/such/map.exr")) << told;
}

} // namespace patina
