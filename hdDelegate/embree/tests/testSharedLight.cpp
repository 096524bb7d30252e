// SPDX-License-Identifier: Apache-2.0
// The cells in which paths share light.
#include "hdDelegate/embree/sharing/sharedLight.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace patina {

namespace {

constexpr int least = SharedLight::least;
const vec3 up(0, 1, 0);

SharedPoint pointAt(const vec3& position, const vec3& normal, float light, int depth = 1) {
    return {position, normal, normal, depth, 1.0f, vec3(light)};
}

/// Points of one light in the middle of a cell, so that a cell that moves by half keeps them.
std::vector<SharedPoint> heap(int count, const SharedPoint& point) {
    return std::vector<SharedPoint>(size_t(count), point);
}

vec3 lightAt(const SharedLight& shared, const SharedPoint& at) {
    vec3 light(-1.0f);
    EXPECT_TRUE(shared.find(at, vec2(0.5f), light));
    return light;
}

bool isDark(const SharedLight& shared, const SharedPoint& at) {
    vec3 light(0.0f);
    return !shared.find(at, vec2(0.5f), light);
}

std::vector<SharedPoint> operator+(std::vector<SharedPoint> a, const std::vector<SharedPoint>& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

} // namespace

TEST(SharedLight, IsTheMeanOfWhatFewAreNotEnoughFor) {
    const SharedPoint low = pointAt(vec3(0.5f), up, 1.0f), high = pointAt(vec3(0.5f), up, 3.0f);
    EXPECT_EQ(lightAt(SharedLight(heap(least, low) + heap(least, high), 1.0f), low), vec3(2.0f));
    EXPECT_EQ(lightAt(SharedLight(heap(least, low), 1.0f), low), vec3(1.0f));
    EXPECT_TRUE(isDark(SharedLight(heap(least - 1, low), 1.0f), low));
    EXPECT_TRUE(isDark(SharedLight({}, 1.0f), low));
    EXPECT_TRUE(isDark(SharedLight(), low));
}

TEST(SharedLight, SidesAxesDepthsAndPlacesAreApart) {
    const SharedPoint here = pointAt(vec3(0.5f), up, 1.0f);
    const SharedPoint others[] = {pointAt(vec3(0.5f), -up, 2.0f),
                                  pointAt(vec3(0.5f), vec3(1, 0, 0), 3.0f),
                                  pointAt(vec3(0.5f), vec3(0, 0, -1), 4.0f),
                                  pointAt(vec3(0.5f), up, 5.0f, 2),
                                  pointAt(vec3(5.5f, 0.5f, 0.5f), up, 6.0f),
                                  pointAt(vec3(0.5f, -3.5f, 0.5f), up, 7.0f)};
    SharedPoint bent = pointAt(vec3(0.5f), up, 8.0f); // by a map
    bent.normal = glm::normalize(vec3(0.6f, 1.0f, 0.0f));
    std::vector<SharedPoint> points = heap(least, here) + heap(least, bent);
    for (const SharedPoint& other : others)
        points = points + heap(least, other);
    const SharedLight shared(points, 1.0f);
    EXPECT_EQ(lightAt(shared, here), vec3(1.0f));
    EXPECT_EQ(lightAt(shared, bent), bent.light);
    for (const SharedPoint& other : others)
        EXPECT_EQ(lightAt(shared, other), other.light);
}

TEST(SharedLight, NarrowConesReadNarrowCells) {
    // Light falls off along x. The mean of a cell differs from it by half a cell at most.
    std::mt19937 random(5);
    std::uniform_real_distribution<float> place(0.0f, 4.0f);
    std::vector<SharedPoint> points;
    for (int i = 0; i < 100000; ++i) {
        const vec3 at(place(random), 0.0f, place(random));
        points.push_back(pointAt(at, up, at.x));
    }
    const SharedLight shared(points, 1.0f);
    for (const float width : {1.0f, 0.25f, 0.06f}) {
        for (int i = 0; i < 100; ++i) {
            SharedPoint at = pointAt(vec3(place(random), 0.0f, place(random)), up, 0.0f);
            at.width = width;
            vec3 light = at.position;
            ASSERT_TRUE(shared.find(at, vec2(0.5f), light) || width < 0.1f);
            EXPECT_LE(std::abs(light.x - at.position.x), width);
        }
    }
    SharedPoint at = pointAt(vec3(2.0f, 0.0f, 2.0f), up, 0.0f);
    at.width = 1e-4f; // no cell is so narrow
    EXPECT_TRUE(isDark(shared, at));
    // Where there are many points, wide cones read narrow cells, too.
    EXPECT_LE(std::abs(lightAt(shared, pointAt(vec3(2.0f, 0.0f, 2.0f), up, 0.0f)).x - 2.0f), 0.13f);
}

TEST(SharedLight, CellsMoveWithinTheirSurface) {
    std::vector<SharedPoint> points;
    for (int x = -8; x < 8; ++x)
        points = points + heap(4 * least, pointAt(vec3(float(x) + 0.5f, 0.0f, 0.5f), up, float(x)));
    const SharedLight shared(points, 1.0f);
    const SharedPoint at = pointAt(vec3(0.5f, 0.0f, 0.5f), up, 0.0f);
    int borders = 0;
    for (int i = 0; i < 1000; ++i) {
        vec3 light;
        const vec2 u((float(i % 32) + 0.5f) / 32.0f, (float(i / 32) + 0.5f) / 32.0f);
        ASSERT_TRUE(shared.find(at, u, light));
        EXPECT_EQ(light, vec3(0.0f)); // half a cell to either side is the same cell
        SharedPoint border = at;
        border.position.x = 1.0f;
        if (shared.find(border, u, light)) borders += light.x == 1.0f;
    }
    EXPECT_NEAR(borders, 500, 32); // one step of u
}

TEST(SharedLight, TakesAnythingThatPathsFind) {
    const SharedPoint far = pointAt(vec3(3e38f, -1e30f, 0.0f), up, 1.0f);
    SharedPoint narrow = pointAt(vec3(0.0f), up, 1.0f);
    narrow.width = 0.0f;
    EXPECT_EQ(lightAt(SharedLight(heap(least, far), 1.0f), far), vec3(1.0f));
    EXPECT_TRUE(isDark(SharedLight(heap(least, narrow), 1.0f), narrow));
    const SharedPoint deep = pointAt(vec3(0.0f), up, 1.0f, SharedPoint::mostDepth + 1);
    EXPECT_TRUE(isDark(SharedLight(heap(least, deep), 1.0f), deep));
    for (const vec3& normal : {vec3(0.0f), vec3(NAN)}) {
        SharedPoint bad = pointAt(vec3(0.5f), up, 1.0f);
        bad.normal = normal;
        EXPECT_TRUE(isDark(SharedLight(heap(least, bad), 1.0f), bad));
    }
    SharedPoint wide = pointAt(vec3(0.5f), up, 1.0f);
    wide.width = INFINITY;
    EXPECT_EQ(lightAt(SharedLight(heap(least, wide), 1.0f), wide), vec3(1.0f));
}

} // namespace patina
