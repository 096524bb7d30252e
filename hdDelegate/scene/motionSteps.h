// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/scene/types.h"

#include <algorithm>
#include <cmath>

namespace patina {

/// Times at which something that moves is evaluated: uniform over the shutter, 2..8 of them, so
/// chosen that the authored samples inside the shutter fall on steps where that is possible. One
/// time when nothing changes while the shutter is open.
inline std::vector<float> motionTimes(const std::vector<float>& authored, float open, float close) {
    constexpr int maxSteps = 8;
    if (authored.size() < 2 || !(close > open) || open >= authored.back() ||
        close <= authored.front())
        return {open};
    const auto fits = [&](int steps) {
        for (float time : authored) {
            if (time <= open || time >= close) continue;
            const float x = (time - open) / (close - open) * float(steps - 1);
            if (std::abs(x - std::round(x)) > 1e-3f) return false;
        }
        return true;
    };
    int steps = 2;
    while (steps < maxSteps && !fits(steps))
        ++steps;
    std::vector<float> times(steps);
    for (int i = 0; i < steps; ++i)
        times[i] = open + (close - open) * float(i) / float(steps - 1);
    return times;
}

/// Where a time lies among ascending sample times: the sample before it, and the fraction of the
/// way to the next. Times outside are clamped.
struct SampleSpan {
    size_t index = 0;
    float fraction = 0.0f;
};

inline SampleSpan sampleSpan(const std::vector<float>& times, float time) {
    if (times.size() < 2 || !(time > times.front())) return {0, 0.0f};
    if (time >= times.back()) return {times.size() - 1, 0.0f};
    const size_t next = size_t(std::upper_bound(times.begin(), times.end(), time) - times.begin());
    const float length = times[next] - times[next - 1];
    return {next - 1, length > 0.0f ? (time - times[next - 1]) / length : 0.0f};
}

} // namespace patina
