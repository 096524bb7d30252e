// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/compiled/screenMotion.h"
#include "hdDelegate/scene/tests/prims.h"

#include <gtest/gtest.h>

namespace patina {

namespace {

/// Sees as wide as it looks far, in 32 pixels.
Camera square() {
    Camera camera;
    camera.focalLength = camera.horizontalAperture = camera.verticalAperture = 50.0f;
    return camera;
}

RenderSettings pixels() {
    return imageOf(32, 32);
}

ScreenMotion motionOf(const Camera& camera) {
    return ScreenMotion(camera, CameraFrame(camera, pixels()));
}

} // namespace

TEST(ScreenMotion, CountsPixelsToTheRightAndDown) {
    const ScreenMotion motion = motionOf(square());
    float way[2];
    ASSERT_TRUE(motion.way({0, 0, -8}, {1, 2, -8}, ScreenMotion::After, way));
    EXPECT_FLOAT_EQ(way[0], 4.0f);
    EXPECT_FLOAT_EQ(way[1], -8.0f);
    ASSERT_TRUE(motion.way({1, 0, -8}, {1, 0, -4}, ScreenMotion::Before, way));
    EXPECT_FLOAT_EQ(way[0], 4.0f) << "what is half as far is twice as far out";
    EXPECT_FALSE(motion.way({0, 0, -8}, {0, 0, 1}, ScreenMotion::After, way)) << "behind";
}

TEST(ScreenMotion, FollowsTheCamera) {
    Camera camera = square();
    Sampled<dmat4> moves;
    moves.times = {-1.0f, 0.0f, 1.0f};
    for (const double x : {-0.5, 0.0, 2.0})
        moves.values.push_back(glm::translate(dmat4(1.0), dvec3(1e7 + x, 0, 0)));
    camera.transform = MotionTransform(moves);
    const ScreenMotion motion = motionOf(camera);
    const dvec3 place(1e7, 0, -8);
    float way[2];
    ASSERT_TRUE(motion.way(place, place, ScreenMotion::After, way));
    EXPECT_NEAR(way[0], -8.0f, 1e-6) << "with all digits, far from the origin";
    ASSERT_TRUE(motion.way(place, place, ScreenMotion::Before, way));
    EXPECT_NEAR(way[0], 2.0f, 1e-6);
}

/// A place at the distance of convergence has one place in both pictures; infinity moves apart.
TEST(ScreenMotion, SeesWithOneEye) {
    Camera camera = square();
    camera.lens.stereo = StereoView::Right;
    camera.lens.interocularDistance = 1.0f;
    camera.lens.convergenceDistance = 4.0f;
    const ScreenMotion motion = motionOf(camera);
    float way[2];
    ASSERT_TRUE(motion.way({0, 0, -4}, {0, 0, -1e12}, ScreenMotion::After, way));
    EXPECT_NEAR(way[0], 0.5 / 4.0 * 32.0, 1e-5);
    camera.lens.stereo = StereoView::SideBySide;
    EXPECT_FALSE(ScreenMotion::knows(camera));
    EXPECT_FALSE(motionOf(camera).way({0, 0, -4}, {1, 0, -4}, ScreenMotion::After, way));
}

TEST(ScreenMotion, OfAnOrthographicCameraDoesNotDependOnDistance) {
    Camera camera = square(); // five units wide
    camera.orthographic = true;
    float way[2];
    ASSERT_TRUE(motionOf(camera).way({0, 0, -8}, {1, 1, 3}, ScreenMotion::After, way));
    EXPECT_FLOAT_EQ(way[0], 6.4f);
    EXPECT_FLOAT_EQ(way[1], -6.4f);
}

} // namespace patina
