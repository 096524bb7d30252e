// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/hydra/view.h"

#include "hdDelegate/hydra/values.h"
#include "hdDelegate/scene/primCompare.h"

#include <pxr/base/gf/matrix4d.h>
#include <pxr/imaging/cameraUtil/framing.h>
#include <pxr/imaging/hd/camera.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace patina {

namespace {

constexpr double apertureUnit = 0.1; // cameras give tenths of a scene unit

/// A camera that has the given matrices: for hosts that give no camera prim.
Camera cameraOf(const GfMatrix4d& worldToView, const GfMatrix4d& projection) {
    Camera camera;
    camera.transform = MotionTransform(toMat4(worldToView.GetInverse()));
    camera.orthographic = projection[2][3] == 0.0;
    // x_ndc = (x * p00 + z * p20 + p30) / w, and w is -z or 1
    const double width = 2.0 / projection[0][0], height = 2.0 / projection[1][1];
    const double p22 = projection[2][2], p32 = projection[3][2];
    if (camera.orthographic) {
        camera.horizontalAperture = float(width / apertureUnit);
        camera.verticalAperture = float(height / apertureUnit);
        camera.horizontalApertureOffset = float(-projection[3][0] * width / 2.0 / apertureUnit);
        camera.verticalApertureOffset = float(-projection[3][1] * height / 2.0 / apertureUnit);
        camera.clipNear = float((p32 + 1.0) / p22);
        camera.clipFar = float((p32 - 1.0) / p22);
    } else {
        const double focal = camera.focalLength;
        camera.horizontalAperture = float(width * focal);
        camera.verticalAperture = float(height * focal);
        camera.horizontalApertureOffset = float(projection[2][0] * width / 2.0 * focal);
        camera.verticalApertureOffset = float(projection[2][1] * height / 2.0 * focal);
        camera.clipNear = float(p32 / (p22 - 1.0));
        camera.clipFar = float(p32 / (p22 + 1.0));
    }
    if (!(camera.clipNear >= 0.0f) || !std::isfinite(camera.clipNear)) camera.clipNear = 0.0f;
    if (!(camera.clipFar > camera.clipNear)) camera.clipFar = 1e6f;
    return camera;
}

/// Widens or crops the aperture from the display window to the whole buffer.
void fitToBuffer(Camera& camera, const CameraUtilFraming& framing,
                 CameraUtilConformWindowPolicy policy, int width, int height) {
    const GfRange2f& display = framing.displayWindow;
    const double displayWidth = display.GetMax()[0] - display.GetMin()[0];
    const double displayHeight = display.GetMax()[1] - display.GetMin()[1];
    const GfVec2d aperture =
        CameraUtilConformedWindow(GfVec2d(camera.horizontalAperture, camera.verticalAperture),
                                  policy, framing.pixelAspectRatio * displayWidth / displayHeight);
    // The y axis of windows points down, that of apertures up.
    const double centerX = (width / 2.0 - display.GetMin()[0]) / displayWidth - 0.5;
    const double centerY = 0.5 - (height / 2.0 - display.GetMin()[1]) / displayHeight;
    camera.horizontalApertureOffset += float(centerX * aperture[0]);
    camera.verticalApertureOffset += float(centerY * aperture[1]);
    camera.horizontalAperture = float(aperture[0] * width / displayWidth);
    camera.verticalAperture = float(aperture[1] * height / displayHeight);
}

/// Pixels up to a coordinate: hosts give windows that reach to the end of integers.
int sizeTo(int last) {
    return last < std::numeric_limits<int>::max() ? last + 1 : last;
}

int sizeOf(float viewport) {
    return viewport >= 1.0f ? int(std::min(viewport, 1e9f)) : 0;
}

bool coversBuffer(const CameraUtilFraming& framing, int width, int height) {
    const GfRange2f& display = framing.displayWindow;
    return display.GetMin() == GfVec2f(0.0f) &&
           display.GetMax() == GfVec2f(float(width), float(height));
}

/// Whether everything that a host's numbers were put into is a number. A view that is none would
/// differ from itself, and each repaint would start the image anew.
bool isFinite(const HdPatinaView& view) {
    double sum = view.pixelAspectRatio;
    if (view.ownCamera) {
        const Camera& c = view.camera;
        sum += double(c.horizontalAperture) + double(c.verticalAperture) +
               double(c.horizontalApertureOffset) + double(c.verticalApertureOffset) +
               double(c.focalLength);
        for (const dmat4& transform : c.transform.values)
            for (int column = 0; column < 4; ++column)
                for (int row = 0; row < 4; ++row)
                    sum += transform[column][row];
    }
    return std::isfinite(sum);
}

} // namespace

