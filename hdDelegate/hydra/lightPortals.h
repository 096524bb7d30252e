// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/hydra/renderParam.h"
#include "hdDelegate/scene/lightPortal.h"

#include <pxr/imaging/hd/sceneDelegate.h>

#include <vector>

namespace patina {

/// The portals that a dome names (UsdLuxPortalLight), as they stand at the frame. Scene indices
/// alone know them: hosts with a UsdImagingDelegate have none. One that has no size, or is no
/// light, is left out with a warning.
std::vector<LightPortal> readLightPortals(HdSceneDelegate& delegate, HdPatinaRenderParam& param,
                                          const SdfPath& dome);

} // namespace patina
