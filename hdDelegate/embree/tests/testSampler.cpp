// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/film/pixelFilter.h"
#include "hdDelegate/film/sampler.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

using namespace patina;

namespace {

/// Points of pairs in a grid of 16 by 16 cells.
struct Cells {
    std::vector<int> count = std::vector<int>(256, 0);
    void add(const glm::vec2& p) { ++count[size_t(p.x * 16) * 16 + size_t(p.y * 16)]; }
    void expectOneEach(const std::string& what) {
        for (int n : count)
            ASSERT_EQ(n, 1) << what;
    }
};

} // namespace

TEST(Sampler, EveryPairOf256SamplesFillsA16x16GridOnce) {
    for (int pair = 0; pair < 6; ++pair) {
        Cells cells;
        for (uint32_t i = 0; i < 256; ++i) {
            Sampler sampler(3, 7, 1, i);
            for (int k = 0; k < pair; ++k)
                sampler.next2();
            cells.add(sampler.next2());
        }
        cells.expectOneEach("pair " + std::to_string(pair));
    }
}

TEST(Sampler, EveryNumberOfAQuadrupleFallsOnceInEach256th) {
    for (int d = 0; d < 4; ++d) {
        std::vector<int> count(256, 0);
        for (uint32_t i = 0; i < 256; ++i)
            ++count[size_t(Sampler(3, 7, 1, i).next4()[d] * 256)];
        for (int n : count)
            ASSERT_EQ(n, 1) << "number " << d;
    }
}

TEST(Sampler, PointsOfASetAreStratifiedAllTogether) {
    // 64 samples of 4 points each: 256 points of one (0,2) sequence.
    Cells cells;
    for (uint32_t i = 0; i < 64; ++i) {
        Sampler sampler(3, 7, 1, i);
        sampler.next2();
        const Sampler::Set set = sampler.nextSet(4);
        for (uint32_t k = 0; k < 4; ++k) {
            const glm::vec4 p = set.point4(k);
            ASSERT_EQ(glm::vec2(p), set.point2(k));
            cells.add(glm::vec2(p));
        }
    }
    cells.expectOneEach("set");
}

TEST(Sampler, NumbersStayBelowOne) {
    for (uint32_t i = 0; i < 100000; ++i) {
        Sampler sampler(i % 97, i % 89, i, i * 2654435761u);
        const glm::vec4 u = sampler.next4();
        for (int d = 0; d < 4; ++d)
            ASSERT_TRUE(u[d] >= 0.0f && u[d] < 1.0f);
        const float r = sampler.random();
        ASSERT_TRUE(r >= 0.0f && r < 1.0f);
    }
}

TEST(Sampler, PairsAndPixelsAreUncorrelated) {
    // Correlation of n independent uniform pairs has a standard deviation of 1/sqrt(n); 5 of them
    // are exceeded with probability 6e-7. Fixed seeds.
    constexpr int n = 1 << 14;
    double pairs = 0.0, pixels = 0.0;
    for (uint32_t i = 0; i < n; ++i) {
        Sampler a(5, 5, 0, i), b(6, 5, 0, i);
        const float a0 = a.next2().x, a1 = a.next2().x, b0 = b.next2().x;
        pairs += (a0 - 0.5) * (a1 - 0.5);
        pixels += (a0 - 0.5) * (b0 - 0.5);
    }
    const double limit = 5.0 / std::sqrt(double(n));
    EXPECT_LT(std::abs(pairs * 12.0 / n), limit);
    EXPECT_LT(std::abs(pixels * 12.0 / n), limit);
}

TEST(PixelFilter, GaussianHasTheVarianceOfATruncatedNormal) {
    // Radius 1, sigma 0.5, cut at 2 sigma: variance sigma^2 (1 - 4 phi(2) / (2 Phi(2) - 1)).
    const PixelFilter filter(1.0f);
    double mean = 0.0, square = 0.0;
    constexpr int n = 100000;
    for (int i = 0; i < n; ++i) {
        const double x = filter.sample({(i + 0.5f) / n, 0.5f}).x;
        mean += x / n;
        square += x * x / n;
    }
    EXPECT_NEAR(mean, 0.0, 1e-5);
    EXPECT_NEAR(square, 0.25 * (1.0 - 4.0 * 0.0539909665 / 0.9544997361), 1e-4);
}

TEST(PixelFilter, HalfAPixelIsABox) {
    const PixelFilter filter(0.5f);
    EXPECT_FLOAT_EQ(filter.sample({0.0f, 0.75f}).x, -0.5f);
    EXPECT_FLOAT_EQ(filter.sample({0.0f, 0.75f}).y, 0.25f);
}
