// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/cameraRays.h"
#include "hdDelegate/scene/tests/prims.h"

#include <glm/gtc/constants.hpp>
#include <gtest/gtest.h>

#include <cmath>

using namespace patina;

namespace {

constexpr float pi = glm::pi<float>();
const RenderSettings square = imageOf(100, 100);

/// Its aperture is as wide as its focal length, and square.
Camera cameraOf(LensProjection projection) {
    Camera camera;
    camera.horizontalAperture = camera.verticalAperture = 20.0f;
    camera.focalLength = 20.0f;
    camera.clipNear = 0.5f;
    camera.clipFar = 100.0f;
    camera.lens.projection = projection;
    return camera;
}

CameraRay rayOf(const Camera& camera, const RenderSettings& settings, vec2 pixel,
                vec2 lens = vec2(0.5f)) {
    return CameraRays(camera, settings).ray(pixel, lens, 0.0f);
}

void expectNear(const vec3& a, const vec3& b, float tolerance = 1e-5f) {
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(a[c], b[c], tolerance);
}

/// Where a point in front of the camera is on the film: pixels from the left, by bisection.
float columnOf(const Camera& camera, const RenderSettings& settings, vec3 point, float y, float low,
               float high) {
    for (int i = 0; i < 40; ++i) {
        const float x = 0.5f * (low + high);
        const CameraRay ray = rayOf(camera, settings, {x, y});
        const float t = (point.z - ray.origin.z) / ray.direction.z;
        (ray.origin.x + t * ray.direction.x < point.x ? low : high) = x;
    }
    return low;
}

} // namespace

TEST(CameraRays, CornersOfAPinhole) {
    const CameraRays rays(cameraOf(LensProjection::Standard), square);
    expectNear(rays.ray({50, 50}, {0, 0}, 0).direction, vec3(0, 0, -1));
    expectNear(rays.ray({0, 0}, {0, 0}, 0).direction, glm::normalize(vec3(-0.5f, 0.5f, -1)));
    expectNear(rays.ray({100, 100}, {0, 0}, 0).direction, glm::normalize(vec3(0.5f, -0.5f, -1)));
}

TEST(CameraRays, ClippingRangeIsMeasuredAlongTheAxis) {
    const CameraRay ray = rayOf(cameraOf(LensProjection::Standard), square, {0, 50});
    EXPECT_NEAR((ray.direction * ray.near).z, -0.5f, 1e-5f);
    EXPECT_NEAR((ray.direction * ray.far).z, -100.0f, 1e-3f);
}

TEST(CameraRays, ClippingPlaneCutsTheNearSide) {
    Camera camera = cameraOf(LensProjection::Standard);
    camera.clippingPlanes.push_back(vec4(0, 0, -1, -3)); // keeps z < -3
    const CameraRay ray = rayOf(camera, square, {50, 50});
    EXPECT_NEAR(ray.near, 3.0f, 1e-5f);
}

TEST(CameraRays, OrthographicApertureIsInTenthsOfAUnit) {
    Camera camera = cameraOf(LensProjection::Standard);
    camera.orthographic = true;
    const CameraRay ray = rayOf(camera, square, {0, 0});
    expectNear(ray.origin, vec3(-1, 1, 0));
    expectNear(ray.direction, vec3(0, 0, -1));
}

TEST(CameraRays, MovingCameraInterpolatesOverTheShutter) {
    Camera camera = cameraOf(LensProjection::Standard);
    camera.transform.times = {0.0f, 1.0f};
    camera.transform.values = {mat4(1.0f), translate(4, 0, 0)};
    camera.shutterOpen = 0.0;
    camera.shutterClose = 0.5;
    const CameraRays rays(camera, square);
    expectNear(rays.ray({50, 50}, {0, 0}, 0.0f).origin, vec3(0));
    expectNear(rays.ray({50, 50}, {0, 0}, 1.0f).origin, vec3(2, 0, 0));
}

TEST(CameraRays, WindowDepthRunsFromNearToFar) {
    const CameraRays rays(cameraOf(LensProjection::Standard), square);
    EXPECT_NEAR(rays.windowDepth({0, 0, -0.5f}), 0.0f, 1e-6f);
    EXPECT_NEAR(rays.windowDepth({0, 0, -100.0f}), 1.0f, 1e-6f);
}

