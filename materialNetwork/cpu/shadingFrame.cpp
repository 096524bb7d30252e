// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/cpu/shadingFrame.h"

namespace patina {

BsdfFrame makeFrame(const FrameTemplate& frame, const glm::vec4* registers,
                    const ShadingPoint& point) {
    const auto given = [&](int r) { return r >= 0 ? glm::vec3(registers[r]) : glm::vec3(0.0f); };
    return sh::shadingFrame(point.viewDirection, point.geometricNormal, point.normal, point.tangent,
                            given(frame.normal), given(frame.tangent), frame.flips, frame.bends);
}

} // namespace patina
