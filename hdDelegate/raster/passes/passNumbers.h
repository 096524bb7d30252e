// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/film/sampler.h"

namespace patina {

/// Pair `set` of a pass. Sets are scrambled apart from each other and from those of
/// rasterRenderer.cpp, so that no light's samples go with the pixels' offsets.
inline glm::vec2 passNumbers(uint32_t seed, uint32_t pass, uint32_t set) {
    return Sampler(set, 1, seed, pass).next2();
}

/// The same with a third number, stratified together with them.
inline glm::vec3 threeNumbers(uint32_t seed, uint32_t pass, uint32_t set) {
    return Sampler(set, 1, seed, pass).next3();
}

} // namespace patina