TEST(LensRays, FisheyesHaveTheirAngles) {
    const float r = 0.6f; // of the circle's radius
    const auto angle = [&](LensProjection projection, float field) {
        Camera camera = cameraOf(projection);
        camera.lens.fieldOfView = field;
        const vec3 d = rayOf(camera, square, {50.0f + 50.0f * r, 50.0f}).direction;
        EXPECT_NEAR(d.y, 0.0f, 1e-5f);
        return std::atan2(d.x, -d.z);
    };
    for (float field : {60.0f, 180.0f, 300.0f}) {
        const float half = glm::radians(0.5f * field);
        EXPECT_NEAR(angle(LensProjection::FisheyeEquidistant, field), r * half, 1e-5f);
        EXPECT_NEAR(std::sin(0.5f * angle(LensProjection::FisheyeEquisolid, field)),
                    r * std::sin(0.5f * half), 1e-5f);
        EXPECT_NEAR(std::tan(0.5f * angle(LensProjection::FisheyeStereographic, field)),
                    r * std::tan(0.5f * half), 2e-5f);
    }
}

TEST(LensRays, BeyondAFisheyesCircleIsNothing) {
    Camera camera = cameraOf(LensProjection::FisheyeEquidistant);
    EXPECT_FALSE(rayOf(camera, square, {0, 0}).seen);
    EXPECT_TRUE(rayOf(camera, square, {50, 0.01f}).seen);
    // The shorter side has the circle, and the aperture's offset moves it.
    camera.horizontalAperture = 40.0f;
    EXPECT_FALSE(rayOf(camera, imageOf(200, 100), {49, 50}).seen);
    EXPECT_TRUE(rayOf(camera, imageOf(200, 100), {51, 50}).seen);
    camera.horizontalApertureOffset = 10.0f;
    expectNear(rayOf(camera, imageOf(200, 100), {50, 50}).direction, vec3(0, 0, -1));
}

TEST(LensRays, SphericalFilmsGoAllAround) {
    const Camera camera = cameraOf(LensProjection::Spherical);
    const RenderSettings wide = imageOf(200, 100);
    expectNear(rayOf(camera, wide, {100, 50}).direction, vec3(0, 0, -1));
    expectNear(rayOf(camera, wide, {150, 50}).direction, vec3(1, 0, 0));
    expectNear(rayOf(camera, wide, {0, 50}).direction, vec3(0, 0, 1));
    expectNear(rayOf(camera, wide, {30, 0}).direction, vec3(0, 1, 0));
    expectNear(rayOf(camera, wide, {100, 75}).direction,
               vec3(0, -std::sqrt(0.5f), -std::sqrt(0.5f)));
}

TEST(LensRays, CylindersAreAPerspectiveUp) {
    Camera camera = cameraOf(LensProjection::Cylindrical);
    camera.lens.verticalFieldOfView = 90.0f;
    const vec3 d = rayOf(camera, imageOf(200, 100), {150, 25}).direction;
    expectNear(d, glm::normalize(vec3(1.0f, 0.5f, 0.0f)));
}

TEST(LensRays, DistancesCountFromTheCentre) {
    const Camera camera = cameraOf(LensProjection::Spherical);
    const CameraRay behind = rayOf(camera, imageOf(200, 100), {0, 50});
    EXPECT_FLOAT_EQ(behind.near, 0.5f);
    EXPECT_FLOAT_EQ(behind.far, 100.0f);
    const CameraFrame frame(camera, imageOf(200, 100));
    EXPECT_FLOAT_EQ(frame.depthOf({3, 0, 4}), 5.0f);
    EXPECT_NEAR(frame.windowDepth({0, 0, 100}), 1.0f, 1e-6f);
}

