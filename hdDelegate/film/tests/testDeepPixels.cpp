// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/film/deepOutput.h"
#include "hdDelegate/film/tests/tempFolder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace patina {

namespace {

DeepEvent event(float depth, float alpha, const glm::vec3& color, bool inVolume = false) {
    DeepEvent e;
    e.depth = depth;
    e.alpha = alpha;
    e.color = color;
    e.inVolume = inVolume;
    return e;
}

/// Colour and alpha of samples put over each other.
glm::dvec4 over(const std::vector<DeepSample>& samples) {
    glm::dvec4 sum(0.0);
    for (const DeepSample& s : samples)
        sum += glm::dvec4(s.color, s.alpha) * (1.0 - sum.a);
    return sum;
}

void expectInOrder(const std::vector<DeepSample>& samples) {
    for (size_t i = 0; i < samples.size(); ++i) {
        EXPECT_LE(samples[i].front, samples[i].back);
        EXPECT_LE(i > 0 ? samples[i - 1].back : 0.0f, samples[i].front) << "samples overlap";
    }
}

} // namespace

TEST(DeepPixels, WhatLiesBehindIsSeenThroughWhatIsLeft) {
    DeepPixels pixels(1, 1, 64);
    for (const DeepEvent& e : {event(2, 1, {1, 0, 0}), event(4, 1, {0, 1, 0}),
                               event(4, 1, {0, 1, 0}), event(deepBackground, 0, {0, 0, 0})})
        pixels.add(0, 0, &e, 1);
    const std::vector<DeepSample> samples = pixels.resolve(0, 0);
    ASSERT_EQ(samples.size(), 2u);
    EXPECT_EQ(samples[0].front, 2.0f);
    EXPECT_EQ(samples[0].back, 2.0f);
    EXPECT_FLOAT_EQ(samples[0].alpha, 0.25f);
    EXPECT_FLOAT_EQ(samples[0].color.r, 0.25f);
    EXPECT_FLOAT_EQ(samples[1].alpha, 2.0f / 3.0f) << "half of the pixel, through three quarters";
    EXPECT_FLOAT_EQ(samples[1].color.g, 2.0f / 3.0f);
    EXPECT_NEAR(over(samples).a, 0.75, 1e-7);
}

TEST(DeepPixels, ARayMayGlowAtSeveralDepths) {
    DeepPixels pixels(1, 1, 64);
    const DeepEvent events[] = {event(1, 0, {1, 1, 1}), event(3, 1, {0, 0, 2})};
    pixels.add(0, 0, events, 2);
    const std::vector<DeepSample> samples = pixels.resolve(0, 0);
    ASSERT_EQ(samples.size(), 2u);
    EXPECT_EQ(samples[0].alpha, 0.0f);
    EXPECT_EQ(samples[0].color, glm::vec3(1.0f));
    EXPECT_EQ(samples[1].alpha, 1.0f);
    EXPECT_EQ(samples[1].color, glm::vec3(0, 0, 2));
}

/// Each sample is stored with three roundings, and the sum has two more a sample.
TEST(DeepPixels, SamplesAddUpWhateverWasMerged) {
    std::mt19937 random(11);
    std::uniform_real_distribution<float> uniform(0.0f, 1.0f);
    for (const int most : {2, 3, 16, 4096}) {
        DeepPixels pixels(1, 1, most);
        glm::dvec4 sum(0.0);
        constexpr int rays = 1000;
        for (int i = 0; i < rays; ++i) {
            const bool inVolume = uniform(random) < 0.5f;
            DeepEvent e = event(1.0f + 9.0f * uniform(random), uniform(random) < 0.9f ? 1.0f : 0.3f,
                                {uniform(random), 100.0f * uniform(random), 0.0f}, inVolume);
            if (uniform(random) < 0.05f) e.depth = deepBackground;
            const DeepEvent both[] = {event(0.5f + uniform(random), 0.0f, {0.1f, 0, 0}), e};
            const int first = uniform(random) < 0.2f && e.depth > 2.0f ? 0 : 1;
            pixels.add(0, 0, both + first, 2 - first);
            for (int k = first; k < 2; ++k)
                sum += glm::dvec4(both[k].color, both[k].alpha) / double(rays);
        }
        const std::vector<DeepSample> samples = pixels.resolve(0, 0);
        EXPECT_LE(samples.size(), size_t(most));
        expectInOrder(samples);
        const glm::dvec4 found = over(samples);
        const double bound = 5.0 * double(samples.size()) * std::exp2(-24.0);
        for (int c = 0; c < 4; ++c)
            EXPECT_NEAR(found[c], sum[c], bound * std::max(1.0, sum[c])) << most << " " << c;
    }
}

TEST(DeepPixels, ASurfaceInAVolumeCutsIt) {
    DeepPixels pixels(1, 1, 2), more(1, 1, 3);
    for (const float z : {2.0f, 3.0f, 4.0f, 5.0f}) {
        const DeepEvent e = event(z, 1, {1, 1, 1}, true);
        if (z < 5.0f) pixels.add(0, 0, &e, 1);
        more.add(0, 0, &e, 1);
    }
    const DeepEvent wall = event(2.5f, 1, {0, 0, 1});
    more.add(0, 0, &wall, 1);
    expectInOrder(pixels.resolve(0, 0));
    expectInOrder(more.resolve(0, 0));
    EXPECT_NEAR(over(more.resolve(0, 0)).b, 1.0, 1e-6);
}

TEST(DeepPixels, AFileHasThem) {
    const TempFolder folder;
    DeepPixels pixels(3, 2, 64);
    for (int y = 0; y < 2; ++y)
        for (int x = 1; x < 3; ++x)
            for (const DeepEvent& e :
                 {event(2, 1, {float(x), 0, 0}), event(7, 1, {0, float(y + 1), 0}, true)})
                pixels.add(x, y, &e, 1);
    const std::string path = folder.file("deep.exr");
    writeDeep(pixels, path);
    const DeepImage read = readDeep(path);
    EXPECT_EQ(read.width, 3);
    EXPECT_EQ(read.height, 2);
    EXPECT_EQ(read.counts, (std::vector<int>{0, 2, 2, 0, 2, 2}));
    const ImageData flat = readImage(path);
    ASSERT_EQ(flat.channels, read.channels);
    const auto at = [&](int x, int y, const char* channel) {
        for (size_t c = 0; c < flat.channels.size(); ++c)
            if (flat.channels[c] == channel)
                return flat.pixels[size_t(3 * y + x) * flat.channels.size() + c];
        return -1.0f;
    };
    EXPECT_EQ(at(0, 0, "A"), 0.0f);
    EXPECT_FLOAT_EQ(at(2, 1, "A"), 1.0f);
    EXPECT_FLOAT_EQ(at(2, 1, "R"), 1.0f) << "half of 2";
    EXPECT_FLOAT_EQ(at(2, 1, "G"), 1.0f) << "half of 2";
    EXPECT_THROW(writeDeep(pixels, folder.file("deep.png")), std::runtime_error);
}

} // namespace patina
