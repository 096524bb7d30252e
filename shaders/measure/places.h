// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <vector>

#include "shaders/bake/albedoQuadrature.h"

namespace patina::measure {

/// Cell centres of (cosine, root of alpha), `side` by `side`: what every method is measured on.
struct Place {
    sh64::vec3 wo;
    double alpha;
};

inline std::vector<Place> places(int side) {
    std::vector<Place> result;
    for (int a = 0; a < side; ++a)
        for (int m = 0; m < side; ++m)
            result.push_back({bake::slanted((m + 0.5) / side), std::pow((a + 0.5) / side, 2.0)});
    return result;
}

/// A metal, one channel.
struct Metal {
    const char* name;
    double n, k;
};
constexpr Metal measuredMetals[] = {{"gold, red", 0.18, 3.4}, {"copper, blue", 1.1, 2.3}};

} // namespace patina::measure
