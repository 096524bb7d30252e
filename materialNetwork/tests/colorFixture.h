// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/color/colorSpaces.h"
#include "materialNetwork/tests/materialFixture.h"

#include <cmath>

namespace patina {

inline glm::vec3 converted(const ColorTransformPtr& transform, glm::vec3 c) {
    transform->apply(&c.x, 1, 3);
    return c;
}

/// IEC 61966-2-1.
inline double srgbToLinear(double v) {
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

} // namespace patina
