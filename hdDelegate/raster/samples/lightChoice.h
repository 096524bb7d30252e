// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

namespace patina {

/// A light that a pass takes, and how many times it counts so that passes have the right mean.
struct ChosenLight {
    size_t index = 0;
    float share = 1.0f;
};

/// Chooses some of many by systematic sampling: each with a probability in proportion to its
/// weight (at most 1), and never more than `maximum`. Those sure to be chosen count once.
/// @param weights not negative; those of 0 are chosen only when there is room for all
/// @param u in [0,1)
std::vector<ChosenLight> chooseLights(const std::vector<float>& weights, size_t maximum, float u);

} // namespace patina
