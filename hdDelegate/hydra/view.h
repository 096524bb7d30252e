// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/hydra/compat.h"
#include "hdDelegate/scene/scene.h"
#include "hdDelegate/scene/settings.h"

#include <pxr/imaging/hd/renderPassState.h>

#include <string>

namespace patina {

/// The view of a render pass: which camera, and how its picture lies in the buffers.
struct HdPatinaView {
    bool ownCamera = false;             ///< `camera` is not a prim of the scene and has to be set
    std::string cameraPath;             ///< of the scene's camera to look through
    Camera camera;                      ///< with ownCamera
    int width = 0, height = 0;          ///< 0: nothing is to be drawn
    int dataWindow[4] = {0, 0, -1, -1}; ///< as in RenderSettings
    double pixelAspectRatio = 1.0;
    std::string policy;
    bool finite = true; ///< else there is nothing to draw: the host's numbers are none

    bool operator==(const HdPatinaView& other) const;
};

/// @param scene to look up the pass' camera
/// @param bufferWidth, bufferHeight of the buffers that are bound; 0 when there are none: the
///        framing's size counts then
/// @param ownPath path for a camera that has to be made: for passes without a camera prim, for
///        display windows that are not the buffer, and when clipping is off
HdPatinaView viewOf(const HdRenderPassState& state, const PrimMap<Camera>& cameras, int bufferWidth,
                    int bufferHeight, const std::string& ownPath);

/// UsdRenderSettings' name of a window policy.
std::string conformPolicyOf(CameraUtilConformWindowPolicy policy);

} // namespace patina
