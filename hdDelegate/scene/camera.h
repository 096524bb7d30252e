// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/scene/cameraLens.h"
#include "hdDelegate/scene/types.h"

namespace patina {

/// UsdGeomCamera. It looks along its local -z with +y up.
struct Camera {
    std::string path;
    MotionTransform transform{mat4(1.0f)};
    bool orthographic = false;
    // apertures, offsets and focal length in tenths of a scene unit, as UsdGeomCamera says
    float horizontalAperture = 20.955f;
    float verticalAperture = 15.2908f;
    float horizontalApertureOffset = 0.0f;
    float verticalApertureOffset = 0.0f;
    float focalLength = 50.0f;
    float fStop = 0.0f;         ///< 0 means everything is sharp
    float focusDistance = 0.0f; ///< scene units
    float clipNear = 1.0f, clipFar = 1e6f;
    std::vector<vec4> clippingPlanes;             ///< camera space; points with dot < 0 are clipped
    double shutterOpen = 0.0, shutterClose = 0.0; ///< time codes relative to the frame
    float exposureScale = 1.0f;                   ///< linear factor of the image
    CameraLens lens;
};

} // namespace patina
