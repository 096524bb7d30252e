// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/hydra/view.h"
#include "hdDelegate/scene/tests/prims.h"

#include <gtest/gtest.h>
#include <pxr/base/gf/camera.h>
#include <pxr/base/gf/frustum.h>
#include <pxr/imaging/hd/camera.h>

#include <limits>

using namespace patina;

namespace {

/// A pass state without a camera prim, as old hosts have it.
class MatrixState : public HdRenderPassState {
public:
    explicit MatrixState(const GfFrustum& frustum) : _frustum(frustum) {}
    GfMatrix4d GetWorldToViewMatrix() const override { return _frustum.ComputeViewMatrix(); }
    GfMatrix4d GetProjectionMatrix() const override { return _frustum.ComputeProjectionMatrix(); }

private:
    GfFrustum _frustum;
};

struct NamedCamera : HdCamera {
    explicit NamedCamera(const SdfPath& id) : HdCamera(id) {}
};

/// What a framing shows of a camera of aspect 2.
HdPatinaView viewOfCamera(const CameraUtilFraming& framing, int width, int height) {
    auto camera = makePrim<Camera>("/camera");
    camera->horizontalAperture = 20.0f;
    camera->verticalAperture = 10.0f;
    PrimMap<Camera> cameras;
    cameras.set(camera->path, camera);
    const NamedCamera named(SdfPath("/camera"));
    HdRenderPassState state;
    state.SetCamera(&named);
    state.SetFraming(framing);
    return viewOf(state, cameras, width, height, "/own");
}

} // namespace

TEST(View, RecoversTheCameraFromMatrices) {
    GfCamera authored;
    authored.SetHorizontalAperture(30.0f);
    authored.SetVerticalAperture(20.0f);
    authored.SetHorizontalApertureOffset(3.0f);
    authored.SetVerticalApertureOffset(-2.0f);
    authored.SetFocalLength(35.0f);
    authored.SetClippingRange(GfRange1f(0.5f, 800.0f));
    const MatrixState state(authored.GetFrustum());
    const HdPatinaView view = viewOf(state, {}, 60, 40, "/own");
    ASSERT_TRUE(view.ownCamera);
    const Camera& c = view.camera;
    EXPECT_NEAR(c.horizontalAperture / c.focalLength, 30.0 / 35.0, 1e-5);
    EXPECT_NEAR(c.verticalAperture / c.focalLength, 20.0 / 35.0, 1e-5);
    EXPECT_NEAR(c.horizontalApertureOffset / c.focalLength, 3.0 / 35.0, 1e-5);
    EXPECT_NEAR(c.verticalApertureOffset / c.focalLength, -2.0 / 35.0, 1e-5);
    EXPECT_NEAR(c.clipNear, 0.5, 1e-3);
    EXPECT_NEAR(c.clipFar, 800.0, 1.0);
}

TEST(View, RecoversOrthographicCamerasToo) {
    GfCamera authored;
    authored.SetProjection(GfCamera::Orthographic);
    authored.SetHorizontalAperture(50.0f);
    authored.SetVerticalAperture(25.0f);
    authored.SetHorizontalApertureOffset(5.0f);
    authored.SetClippingRange(GfRange1f(1.0f, 100.0f));
    const MatrixState state(authored.GetFrustum());
    const Camera c = viewOf(state, {}, 60, 40, "/own").camera;
    EXPECT_TRUE(c.orthographic);
    EXPECT_NEAR(c.horizontalAperture, 50.0, 1e-4);
    EXPECT_NEAR(c.verticalAperture, 25.0, 1e-4);
    EXPECT_NEAR(c.horizontalApertureOffset, 5.0, 1e-4);
    EXPECT_NEAR(c.clipNear, 1.0, 1e-3);
    EXPECT_NEAR(c.clipFar, 100.0, 1e-3);
}

TEST(View, LooksThroughTheScenesCameraWhereItCan) {
    const auto view = viewOfCamera(CameraUtilFraming(GfRect2i(GfVec2i(0), 64, 48)), 64, 48);
    EXPECT_FALSE(view.ownCamera);
    EXPECT_EQ(view.cameraPath, "/camera");
    EXPECT_LT(view.dataWindow[2], view.dataWindow[0]) << "the whole image";
}

TEST(View, CropsToTheDataWindow) {
    CameraUtilFraming framing(GfRect2i(GfVec2i(0), 64, 48));
    framing.dataWindow = GfRect2i(GfVec2i(8, 4), 16, 10);
    const HdPatinaView view = viewOfCamera(framing, 64, 48);
    EXPECT_FALSE(view.ownCamera);
    EXPECT_EQ(view.dataWindow[0], 8);
    EXPECT_EQ(view.dataWindow[1], 4);
    EXPECT_EQ(view.dataWindow[2], 23);
    EXPECT_EQ(view.dataWindow[3], 13);
}

TEST(View, PlacesADisplayWindowInALargerBuffer) {
    // The display window has the camera's aspect and fills the upper left quarter of the buffer.
    const CameraUtilFraming framing(GfRange2f(GfVec2f(0, 0), GfVec2f(40, 20)),
                                    GfRect2i(GfVec2i(0), 80, 40));
    const HdPatinaView view = viewOfCamera(framing, 80, 40);
    ASSERT_TRUE(view.ownCamera);
    EXPECT_EQ(view.policy, "distortAperture");
    EXPECT_FLOAT_EQ(view.camera.horizontalAperture, 40.0f);
    EXPECT_FLOAT_EQ(view.camera.verticalAperture, 20.0f);
    EXPECT_FLOAT_EQ(view.camera.horizontalApertureOffset, 10.0f);
    EXPECT_FLOAT_EQ(view.camera.verticalApertureOffset, -5.0f);
}

TEST(View, ValuesThatAreNotFiniteDrawNothingAndStayEqual) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    MatrixState state{GfFrustum()};
    const GfRange2f whole(GfVec2f(0.0f), GfVec2f(8.0f));
    const auto viewFramed = [&](const CameraUtilFraming& framing) {
        state.SetFraming(framing);
        return viewOf(state, {}, 8, 8, "/own");
    };
    const GfRect2i data(GfVec2i(0), 8, 8);
    EXPECT_EQ(viewFramed(CameraUtilFraming(whole, data, 1.0f)).width, 8);
    const CameraUtilFraming broken(whole, data, nan);
    const HdPatinaView view = viewFramed(broken);
    EXPECT_EQ(view.width, 0);
    EXPECT_FALSE(view.finite);
    EXPECT_TRUE(view == viewFramed(broken)) << "or each repaint starts over";

    GfFrustum frustum;
    frustum.SetPosition(GfVec3d(std::numeric_limits<double>::quiet_NaN()));
    const MatrixState matrices(frustum);
    EXPECT_TRUE(viewOf(matrices, {}, 8, 8, "/own") == viewOf(matrices, {}, 8, 8, "/own"));
}
