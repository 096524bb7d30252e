// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shaders/closure.h"

namespace patina {

/// A participating medium at one point.
struct Medium : sh::Medium {
    Medium() : sh::Medium(sh::mediumNone()) {}

    glm::vec3 scattering() const { return sh::mediumScattering(*this); }
    glm::vec3 extinction() const { return absorption + scattering(); }
    bool scatters() const { return phaseCount > 0; }
    bool empty() const {
        return phaseCount == 0 && absorption == glm::vec3(0.0f) && emission == glm::vec3(0.0f);
    }
};

} // namespace patina
