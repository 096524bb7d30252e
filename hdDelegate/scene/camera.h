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
#define PATINA_CAMERA_INPUT(field, key, Getter, unit, positive, fallback, description)             \
    float field = fallback;
#include "hdDelegate/scene/cameraTypes.inc"
    float clipNear = 1.0f, clipFar = 1e6f;
    std::vector<vec4> clippingPlanes;             ///< camera space; points with dot < 0 are clipped
    double shutterOpen = 0.0, shutterClose = 0.0; ///< time codes relative to the frame
    float exposureScale = 1.0f;                   ///< linear factor of the image
    CameraLens lens;
};

} // namespace patina
