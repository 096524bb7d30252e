// SPDX-License-Identifier: Apache-2.0
// Culling leaves out what no view shows, and nothing else.

#include "hdDelegate/geometry/mortonOrder.h"
#include "hdDelegate/raster/scene/rasterCulling.h"
#include "hdDelegate/scene/tests/prims.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

using namespace patina;

namespace {

bool isInside(const mat4& worldToClip, const vec3& p) {
    const vec4 q = worldToClip * vec4(p, 1.0f);
    return std::max({std::abs(q.x), std::abs(q.y), std::abs(q.z)}) <= q.w;
}

const mat4 views[] = {
    glm::perspective(0.7f, 1.6f, 0.1f, 50.0f) *
        glm::lookAt(vec3(3, 2, 8), vec3(0.0f), vec3(0, 1, 0)),
    glm::ortho(-4.0f, 2.0f, -3.0f, 3.0f, -5.0f, 9.0f) *
        glm::lookAt(vec3(1, 5, 1), vec3(0.0f), vec3(0, 0, 1)),
};

} // namespace

TEST(RasterCulling, KeepsEveryBoxWithAPointInView) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> at(-20.0f, 20.0f), size(0.0f, 3.0f), in(-1.0f, 1.0f);
    for (const mat4& view : views) {
        const RasterFrustum frustum(view);
        int seen = 0, missed = 0;
        for (int i = 0; i < 20000; ++i) {
            const RasterBox box{vec3(at(random), at(random), at(random)),
                                vec3(size(random), size(random), size(random))};
            bool visible = false;
            for (int k = 0; k < 8 && !visible; ++k)
                visible = isInside(view, box.center +
                                             box.half * vec3(in(random), in(random), in(random)));
            const bool misses = frustum.misses(box);
            EXPECT_FALSE(visible && misses);
            seen += visible;
            missed += misses;
        }
        EXPECT_GT(seen, 100);
        EXPECT_GT(missed, 10000); // most boxes are outside: culling does something
    }
}

TEST(RasterCulling, BoxesThatAreNotNumbersAreDrawn) {
    EXPECT_FALSE(RasterFrustum(views[0]).misses({vec3(NAN), vec3(1.0f)}));
    EXPECT_FALSE(RasterFrustum(views[0]).misses({vec3(0.0f), vec3(INFINITY)}));
}

TEST(RasterCulling, RunsHoldWhatIsSeenAndShortGaps) {
    std::vector<RasterBox> boxes;
    for (const float x : {0.0f, 0.1f, 100.0f, 0.2f, 100.0f, 100.0f, 100.0f, 0.3f})
        boxes.push_back({vec3(x, 0.0f, 0.0f), vec3(0.01f)});
    std::vector<RasterRun> runs;
    visibleRuns(RasterFrustum(views[0]), boxes, 0, 8, 1, runs);
    ASSERT_EQ(runs.size(), 2u);
    EXPECT_EQ(runs[0].first, 0);
    EXPECT_EQ(runs[0].count, 4);
    EXPECT_EQ(runs[1].first, 7);
    EXPECT_EQ(runs[1].count, 1);
    runs.clear();
    visibleRuns(RasterFrustum(views[0]), boxes, 4, 3, 1, runs);
    EXPECT_TRUE(runs.empty());
}

TEST(RasterCulling, TheBoxOfATransformedBoxHoldsItsCorners) {
    const mat4 m = glm::rotate(glm::scale(translate(4, -2, 1), vec3(2.0f, 0.5f, -1.0f)), 0.8f,
                               glm::normalize(vec3(1, 2, 3)));
    const vec3 low(-1, 0, 2), high(1, 4, 3);
    const RasterBox box = RasterBox::around(low, high, m);
    for (int i = 0; i < 8; ++i) {
        const vec3 corner(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
        const vec3 away = glm::abs(vec3(m * vec4(corner, 1.0f)) - box.center);
        for (int k = 0; k < 3; ++k)
            EXPECT_LE(away[k], box.half[k] + 1e-5f);
    }
}

TEST(RasterCulling, MortonOrderIsAnOrder) {
    std::vector<vec3> points = {{9, 9, 9}, {0, 0, 0}, {0.1f, 0, 0}, {9, 9, 8.9f}, {NAN, 9, 0}};
    std::vector<uint32_t> order = mortonOrder(points);
    const auto place = [&](uint32_t i) {
        return std::find(order.begin(), order.end(), i) - order.begin();
    };
    EXPECT_EQ(std::abs(place(1) - place(2)), 1);
    EXPECT_EQ(std::abs(place(0) - place(3)), 1);
    std::sort(order.begin(), order.end());
    for (uint32_t i = 0; i < 5; ++i)
        EXPECT_EQ(order[i], i);
}
