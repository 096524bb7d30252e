// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/compiled/cameraFrame.h"
#include "hdDelegate/scene/tests/prims.h"

#include <gtest/gtest.h>

#include <cmath>

namespace patina {
namespace {

Camera camera(float width, float height) {
    Camera result;
    result.horizontalAperture = width;
    result.verticalAperture = height;
    result.focalLength = 50.0f;
    return result;
}

RenderSettings image(int width, int height, const std::string& policy) {
    RenderSettings settings = imageOf(width, height);
    settings.aspectRatioConformPolicy = policy;
    return settings;
}

/// Width and height of the window at distance 1.
vec2 window(const Camera& camera, const RenderSettings& settings) {
    const CameraFrame frame(camera, settings);
    return frame.windowMax - frame.windowMin;
}

void expectWindow(const std::string& policy, int width, int height, vec2 expected) {
    const vec2 found = window(camera(20, 10), image(width, height, policy));
    EXPECT_NEAR(found.x, expected.x, 1e-6f) << policy;
    EXPECT_NEAR(found.y, expected.y, 1e-6f) << policy;
}

// An aperture of 20 by 10 over a focal length of 50, in an image that is square or four times as
// wide as high.
TEST(CameraFrame, FitsTheApertureAsThePolicySays) {
    expectWindow("adjustApertureWidth", 100, 100, {0.2f, 0.2f});
    expectWindow("adjustApertureHeight", 100, 100, {0.4f, 0.4f});
    expectWindow("expandAperture", 100, 100, {0.4f, 0.4f});
    expectWindow("cropAperture", 100, 100, {0.2f, 0.2f});
    expectWindow("adjustPixelAspectRatio", 100, 100, {0.4f, 0.2f});
    expectWindow("adjustApertureWidth", 400, 100, {0.8f, 0.2f});
    expectWindow("adjustApertureHeight", 400, 100, {0.4f, 0.1f});
    expectWindow("expandAperture", 400, 100, {0.8f, 0.2f});
    expectWindow("cropAperture", 400, 100, {0.4f, 0.1f});
}

TEST(CameraFrame, OffsetsMoveTheWindow) {
    Camera moved = camera(20, 10);
    moved.horizontalApertureOffset = 5;
    const CameraFrame frame(moved, image(200, 100, "adjustApertureHeight"));
    EXPECT_NEAR(frame.windowMin.x, -0.1f, 1e-6f);
    EXPECT_NEAR(frame.windowMax.x, 0.3f, 1e-6f);
    EXPECT_NEAR(frame.pixelSpread(), 0.4f / 200.0f, 1e-8f);
}

TEST(CameraFrame, HasALensWhereSomethingIsInFocus) {
    Camera lens = camera(20, 10);
    RenderSettings settings = image(200, 100, "expandAperture");
    lens.fStop = 2.0f;
    EXPECT_EQ(CameraFrame(lens, settings).lensRadius, 0.0f) << "no distance is in focus";
    lens.focusDistance = 3.0f;
    EXPECT_NEAR(CameraFrame(lens, settings).lensRadius, 0.5f * 5.0f / 2.0f, 1e-6f);
    settings.enableDepthOfField = false;
    EXPECT_EQ(CameraFrame(lens, settings).lensRadius, 0.0f);
    settings.enableDepthOfField = true;
    lens.orthographic = true;
    EXPECT_EQ(CameraFrame(lens, settings).lensRadius, 0.0f);
    const CameraFrame flat(lens, settings);
    EXPECT_NEAR(flat.windowMax.x - flat.windowMin.x, 2.0f, 1e-6f) << "scene units";
}

TEST(CameraFrame, StandsStillWithoutMotionBlur) {
    Camera moving = camera(20, 10);
    moving.shutterOpen = -0.25;
    moving.shutterClose = 0.25;
    RenderSettings settings;
    EXPECT_FLOAT_EQ(CameraFrame(moving, settings).timeCode(0.5f), 0.0f);
    settings.enableMotionBlur = false;
    EXPECT_FLOAT_EQ(CameraFrame(moving, settings).timeCode(0.5f), 0.0f) << "the frame's time";
    EXPECT_FLOAT_EQ(CameraFrame(moving, settings).shutterLength, 0.0f);
    moving.shutterOpen = 0.125;
    EXPECT_FLOAT_EQ(CameraFrame(moving, settings).timeCode(0.5f), 0.0f) << "not where it opens";
}

TEST(OriginNear, StaysWhereWhatIsSeenIsNotFarAway) {
    EXPECT_EQ(originNear(dvec3(59, 0, 0), 1.0, 60.0, 8.0), dvec3(0.0));
    EXPECT_EQ(originNear(dvec3(1e6, 0, 0), 0.0, 60.0, 8.0), dvec3(0.0)) << "nothing is seen";
    EXPECT_EQ(originNear(dvec3(NAN, 1e9, 0), 1.0, 60.0, 8.0), dvec3(0.0));
    EXPECT_EQ(originNear(dvec3(1e9), INFINITY, 60.0, 8.0), dvec3(0.0));
}

TEST(OriginNear, IsACornerOfAGridNearWhatIsSeen) {
    const dvec3 middle(1000.3, -77.0, 12.6);
    const dvec3 origin = originNear(middle, 1.0, 60.0, 8.0);
    for (int i = 0; i < 3; ++i) {
        EXPECT_EQ(std::fmod(origin[i], 8.0), 0.0);
        EXPECT_LE(std::abs(origin[i] - middle[i]), 4.0);
    }
    EXPECT_EQ(originNear(middle + dvec3(0.5), 1.0, 60.0, 8.0), origin) << "a small move";
}

} // namespace
} // namespace patina
