// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/compiled/apertureShape.h"
#include "shaders/tests/pearson.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace patina {
namespace {

constexpr float pi = 3.14159265f;

CameraLens lensOf(int blades, float curvature, float rotation = 0.0f, float aspect = 1.0f) {
    CameraLens lens;
    lens.apertureBlades = blades;
    lens.apertureBladeCurvature = curvature;
    lens.apertureRotation = rotation;
    lens.apertureAspect = aspect;
    return lens;
}

/// Whether a place is within the shape, by its definition.
bool within(const ApertureShape& shape, int blades, float rotation, vec2 p) {
    const float side = 2.0f * pi / float(blades);
    float angle = std::atan2(p.y, p.x) - glm::radians(rotation);
    angle -= side * std::floor(angle / side);
    return glm::length(p) <= shape.boundary(angle - 0.5f * side);
}

} // namespace

TEST(ApertureShape, CornersAreAtOneAndTheFirstPointsRight) {
    const ApertureShape shape(lensOf(6, 0.0f));
    const vec2 corner = shape.sample({0.0f, 1.0f});
    EXPECT_NEAR(corner.x, 1.0f, 1e-5f);
    EXPECT_NEAR(corner.y, 0.0f, 1e-5f);
    const vec2 side = shape.sample({1.0f / 12.0f, 1.0f}); // the middle of the first side
    EXPECT_NEAR(glm::length(side), std::cos(pi / 6.0f), 1e-5f);
    const vec2 turned = ApertureShape(lensOf(6, 0.0f, 90.0f)).sample({0.0f, 1.0f});
    EXPECT_NEAR(turned.y, 1.0f, 1e-5f);
}

TEST(ApertureShape, FewBladesAndFullCurvatureAreADisk) {
    EXPECT_TRUE(ApertureShape(lensOf(2, 0.0f)).isDisk());
    EXPECT_TRUE(ApertureShape(lensOf(9, 1.0f)).isDisk());
    EXPECT_FALSE(ApertureShape(lensOf(9, 0.9f)).isDisk());
}

TEST(ApertureShape, AnamorphicLensesAreNarrow) {
    const ApertureShape disk(lensOf(0, 0.0f, 0.0f, 2.0f));
    EXPECT_NEAR(disk.sample({1.0f, 0.5f}).x, 0.5f, 1e-5f);
    EXPECT_NEAR(disk.sample({0.5f, 1.0f}).y, 1.0f, 1e-5f);
}

// Chi-squared over the cells of a grid, whose shares of the shape's area are counted at 24 x 24
// places of each. Those that are expected less than 10 times are pooled. Significance 1e-5 each,
// seeds 1 to 7.
TEST(ApertureShape, PlacesAreUniformByArea) {
    struct Case {
        int blades;
        float curvature, rotation;
    };
    const Case cases[] = {{3, 0.0f, 0.0f},  {5, 0.0f, 20.0f}, {6, 0.5f, 0.0f}, {8, 0.99f, 5.0f},
                          {5, -0.7f, 0.0f}, {3, -1.0f, 0.0f}, {64, 0.0f, 0.0f}};
    constexpr int cells = 20, fine = 24, count = 40000;
    unsigned seed = 0;
    for (const Case& c : cases) {
        const ApertureShape shape(lensOf(c.blades, c.curvature, c.rotation));
        std::vector<double> share(cells * cells), seen(cells * cells);
        double all = 0.0;
        for (int y = 0; y < cells * fine; ++y)
            for (int x = 0; x < cells * fine; ++x) {
                const vec2 p = (vec2(x, y) + 0.5f) * (2.0f / (cells * fine)) - 1.0f;
                if (!within(shape, c.blades, c.rotation, p)) continue;
                share[size_t(y / fine * cells + x / fine)] += 1.0;
                all += 1.0;
            }
        std::mt19937 random(++seed);
        std::uniform_real_distribution<float> unit(0.0f, 1.0f);
        for (int i = 0; i < count; ++i) {
            const float u = unit(random), v = unit(random);
            const vec2 p = shape.sample({u, v});
            ASSERT_TRUE(within(shape, c.blades, c.rotation, p * 0.9999f)) << u << ' ' << v;
            const int x = std::min(int((p.x + 1.0f) * 0.5f * cells), cells - 1);
            const int y = std::min(int((p.y + 1.0f) * 0.5f * cells), cells - 1);
            seen[size_t(std::max(y, 0) * cells + std::max(x, 0))] += 1.0;
        }
        for (double& one : share)
            one *= count / all;
        const test::Pearson result = test::pearson(share, seen, 10.0);
        ASSERT_GT(result.cells(), 1);
        EXPECT_GT(result.tail(), 1e-5) << c.blades << " blades, curvature " << c.curvature;
    }
}

} // namespace patina
