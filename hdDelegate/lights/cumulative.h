// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

namespace patina {

/// Writes cumulative sums of `count` weights, from 0 to exactly 1. @returns the sum
template <class Weight> double accumulate(int count, const Weight& weight, float* cumulative) {
    double sum = 0.0;
    for (int i = 0; i < count; ++i)
        sum += weight(i);
    double running = 0.0;
    cumulative[0] = 0.0f;
    for (int i = 0; i < count; ++i) {
        running += weight(i);
        cumulative[i + 1] = sum > 0.0 ? float(running / sum) : 0.0f;
    }
    if (sum > 0.0) cumulative[count] = 1.0f;
    return sum;
}

/// Finds the interval of a cumulative sum that u lies in; intervals of no width are never found.
/// Short ones are counted through: that is many at once, without a branch to be mispredicted.
/// @param u in [0, 1)
/// @param within receives where in the interval, in [0, 1)
inline int invert(const float* cumulative, int count, float u, float& within) {
    constexpr int maxLinearSearch = 64;
    int index = 0;
    if (count <= maxLinearSearch)
        for (int i = 1; i < count; ++i)
            index += cumulative[i] <= u ? 1 : 0;
    else
        index = int(std::upper_bound(cumulative + 1, cumulative + count, u) - cumulative) - 1;
    while (index > 0 && !(cumulative[index + 1] > cumulative[index]))
        --index;
    const float width = cumulative[index + 1] - cumulative[index];
    within =
        width > 0.0f ? std::clamp((u - cumulative[index]) / width, 0.0f, 0x1.fffffep-1f) : 0.5f;
    return index;
}

} // namespace patina
