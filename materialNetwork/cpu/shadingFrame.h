// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/cpu/programCode.h"
#include "materialNetwork/shadingPoint.h"

namespace patina {

/// The frame of a lobe, from what the material says of it.
BsdfFrame makeFrame(const FrameTemplate& frame, const glm::vec4* registers,
                    const ShadingPoint& point);

} // namespace patina
