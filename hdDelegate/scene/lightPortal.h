// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/scene/types.h"

#include <string>

namespace patina {

/// A rectangle in the local xy plane, about the origin, through which a dome shines along -z
/// (UsdLuxPortalLight). It guides sampling alone.
struct LightPortal {
    std::string path;
    MotionTransform transform{mat4(1.0f)}; ///< to the space that the light's own transform leads to
    float width = 1.0f, height = 1.0f;
};

} // namespace patina
