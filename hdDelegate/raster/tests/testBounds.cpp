// SPDX-License-Identifier: Apache-2.0
// What a scene may ask for in triangles, texels and tables is bounded, or made once for all places.

#include "hdDelegate/raster/lights/rasterDomes.h"
#include "hdDelegate/raster/lights/rasterLightTables.h"
#include "hdDelegate/raster/scene/rasterShapes.h"

#include "base/tests/testTools.h"
#include "hdDelegate/film/tests/tempFolder.h"
#include "hdDelegate/scene/tests/prims.h"

#include <cmath>

using namespace patina;

namespace {

PrimShape points(const std::vector<float>& radii) {
    PrimShape shape;
    shape.points.points.resize(1);
    for (const float radius : radii)
        shape.points.points[0].emplace_back(0.0f, 0.0f, 0.0f, radius);
    return shape;
}

size_t trianglesOf(const PrimShape& shape, const RasterFineness& fineness) {
    return rasterTriangles(shape, fineness).seen.mesh.triangles.size();
}

/// The loader of a grey image.
LightImages greyImages(int width, int height) {
    return LightImages(
        [=](const std::string&, const std::string&, const std::string&, const std::string&) {
            ImageRGB image;
            image.width = width;
            image.height = height;
            image.pixels.assign(size_t(width) * size_t(height), vec3(0.5f));
            image.valid = true;
            return image;
        });
}

Light rectWith(const std::string& path, const std::string& image) {
    Light light = *makeLight(path, LightType::Rect);
    light.textureFile = image;
    return light;
}

} // namespace

TEST(RasterBounds, AWidePointMakesOthersNoFiner) {
    const RasterFineness fine{1e-3f, 0.0f};
    const size_t wide = trianglesOf(points({10.0f}), fine);
    const size_t narrow = trianglesOf(points({0.001f}), fine);
    ASSERT_GT(wide, 50 * narrow);
    std::vector<float> radii(1000, 0.001f);
    radii.push_back(10.0f);
    EXPECT_EQ(trianglesOf(points(radii), fine), wide + 1000 * narrow);
}

TEST(RasterBounds, ManyWidePointsAreCoarser) {
    RasterFineness fine{1e-3f, 0.0f};
    const PrimShape shape = points(std::vector<float>(100, 10.0f));
    const size_t all = trianglesOf(shape, fine);
    fine.pointTriangles = all / 3;
    const size_t fewer = trianglesOf(shape, fine);
    EXPECT_LE(fewer, all / 3);
    EXPECT_GT(fewer, all / 30);
}

TEST(RasterBounds, AnImageIsInTheTablesOnce) {
    LightImages images = greyImages(512, 512);
    RasterLightTables tables;
    Diagnostics diagnostics;
    const RectImage* first = tables.rect(rectWith("/a", "grey.png"), images, diagnostics);
    ASSERT_TRUE(first);
    EXPECT_EQ(tables.rect(rectWith("/b", "grey.png"), images, diagnostics), first);
    // Of others, as many as have room; then there are warnings.
    int held = 1;
    for (int i = 0; i < 40; ++i)
        held += tables.rect(rectWith("/c", std::to_string(i)), images, diagnostics) != nullptr;
    EXPECT_EQ(held, int(RasterLightTables::maxValues / (512 * 512)));
    EXPECT_GT(diagnostics.count(), 0);
    EXPECT_EQ(tables.add(std::vector<vec4>(RasterLightTables::maxValues)), -1);
    EXPECT_GE(tables.add({vec4(1.0f)}), 0);
}

TEST(RasterBounds, AProfileIsInTheTablesOnce) {
    const TempFolder temp;
    writeFile(temp.file("a.ies"),
              "IESNA:LM-63-1995\nTILT=NONE\n1 1000 1 2 1 1 2 0 0 0\n1 1 10\n0 90\n0\n100 10\n");
    Light light = *makeLight("/spot", LightType::Sphere);
    light.iesFile = temp.file("a.ies");
    RasterLightTables tables;
    Diagnostics diagnostics;
    const ProfileTable first = tables.profile(light, diagnostics);
    EXPECT_EQ(diagnostics.count(), 0u);
    ASSERT_GE(first.first, 0);
    EXPECT_EQ(tables.profile(light, diagnostics).first, first.first);
}

TEST(RasterBounds, DomesHaveSoManyImages) {
    LightImages images = greyImages(4, 2);
    RasterDomes domes;
    domes.begin();
    const auto layer = [&](int i) {
        Light dome;
        dome.type = LightType::Dome;
        dome.textureFile = std::to_string(i);
        return domes.layer(images.environment(dome));
    };
    for (int i = 0; i < RasterDomes::maxImages; ++i)
        ASSERT_EQ(layer(i), i);
    EXPECT_EQ(layer(3), 3) << "known ones stay";
    EXPECT_EQ(layer(RasterDomes::maxImages), -1);
}