TEST(LensRays, PixelsHaveTheAngleBetweenNeighbours) {
    for (LensProjection projection :
         {LensProjection::FisheyeEquidistant, LensProjection::FisheyeEquisolid,
          LensProjection::FisheyeStereographic, LensProjection::Cylindrical,
          LensProjection::Spherical}) {
        Camera camera = cameraOf(projection);
        camera.lens.fieldOfView = 150.0f;
        const RenderSettings settings = imageOf(400, 400);
        const CameraRays rays(camera, settings);
        float smallest = INFINITY;
        for (int y = 5; y < 395; ++y) {
            const CameraRay a = rays.ray({200.0f, float(y)}, vec2(0.5f), 0.0f),
                            b = rays.ray({200.0f, float(y) + 1.0f}, vec2(0.5f), 0.0f);
            smallest =
                std::min(smallest, 2.0f * std::asin(0.5f * glm::length(a.direction - b.direction)));
        }
        const CameraRay a = rays.ray({200.0f, 200.0f}, vec2(0.5f), 0.0f),
                        b = rays.ray({201.0f, 200.0f}, vec2(0.5f), 0.0f);
        smallest =
            std::min(smallest, 2.0f * std::asin(0.5f * glm::length(a.direction - b.direction)));
        // Five rows are left out at the edge, over which the angle of a row changes by 3 % at most.
        EXPECT_NEAR(rays.pixelSpread() / smallest, 1.0f, 0.06f) << int(projection);
    }
}

TEST(LensRays, DisparityIsThatOfThePinholes) {
    Camera camera = cameraOf(LensProjection::Standard);
    camera.lens.interocularDistance = 0.4f;
    const RenderSettings large = imageOf(1000, 1000);
    for (float convergence : {0.0f, 5.0f}) {
        camera.lens.convergenceDistance = convergence;
        for (float depth : {2.0f, 5.0f, 20.0f}) {
            const vec3 point(0.3f, 0.0f, -depth);
            camera.lens.stereo = StereoView::Left;
            const float left = columnOf(camera, large, point, 500.0f, 0.0f, 1000.0f);
            camera.lens.stereo = StereoView::Right;
            const float right = columnOf(camera, large, point, 500.0f, 0.0f, 1000.0f);
            // The film is as wide as its distance: focal length times eyes over depth, in pixels.
            const float towards = convergence > 0.0f ? 1.0f / convergence : 0.0f;
            EXPECT_NEAR(left - right, 1000.0f * 0.4f * (1.0f / depth - towards), 0.05f);
        }
    }
}

TEST(LensRays, BothEyesShareTheImage) {
    Camera camera = cameraOf(LensProjection::Standard);
    camera.lens.interocularDistance = 0.4f;
    camera.lens.convergenceDistance = 3.0f;
    const auto single = [&](StereoView eye) {
        Camera one = camera;
        one.lens.stereo = eye;
        return rayOf(one, square, {30, 70});
    };
    const auto expectSame = [](const CameraRay& a, const CameraRay& b) {
        expectNear(a.origin, b.origin);
        expectNear(a.direction, b.direction);
    };
    camera.lens.stereo = StereoView::SideBySide;
    expectSame(rayOf(camera, imageOf(200, 100), {30, 70}), single(StereoView::Left));
    expectSame(rayOf(camera, imageOf(200, 100), {130, 70}), single(StereoView::Right));
    camera.lens.stereo = StereoView::OverUnder;
    expectSame(rayOf(camera, imageOf(100, 200), {30, 70}), single(StereoView::Left));
    expectSame(rayOf(camera, imageOf(100, 200), {30, 170}), single(StereoView::Right));
    // Where a pixel's filter reaches over the seam, it samples the pixel's own eye.
    const CameraRays rays(camera, imageOf(100, 200));
    EXPECT_LT(rays.ray({30, 101}, vec2(0.5f), 0.0f, {30, 99}).origin.x, 0.0f);
    EXPECT_GT(rays.ray({30, 101}, vec2(0.5f), 0.0f).origin.x, 0.0f);
}

TEST(LensRays, EyesGoRoundWhereTheFilmDoes) {
    Camera camera = cameraOf(LensProjection::Spherical);
    camera.lens.stereo = StereoView::Right;
    camera.lens.interocularDistance = 2.0f;
    for (float longitude : {-2.0f, 0.0f, 0.7f, 3.0f}) {
        const vec2 pixel((longitude / (2.0f * pi) + 0.5f) * 200.0f, 50.0f);
        const CameraRay ray = rayOf(camera, imageOf(200, 100), pixel);
        expectNear(ray.origin, vec3(std::cos(longitude), 0, std::sin(longitude)));
        expectNear(ray.direction, vec3(std::sin(longitude), 0, -std::cos(longitude)));
        camera.lens.convergenceDistance = 4.0f;
        const CameraRay near = rayOf(camera, imageOf(200, 100), pixel);
        const float t = std::sqrt(4.0f * 4.0f + 1.0f);
        expectNear(near.origin + near.direction * t, ray.direction * 4.0f, 1e-4f);
        camera.lens.convergenceDistance = 0.0f;
    }
}

