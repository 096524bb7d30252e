// SPDX-License-Identifier: Apache-2.0
// Distances in homogeneous media: weights integrate to what they stand for.

#include "hdDelegate/embree/media/freeFlight.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace patina;
using glm::vec2;
using glm::vec3;

namespace {

/// Means over a fine grid of u: the weight of arriving, and of scattering.
void means(const vec3& extinction, const vec3& scattering, const vec3& throughput, float end,
           vec3& arrived, vec3& scattered, float& largest) {
    arrived = scattered = vec3(0.0f);
    largest = 0.0f;
    const int n = 600;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const vec2 u((i + 0.5f) / n, (j + 0.5f) / n);
            const FreeFlight f = sampleFreeFlight(extinction, scattering, throughput, end, u);
            (f.scattered ? scattered : arrived) += throughput * f.weight / float(n * n);
            largest = std::max({largest, f.weight.x, f.weight.y, f.weight.z});
        }
}

} // namespace

TEST(FreeFlight, WeightsIntegrateToTransmittanceAndScattering) {
    const vec3 scattering(0.5f, 2.0f, 0.0f), extinction(0.7f, 2.5f, 1.0f),
        throughput(1.0f, 0.5f, 0.2f);
    for (float end : {0.1f, 1.0f, 5.0f}) {
        vec3 arrived, scattered;
        float largest;
        means(extinction, scattering, throughput, end, arrived, scattered, largest);
        for (int c = 0; c < 3; ++c) {
            const float left = std::exp(-extinction[c] * end);
            EXPECT_NEAR(arrived[c], throughput[c] * left, 3e-3f);
            EXPECT_NEAR(scattered[c], throughput[c] * scattering[c] / extinction[c] * (1 - left),
                        3e-3f);
        }
        // The balance heuristic bounds a channel's weight by the inverse of its share.
        EXPECT_LT(largest, 1.7f / 0.2f + 1e-3f);
    }
}

TEST(FreeFlight, ClearChannelsPassWithoutEnd) {
    vec3 arrived, scattered;
    float largest;
    means(vec3(1, 0, 0), vec3(1, 0, 0), vec3(1.0f), INFINITY, arrived, scattered, largest);
    EXPECT_NEAR(scattered.x, 1.0f, 3e-3f);
    EXPECT_NEAR(arrived.y, 1.0f, 3e-3f);
    EXPECT_EQ(arrived.x, 0.0f);
}

TEST(FreeFlight, MediaThatOnlyAbsorbAreNotSampled) {
    const FreeFlight f = sampleFreeFlight(vec3(2.0f), vec3(0.0f), vec3(1.0f), 0.5f, vec2(0.9f));
    EXPECT_FALSE(f.scattered);
    EXPECT_FLOAT_EQ(f.weight.x, std::exp(-1.0f));
}

TEST(FreeFlight, EmissionAlongShortAndLongWays) {
    const vec3 e = emissionAlong(vec3(2.0f), vec3(0.0f, 1e-6f, 3.0f), 1.0f);
    EXPECT_FLOAT_EQ(e.x, 2.0f);
    EXPECT_NEAR(e.y, 2.0f, 1e-5f);
    EXPECT_NEAR(e.z, 2.0f / 3.0f * (1 - std::exp(-3.0f)), 1e-6f);
    EXPECT_EQ(emissionAlong(vec3(2.0f), vec3(0.0f), INFINITY).x, 0.0f);
    EXPECT_FLOAT_EQ(emissionAlong(vec3(2.0f), vec3(4.0f), INFINITY).x, 0.5f);
}