bool HdPatinaView::operator==(const HdPatinaView& other) const {
    return ownCamera == other.ownCamera && cameraPath == other.cameraPath &&
           (!ownCamera || sameCamera(camera, other.camera)) && width == other.width &&
           height == other.height && std::equal(dataWindow, dataWindow + 4, other.dataWindow) &&
           pixelAspectRatio == other.pixelAspectRatio && policy == other.policy;
}

std::string conformPolicyOf(CameraUtilConformWindowPolicy policy) {
    switch (policy) {
    case CameraUtilMatchVertically: return "adjustApertureWidth";
    case CameraUtilMatchHorizontally: return "adjustApertureHeight";
    case CameraUtilFit: return "expandAperture";
    case CameraUtilCrop: return "cropAperture";
    default: return "distortAperture";
    }
}

HdPatinaView viewOf(const HdRenderPassState& state, const PrimMap<Camera>& cameras, int bufferWidth,
                    int bufferHeight, const std::string& ownPath) {
    HdPatinaView view;
    const CameraUtilFraming& framing = state.GetFraming();
    const bool framed = framing.IsValid();
    const GfVec4f viewport = state.GetViewport();
    view.width = bufferWidth > 0 ? bufferWidth
                 : framed        ? sizeTo(framing.dataWindow.GetMaxX())
                                 : sizeOf(viewport[2]);
    view.height = bufferHeight > 0 ? bufferHeight
                  : framed         ? sizeTo(framing.dataWindow.GetMaxY())
                                   : sizeOf(viewport[3]);
    view.policy = conformPolicyOf(state.GetWindowPolicy());
    if (framed) {
        view.pixelAspectRatio = framing.pixelAspectRatio;
        const GfRect2i& data = framing.dataWindow;
        const int window[4] = {data.GetMinX(), data.GetMinY(), data.GetMaxX(), data.GetMaxY()};
        const bool whole = window[0] <= 0 && window[1] <= 0 && window[2] >= view.width - 1 &&
                           window[3] >= view.height - 1;
        if (!whole) {
            view.dataWindow[0] = std::max(window[0], 0);
            view.dataWindow[1] = std::max(window[1], 0);
            view.dataWindow[2] = std::min(window[2], view.width - 1);
            view.dataWindow[3] = std::min(window[3], view.height - 1);
        }
    }

    const HdCamera* camera = state.GetCamera();
    const auto prim = camera ? cameras.find(camera->GetId().GetString()) : cameras.end();
    if (prim == cameras.end()) {
        view.ownCamera = true;
        view.camera = cameraOf(state.GetWorldToViewMatrix(), state.GetProjectionMatrix());
        // The pass' projection is that of its data window already.
        view.policy = "distortAperture";
    } else {
        const bool clipped = !prim->second->clippingPlanes.empty() && state.GetClipPlanes().empty();
        const bool moved = framed && !coversBuffer(framing, view.width, view.height);
        view.ownCamera = clipped || moved;
        view.cameraPath = prim->first;
        if (view.ownCamera) view.camera = *prim->second;
        if (clipped) view.camera.clippingPlanes.clear();
        if (moved && !framing.displayWindow.IsEmpty()) {
            fitToBuffer(view.camera, framing, state.GetWindowPolicy(), view.width, view.height);
            view.policy = "distortAperture";
            view.pixelAspectRatio = 1.0;
        }
    }
    if (view.ownCamera) {
        view.cameraPath = ownPath;
        view.camera.path = ownPath;
    }
    // A window beside the buffer: an empty one would mean all of the buffer.
    if (framed &&
        (framing.dataWindow.GetMaxX() < 0 || framing.dataWindow.GetMaxY() < 0 ||
         framing.dataWindow.GetMinX() >= view.width || framing.dataWindow.GetMinY() >= view.height))
        view.width = view.height = 0;
    if (!isFinite(view)) {
        view = HdPatinaView();
        view.finite = false;
    }
    return view;
}

} // namespace patina