TEST(LensRays, EveryLensIsFocused) {
    for (LensProjection projection :
         {LensProjection::Standard, LensProjection::FisheyeEquisolid, LensProjection::Spherical}) {
        Camera camera = cameraOf(projection);
        camera.fStop = 2.0f;
        camera.focusDistance = 7.0f;
        camera.lens.apertureBlades = 5;
        const vec2 pixel(40, 30);
        Camera sharp = camera;
        sharp.fStop = 0.0f;
        const CameraRay middle = rayOf(sharp, square, pixel);
        const float along = projection == LensProjection::Standard ? -middle.direction.z : 1.0f;
        const vec3 focus = middle.direction * (7.0f / along);
        for (float u : {0.05f, 0.4f, 0.9f}) {
            const CameraRay ray = rayOf(camera, square, pixel, {u, 0.7f});
            EXPECT_GT(glm::length(ray.origin), 0.1f);
            EXPECT_LE(glm::length(ray.origin), 0.5f + 1e-6f); // focal length 2 units, f/2
            expectNear(glm::normalize(focus - ray.origin), ray.direction, 1e-5f);
        }
    }
}

TEST(LensRays, RadialDistortionMovesAwayFromTheMiddle) {
    Camera camera = cameraOf(LensProjection::Standard);
    camera.lens.distortionK1 = 0.1f;
    camera.lens.distortionK2 = 0.05f;
    const CameraRay corner = rayOf(camera, square, {100, 0}); // r = 1
    expectNear(corner.direction, glm::normalize(vec3(0.5f * 1.15f, 0.5f * 1.15f, -1.0f)));
    const CameraRay side = rayOf(camera, square, {100, 50}); // r^2 = 1/2
    expectNear(side.direction, glm::normalize(vec3(0.5f * 1.0625f, 0.0f, -1.0f)));
}

TEST(LensRays, AnIdentityOfAMapChangesNoBit) {
    Camera camera = cameraOf(LensProjection::Standard);
    camera.fStop = 2.0f;
    camera.focusDistance = 7.0f;
    const RenderSettings settings = imageOf(61, 47);
    const CameraRays plain(camera, settings);
    camera.lens.distortionMap = "identity";
    std::vector<vec2> places;
    for (int y = 0; y < 9; ++y)
        for (int x = 0; x < 13; ++x)
            places.emplace_back(float((x + 0.5) / 13), float((9 - y - 0.5) / 9));
    const CameraRays mapped(camera, settings, dvec3(0.0),
                            std::make_shared<const DistortionMap>(13, 9, places));
    for (float x = 0.3f; x < 61.0f; x += 3.7f)
        for (float y = 0.7f; y < 47.0f; y += 2.9f) {
            const CameraRay a = plain.ray({x, y}, {0.3f, 0.8f}, 0.0f);
            const CameraRay b = mapped.ray({x, y}, {0.3f, 0.8f}, 0.0f);
            EXPECT_EQ(a.origin, b.origin);
            EXPECT_EQ(a.direction, b.direction);
            EXPECT_EQ(a.near, b.near);
            EXPECT_EQ(a.coneSpread, b.coneSpread);
        }
}

TEST(LensRays, WhereAMapShowsNoPlaceIsNothing) {
    Camera camera = cameraOf(LensProjection::Standard);
    camera.lens.distortionMap = "broken";
    for (float bad : {std::nanf(""), INFINITY, 3e38f}) {
        const std::vector<vec2> places(4, vec2(0.5f, bad));
        const CameraRays rays(camera, imageOf(10, 10), dvec3(0.0),
                              std::make_shared<const DistortionMap>(2, 2, places));
        EXPECT_FALSE(rays.ray({5, 5}, vec2(0.5f), 0.0f).seen) << bad;
    }
}
