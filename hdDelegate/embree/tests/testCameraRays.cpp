// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/cameraRays.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

using namespace patina;

namespace {

RenderSettings squareImage() {
    RenderSettings settings;
    settings.width = settings.height = 100;
    return settings;
}

Camera squareCamera() {
    Camera camera;
    camera.horizontalAperture = camera.verticalAperture = 20.0f;
    camera.focalLength = 20.0f;
    camera.clipNear = 0.5f;
    camera.clipFar = 100.0f;
    return camera;
}

void expectNear(const vec3& a, const vec3& b, float tolerance = 1e-5f) {
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(a[c], b[c], tolerance);
}

} // namespace

TEST(CameraRays, CornersOfAPinhole) {
    const CameraRays rays(squareCamera(), squareImage());
    expectNear(rays.ray({50, 50}, {0, 0}, 0).direction, vec3(0, 0, -1));
    expectNear(rays.ray({0, 0}, {0, 0}, 0).direction, glm::normalize(vec3(-0.5f, 0.5f, -1)));
    expectNear(rays.ray({100, 100}, {0, 0}, 0).direction, glm::normalize(vec3(0.5f, -0.5f, -1)));
}

TEST(CameraRays, ClippingRangeIsMeasuredAlongTheAxis) {
    const CameraRays rays(squareCamera(), squareImage());
    const CameraRay ray = rays.ray({0, 50}, {0, 0}, 0);
    EXPECT_NEAR((ray.direction * ray.near).z, -0.5f, 1e-5f);
    EXPECT_NEAR((ray.direction * ray.far).z, -100.0f, 1e-3f);
}

TEST(CameraRays, ClippingPlaneCutsTheNearSide) {
    Camera camera = squareCamera();
    camera.clippingPlanes.push_back(vec4(0, 0, -1, -3)); // keeps z < -3
    const CameraRay ray = CameraRays(camera, squareImage()).ray({50, 50}, {0, 0}, 0);
    EXPECT_NEAR(ray.near, 3.0f, 1e-5f);
}

TEST(CameraRays, ApertureOffsetShiftsTheWindow) {
    Camera camera = squareCamera();
    camera.horizontalApertureOffset = 10.0f;
    const CameraRays rays(camera, squareImage());
    expectNear(rays.ray({0, 50}, {0, 0}, 0).direction, vec3(0, 0, -1));
}

TEST(CameraRays, OrthographicApertureIsInTenthsOfAUnit) {
    Camera camera = squareCamera();
    camera.orthographic = true;
    const CameraRay ray = CameraRays(camera, squareImage()).ray({0, 0}, {0, 0}, 0);
    expectNear(ray.origin, vec3(-1, 1, 0));
    expectNear(ray.direction, vec3(0, 0, -1));
}

TEST(CameraRays, LensKeepsTheFocusPlaneSharp) {
    Camera camera = squareCamera();
    camera.fStop = 2.0f;
    camera.focusDistance = 7.0f;
    const CameraRays rays(camera, squareImage());
    for (float u : {0.05f, 0.4f, 0.9f}) {
        const CameraRay ray = rays.ray({20, 70}, {u, 0.3f}, 0);
        const vec3 atFocus = ray.origin + ray.direction * (-7.0f / ray.direction.z);
        expectNear(atFocus, vec3(-0.3f, -0.2f, -1) * 7.0f, 1e-4f);
        EXPECT_LE(glm::length(ray.origin), 0.5f * 2.0f / 2.0f + 1e-6f); // focal 2 units, f/2
    }
}

TEST(CameraRays, ConformPolicies) {
    RenderSettings wide = squareImage();
    wide.width = 200;
    const auto window = [&](const char* policy) {
        wide.aspectRatioConformPolicy = policy;
        const CameraRays rays(squareCamera(), wide);
        const vec3 d = rays.ray({200, 0}, {0, 0}, 0).direction;
        return vec2(d.x / -d.z, d.y / -d.z);
    };
    EXPECT_NEAR(window("adjustApertureHeight").y, 0.25f, 1e-5f);
    EXPECT_NEAR(window("adjustApertureWidth").x, 1.0f, 1e-5f);
    EXPECT_NEAR(window("expandAperture").x, 1.0f, 1e-5f);
    EXPECT_NEAR(window("cropAperture").y, 0.25f, 1e-5f);
    EXPECT_NEAR(window("adjustPixelAspectRatio").y, 0.5f, 1e-5f);
}

TEST(CameraRays, MovingCameraInterpolatesOverTheShutter) {
    Camera camera = squareCamera();
    camera.transform.times = {0.0f, 1.0f};
    camera.transform.values = {mat4(1.0f), glm::translate(mat4(1.0f), vec3(4, 0, 0))};
    camera.shutterOpen = 0.0;
    camera.shutterClose = 0.5;
    const CameraRays rays(camera, squareImage());
    expectNear(rays.ray({50, 50}, {0, 0}, 0.0f).origin, vec3(0));
    expectNear(rays.ray({50, 50}, {0, 0}, 1.0f).origin, vec3(2, 0, 0));
}

TEST(CameraRays, WindowDepthRunsFromNearToFar) {
    const CameraRays rays(squareCamera(), squareImage());
    EXPECT_NEAR(rays.windowDepth({0, 0, -0.5f}), 0.0f, 1e-6f);
    EXPECT_NEAR(rays.windowDepth({0, 0, -100.0f}), 1.0f, 1e-6f);
}
