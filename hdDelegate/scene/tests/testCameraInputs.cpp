// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/scene/cameraInputs.h"

#include "hdDelegate/scene/primCompare.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace patina {
namespace {

struct Read {
    CameraLens lens;
    std::vector<Diagnostic> told;
};

Read read(const Marks& inputs) {
    Camera camera;
    camera.path = "/camera";
    Diagnostics diagnostics;
    applyCameraInputs(inputs, camera, diagnostics);
    return {camera.lens, diagnostics.all()};
}

TEST(CameraInputs, NamesAreThereOnce) {
    const std::vector<std::string> names = cameraInputNames();
    EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
}

TEST(CameraInputs, WithoutAnyACameraIsAsItWas) {
    const Read found = read({});
    EXPECT_EQ(found.lens, CameraLens());
    EXPECT_TRUE(found.told.empty());
}

TEST(CameraInputs, EveryOwnInputHasItsField) {
    const Read found = read({{"patina:projection", "fisheyeEquisolid"},
                             {"patina:fieldOfView", 200.0},
                             {"patina:verticalFieldOfView", 90.0},
                             {"patina:apertureBlades", 7.0},
                             {"patina:apertureBladeCurvature", -0.5},
                             {"patina:apertureRotation", 30.0},
                             {"patina:apertureAspect", 2.0},
                             {"patina:stereo", "overUnder"},
                             {"patina:interocularDistance", 6.5},
                             {"patina:convergenceDistance", 300.0},
                             {"patina:distortionMap", "/map.exr"},
                             {"patina:distortionK1", 0.1},
                             {"patina:distortionK2", -0.2}});
    CameraLens expected;
    expected.projection = LensProjection::FisheyeEquisolid;
    expected.fieldOfView = 200.0f;
    expected.verticalFieldOfView = 90.0f;
    expected.apertureBlades = 7;
    expected.apertureBladeCurvature = -0.5f;
    expected.apertureRotation = 30.0f;
    expected.apertureAspect = 2.0f;
    expected.stereo = StereoView::OverUnder;
    expected.interocularDistance = 6.5f;
    expected.convergenceDistance = 300.0f;
    expected.distortionMap = "/map.exr";
    expected.distortionK1 = 0.1f;
    expected.distortionK2 = -0.2f;
    EXPECT_EQ(found.lens, expected);
    EXPECT_TRUE(found.told.empty());
}

TEST(CameraInputs, OtherRenderersNames) {
    EXPECT_EQ(read({{"arnold:camera", "fisheye_camera"}, {"arnold:fov", 90.0}}).lens.fieldOfView,
              90.0f);
    // A perspective camera's field of view follows from its aperture and focal length.
    EXPECT_EQ(read({{"arnold:camera", "persp_camera"}, {"arnold:fov", 54.0}}).lens, CameraLens());
    const CameraLens pair =
        read({{"arnold:camera", "vr_camera"}, {"arnold:eye_separation", 6.0}}).lens;
    EXPECT_EQ(pair.projection, LensProjection::Spherical);
    EXPECT_EQ(pair.stereo, StereoView::SideBySide);
    EXPECT_EQ(read({{"ri:apertureNSides", 5.0}}).lens.apertureBlades, 5);
    EXPECT_EQ(
        read({{"arnold:aperture_blades", 5.0}, {"patina:apertureBlades", 6.0}}).lens.apertureBlades,
        6);
}

TEST(CameraInputs, WhatNoCameraTakesIsToldAndLeftOut) {
    const double nan = std::nan("");
    const Marks bad[] = {
        {{"patina:apertureBlades", 1e9}},      {{"patina:apertureBlades", nan}},
        {{"patina:apertureBlades", "seven"}},  {{"patina:fieldOfView", 0.0}},
        {{"patina:fieldOfView", nan}},         {{"patina:fieldOfView", 361.0}},
        {{"patina:convergenceDistance", 0.0}}, {{"patina:convergenceDistance", -3.0}},
        {{"patina:interocularDistance", nan}}, {{"patina:apertureAspect", 0.0}},
        {{"patina:distortionK1", INFINITY}},   {{"patina:distortionMap", 1.0}},
        {{"patina:projection", "fish"}},       {{"patina:projection", 3.0}},
        {{"patina:stereo", "both"}},           {{"arnold:camera", "mycamera"}}};
    for (const Marks& inputs : bad) {
        const Read found = read(inputs);
        const std::string& name = inputs.begin()->first;
        EXPECT_EQ(found.lens, CameraLens()) << name;
        ASSERT_EQ(found.told.size(), 1u) << name;
        EXPECT_EQ(found.told[0].prim, "/camera");
        EXPECT_EQ(found.told[0].input, name);
        EXPECT_NE(found.told[0].message.find("is left out"), std::string::npos);
    }
    EXPECT_EQ(read({{"patina:projection", "fish"}}).told[0].message.find("is 'fish', not one of "),
              0u);
}

TEST(CameraInputs, WhatOneProjectionCannotShowIsLimited) {
    const Read flat =
        read({{"patina:projection", "cylindrical"}, {"patina:verticalFieldOfView", 180.0}});
    EXPECT_EQ(flat.lens.verticalFieldOfView, 179.0f);
    ASSERT_EQ(flat.told.size(), 1u);
    const Read behind =
        read({{"patina:projection", "fisheyeStereographic"}, {"patina:fieldOfView", 360.0}});
    EXPECT_EQ(behind.lens.fieldOfView, 340.0f);
    ASSERT_EQ(behind.told.size(), 1u);
    EXPECT_EQ(behind.told[0].input, "patina:fieldOfView");
    const Read same = read({{"patina:stereo", "left"}});
    ASSERT_EQ(same.told.size(), 1u);
    EXPECT_EQ(same.told[0].input, "patina:interocularDistance");
}

TEST(CameraInputs, ImagesHaveTheShapeOfTheFilm) {
    Camera camera;
    camera.horizontalAperture = 30.0f;
    camera.verticalAperture = 20.0f;
    EXPECT_EQ(imageAspect(camera), 1.5);
    camera.lens.stereo = StereoView::SideBySide;
    EXPECT_EQ(imageAspect(camera), 3.0);
    camera.lens.projection = LensProjection::Spherical;
    camera.lens.stereo = StereoView::OverUnder;
    EXPECT_NEAR(imageAspect(camera), 1.0, 1e-6);
}

TEST(CameraInputs, AnotherLensIsAnotherCamera) {
    Camera camera, other;
    EXPECT_TRUE(sameCamera(camera, other));
    other.lens.distortionMap = "/map.exr";
    EXPECT_FALSE(sameCamera(camera, other));
}

} // namespace
} // namespace patina
