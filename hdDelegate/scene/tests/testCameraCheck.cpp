// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/scene/cameraCheck.h"
#include "hdDelegate/scene/scene.h"

#include <gtest/gtest.h>

#include <cmath>

namespace patina {
namespace {

std::shared_ptr<const Camera> taken(Scene& scene, const Camera& camera) {
    scene.edit().set(std::make_shared<const Camera>(camera));
    return scene.snapshot()->cameras.at(camera.path);
}

Camera plain() {
    Camera camera;
    camera.path = "/camera";
    camera.fStop = 2.8f;
    camera.focusDistance = 5.0f;
    camera.clippingPlanes = {vec4(0, 0, 1, 10)};
    return camera;
}

TEST(CameraCheck, SoundCamerasAreTheSameObject) {
    Scene scene;
    auto camera = std::make_shared<const Camera>(plain());
    scene.edit().set(camera);
    EXPECT_EQ(scene.snapshot()->cameras.at("/camera"), camera);
    EXPECT_EQ(scene.diagnostics().count(), 0);
}

TEST(CameraCheck, WhatNoRayCanBeMadeOfIsReplacedByName) {
    const float nan = std::nanf(""), inf = INFINITY;
    const auto expect = [](const Camera& camera, const std::string& input, auto&& sound) {
        Scene scene;
        const auto result = taken(scene, camera);
        EXPECT_TRUE(sound(*result)) << input;
        ASSERT_EQ(scene.diagnostics().count(), 1) << input;
        EXPECT_EQ(scene.diagnostics().all()[0].prim, "/camera");
        EXPECT_EQ(scene.diagnostics().all()[0].input, input);
    };
    Camera c = plain();
    c.focusDistance = 1e20f;
    expect(c, "focusDistance", [](const Camera& r) { return r.focusDistance == 1e15f; });
    c.focusDistance = nan;
    expect(c, "focusDistance", [](const Camera& r) { return r.focusDistance == 0.0f; });
    for (float stop : {1e-30f, nan, inf}) {
        c = plain();
        c.fStop = stop;
        expect(c, "fStop", [](const Camera& r) { return r.fStop == 0.0f; });
    }
    c = plain();
    c.clipNear = nan;
    expect(c, "clippingRange", [](const Camera& r) { return r.clipNear == 0.0f; });
    c = plain();
    c.clipFar = inf;
    expect(c, "clippingRange", [](const Camera& r) { return r.clipFar == 1e15f; });
    c = plain();
    c.clippingPlanes.push_back(vec4(nan, 0, 0, 1));
    expect(c, "clippingPlanes", [](const Camera& r) { return r.clippingPlanes.size() == 1; });
    c = plain();
    c.horizontalAperture = inf;
    expect(c, "horizontalAperture",
           [](const Camera& r) { return r.horizontalAperture == Camera().horizontalAperture; });
}

TEST(CameraCheck, ARangeThatEndsBeforeItStartsIsTold) {
    Diagnostics diagnostics;
    auto camera = std::make_shared<Camera>();
    camera->path = "/camera";
    camera->clipNear = 5.0f;
    camera->clipFar = 1.0f;
    const auto checked = checkedCamera(camera, diagnostics);
    EXPECT_EQ(checked->clipNear, 5.0f);
    ASSERT_EQ(diagnostics.count(), 1);
    EXPECT_EQ(diagnostics.all()[0].input, "clippingRange");
    camera->clipFar = 5.5f;
    diagnostics.clear();
    checkedCamera(camera, diagnostics);
    EXPECT_EQ(diagnostics.count(), 0);
}

TEST(TransformCheck, PrimsThatStandNowhereAreLeftOutByName) {
    Scene scene;
    const auto set = [&](double height) {
        auto ball = std::make_shared<Implicit>();
        ball->path = "/ball";
        ball->transform.values[0][3].y = height;
        scene.edit().set(std::shared_ptr<const Geometry>(ball));
        auto light = std::make_shared<Light>();
        light->path = "/light";
        light->transform.values[0][3].y = height;
        scene.edit().set(std::shared_ptr<const Light>(light));
    };
    set(1e14);
    EXPECT_EQ(scene.snapshot()->geometry.size(), 1u);
    EXPECT_EQ(scene.diagnostics().count(), 0);
    for (double height : {1e19, 1e300, double(INFINITY), double(NAN)}) {
        scene.diagnostics().clear();
        set(height); // what was there before goes, too
        EXPECT_TRUE(scene.snapshot()->geometry.empty());
        EXPECT_TRUE(scene.snapshot()->lights.empty());
        ASSERT_EQ(scene.diagnostics().count(), 2);
        EXPECT_EQ(scene.diagnostics().all()[0].prim, "/ball");
        EXPECT_EQ(scene.diagnostics().all()[1].prim, "/light");
    }
}

} // namespace
} // namespace patina
