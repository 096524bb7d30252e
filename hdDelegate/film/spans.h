// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace patina {

/// The first end of a span of samples after so many. A film adds samples up within a span, and then
/// the spans in their order: so parts of a frame that begin and end with spans add up to its very
/// bits, whoever renders them. Ends are 1, 2, 4, 8, 16, then multiples of an eighth of the power of
/// two below. All are steps of tiles (nextStep), and the error is looked at after no other counts
/// (isErrorStep).
constexpr uint32_t nextSpanEnd(uint32_t samples) {
    uint32_t power = 1; // the largest that is not above samples
    while (power <= samples / 2)
        power *= 2;
    if (samples < 16) return samples == 0 ? 1 : 2 * power;
    const uint32_t width = power / 8;
    return (samples / width + 1) * width;
}

constexpr bool isSpanEnd(uint32_t samples) {
    return samples > 0 && nextSpanEnd(samples - 1) == samples;
}

} // namespace patina
