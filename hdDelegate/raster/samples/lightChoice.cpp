// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/samples/lightChoice.h"

#include <algorithm>
#include <cmath>

namespace patina {

std::vector<ChosenLight> chooseLights(const std::vector<float>& weights, size_t maximum, float u) {
    std::vector<ChosenLight> out;
    if (weights.size() <= maximum) {
        for (size_t i = 0; i < weights.size(); ++i)
            out.push_back({i, 1.0f});
        return out;
    }
    if (maximum == 0) return out;
    // A light that would be chosen more than once is taken for sure; the rest share the samples
    // left.
    std::vector<bool> sure(weights.size(), false);
    double scale = 0.0;
    for (size_t round = 0; round <= maximum; ++round) {
        double sum = 0.0;
        size_t taken = 0;
        for (size_t i = 0; i < weights.size(); ++i) {
            if (sure[i])
                ++taken;
            else
                sum += double(weights[i]);
        }
        scale = sum > 0.0 ? double(maximum - taken) / sum : 0.0;
        bool again = false;
        for (size_t i = 0; i < weights.size(); ++i)
            if (!sure[i] && double(weights[i]) * scale >= 1.0 && taken < maximum) {
                sure[i] = again = true;
                ++taken;
            }
        if (!again) break;
    }
    double at = double(u), running = 0.0;
    for (size_t i = 0; i < weights.size(); ++i) {
        if (sure[i]) {
            out.push_back({i, 1.0f});
            continue;
        }
        const double chance = double(weights[i]) * scale;
        running += chance;
        if (chance > 0.0 && at < running && out.size() < maximum) {
            out.push_back({i, float(1.0 / chance)});
            at += 1.0;
        }
    }
    return out;
}

} // namespace patina
