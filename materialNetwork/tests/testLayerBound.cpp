// SPDX-License-Identifier: Apache-2.0
// A layer over closures that are added, whose albedo may be above 1.
#include "materialNetwork/ir/layerWeights.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace patina {
namespace {

TEST(LayerBound, NoMoreLeavesThanTheBaseHasOfWhatEnters) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> uniform;
    for (int i = 0; i < 100000; ++i) {
        // Shares near 1 are the worst: those of films over what reflects all.
        const auto share = [&] {
            const float u = uniform(random);
            return i % 3 == 0 ? u : i % 3 == 1 ? 1.0f - 1e-3f * u * u : std::round(u);
        };
        const float mirrored = 2.0f * uniform(random), spread = 2.0f * uniform(random);
        const float transmitted = i % 2 ? 2.0f * uniform(random) : 0.0f;
        const float coverage = share(), inside = share(), alpha = share(), z = share();
        const sh::LayerLight base =
            sh::layerLight(glm::vec3(mirrored), glm::vec3(spread), glm::vec3(transmitted));
        const sh::LayerLight through =
            sh::layerThrough(1.0f, glm::vec3(coverage), glm::vec3(inside), alpha, z, base);
        const float leaves = through.mirrored.x * mirrored + through.spread.x * spread +
                             through.transmitted.x * transmitted;
        // Five roundings of numbers near 1, each 2^-24, over a divisor of 1e-6 at least: 0.3.
        ASSERT_LE(leaves,
                  (1.0f - coverage) * std::max(mirrored + spread + transmitted, 1.0f) * 1.3f)
            << mirrored << " " << spread << " " << transmitted << " " << coverage << " " << inside
            << " " << alpha << " " << z;
    }
}

} // namespace
} // namespace patina
