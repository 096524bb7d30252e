// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/hydra/renderParam.h"
#include "hdDelegate/scene/light.h"

#include <pxr/imaging/hd/sceneDelegate.h>

namespace patina {

/// Reads every input of a light but its transform. An input that a host does not give keeps the
/// fallback of the schema; values of a wrong type or that are not finite are reported and keep it
/// too.
/// @param type Hydra's type of the light prim
void readLightParams(HdSceneDelegate& delegate, HdPatinaRenderParam& param, const SdfPath& id,
                     const TfToken& type, Light& light);

} // namespace patina
