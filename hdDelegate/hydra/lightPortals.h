// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/hydra/renderParam.h"
#include "hdDelegate/scene/lightPortal.h"

#include <pxr/imaging/hd/sceneDelegate.h>

#include <vector>

namespace patina {

/// The portals that a dome names (UsdLuxPortalLight), at the frame's time. Only scene indices know
/// them; hosts with a UsdImagingDelegate have none. A portal without a size, or a prim that is no
/// light, is left out with a warning.
std::vector<LightPortal> readLightPortals(HdSceneDelegate& delegate, HdPatinaRenderParam& param,
                                          const SdfPath& dome);

} // namespace patina
