// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/scene/cameraCheck.h"
#include "hdDelegate/scene/scene.h"
#include "hdDelegate/scene/tests/prims.h"

#include "base/tests/testTools.h"

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
    const struct {
        const char* input;
        float Camera::*field;
        float bad, used;
    } cases[] = {
        {"focusDistance", &Camera::focusDistance, 1e20f, 1e15f},
        {"focusDistance", &Camera::focusDistance, nan, 0.0f},
        {"fStop", &Camera::fStop, 1e-30f, 0.0f},
        {"fStop", &Camera::fStop, nan, 0.0f},
        {"fStop", &Camera::fStop, inf, 0.0f},
        {"clippingRange", &Camera::clipNear, nan, 0.0f},
        {"clippingRange", &Camera::clipFar, inf, 1e15f},
        {"horizontalAperture", &Camera::horizontalAperture, inf, Camera().horizontalAperture},
    };
    const auto expectTold = [](Scene& scene, const std::string& input) {
        EXPECT_TRUE(has(onlyWarning(scene.diagnostics()), "/camera " + input + " ")) << input;
    };
    for (const auto& c : cases) {
        Scene scene;
        Camera camera = plain();
        camera.*c.field = c.bad;
        EXPECT_EQ((*taken(scene, camera)).*c.field, c.used) << c.input << " " << c.bad;
        expectTold(scene, c.input);
    }
    Scene scene;
    Camera camera = plain();
    camera.clippingPlanes.push_back(vec4(nan, 0, 0, 1));
    EXPECT_EQ(taken(scene, camera)->clippingPlanes.size(), 1u);
    expectTold(scene, "clippingPlanes");
}

TEST(CameraCheck, ARangeThatEndsBeforeItStartsIsTold) {
    Diagnostics diagnostics;
    auto camera = makePrim<Camera>("/camera");
    camera->clipNear = 5.0f;
    camera->clipFar = 1.0f;
    EXPECT_EQ(checkedCamera(camera, diagnostics)->clipNear, 5.0f);
    EXPECT_TRUE(has(onlyWarning(diagnostics), "/camera clippingRange "));
    camera->clipFar = 5.5f;
    diagnostics.clear();
    checkedCamera(camera, diagnostics);
    EXPECT_EQ(diagnostics.count(), 0);
}

TEST(TransformCheck, PrimsThatStandNowhereAreLeftOutByName) {
    Scene scene;
    const auto set = [&](double height) {
        dmat4 place(1.0);
        place[3].y = height;
        setPrims(scene, makePrim<Implicit>("/ball", place), makePrim<Light>("/light", place));
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
