// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/backends/refine.h"

#include "hdDelegate/film/tests/filmFixtures.h"

#include <cmath>
#include <random>

using namespace patina;

namespace {

Picture noise(int width, int height, float scale, unsigned seed) {
    std::mt19937 random(seed);
    std::exponential_distribution<float> value(1.0f / scale);
    Picture picture{width, height, {}};
    for (int i = 0; i < width * height; ++i)
        picture.pixels.push_back({value(random), value(random), value(random), 1.0f});
    return picture;
}

} // namespace

TEST(Picture, EyesHaveARangeThatIsOneToOne) {
    for (const float x : {0.0f, 1e-6f, 0.18f, 0.999f, 1.0f, 1.001f, 7.0f, 5000.0f})
        EXPECT_NEAR(fromEye(toEye(x)), x, 1e-3f * x) << x;
    EXPECT_EQ(toEye(NAN), 0.0f);
    EXPECT_LE(toEye(INFINITY), 1.5f);
}

TEST(Picture, BlurIsTheMeanOfASquare) {
    const Picture p = noise(37, 23, 1.0f, 1), blurred = boxBlur(p, 5);
    for (const auto& [x, y] : {std::pair(0, 0), std::pair(36, 22), std::pair(20, 3)}) {
        glm::dvec4 sum(0.0);
        int count = 0;
        for (int v = std::max(0, y - 5); v <= std::min(22, y + 5); ++v)
            for (int u = std::max(0, x - 5); u <= std::min(36, x + 5); ++u, ++count)
                sum += glm::dvec4(p.pixels[size_t(v * 37 + u)]);
        for (int k = 0; k < 4; ++k)
            EXPECT_NEAR(blurred.pixels[size_t(y * 37 + x)][k], sum[k] / count, 1e-5);
    }
}

TEST(Picture, StepsAreAsLongAsAllowedAndEndEqual) {
    Picture shown = noise(70, 50, 0.1f, 2);
    const Picture target = noise(70, 50, 3.0f, 3);
    const float whole = largestStep(shown, target);
    int steps = 1;
    for (bool there = false; !there; ++steps) {
        const Picture before = shown;
        there = approach(shown, target, 0.04f);
        EXPECT_LE(largestStep(before, shown), 0.0401f);
        ASSERT_LT(steps, 100);
    }
    EXPECT_EQ(shown.pixels, target.pixels);
    EXPECT_LE(steps, int(whole / 0.04f) + 4); // no step is wasted
}

TEST(Picture, NoiseComesLittleByLittle) {
    Picture shown = noise(64, 64, 0.3f, 8);
    const Picture begin = shown, target = noise(64, 64, 0.3f, 9);
    EXPECT_FALSE(approach(shown, target, 1.0f, 0.25f)); // though the means are nearly equal
    double way = 0.0, walked = 0.0;
    for (size_t i = 0; i < shown.pixels.size(); ++i) {
        way += std::abs(toEye(target.pixels[i].x) - toEye(begin.pixels[i].x));
        walked += std::abs(toEye(shown.pixels[i].x) - toEye(begin.pixels[i].x));
    }
    EXPECT_NEAR(walked / way, 0.25, 1e-3);
}

TEST(Picture, RefiningKeepsTheDetailAndTakesTheLight) {
    // Rasterized: a fine pattern, too dark and of another colour. Path traced: the truth, noisy.
    const int w = 96, h = 64;
    std::mt19937 random(4);
    std::exponential_distribution<float> noisy(1.0f);
    TestFilm traced(w, h);
    Picture quick{w, h, {}}, truth{w, h, {}};
    const auto pattern = [](int x, int y) { return (x + y) % 2 ? 1.0f : 0.5f; };
    forPixels(traced, [&](int x, int y) {
        const glm::vec3 color = pattern(x, y) * glm::vec3(0.4f, 0.3f, 0.2f);
        quick.pixels.push_back({0.5f * color.x, 0.7f * color.y, 0.6f * color.z, 1.0f});
        truth.pixels.push_back({color.x, color.y, color.z, 1.0f});
        for (int s = 0; s < 2; ++s)
            traced.addColor(x, y, color * noisy(random), 1.0f);
    });
    const Picture path = pictureOf(traced);
    const Picture shown = refine(quick, path, noiseOf(traced), 0.0f);
    double before = 0.0, after = 0.0, rasterized = 0.0;
    for (size_t i = 0; i < truth.pixels.size(); ++i) {
        const auto error = [&](const Picture& p) {
            return double(glm::length(p.pixels[i] - truth.pixels[i]));
        };
        before += error(path);
        rasterized += error(quick);
        after += error(shown);
    }
    EXPECT_LT(after, 0.25 * before);
    EXPECT_LT(after, 0.5 * rasterized);
}

TEST(Picture, WithoutNoiseThePathTracedImageIsShown) {
    TestFilm traced(32, 32);
    for (int s = 0; s < 2; ++s)
        addColors(traced, [](int x, int y) { return glm::vec3(float(32 * y + x) / 1024.0f); });
    const Picture path = pictureOf(traced);
    EXPECT_EQ(refine(noise(32, 32, 1.0f, 5), path, noiseOf(traced), 0.0f).pixels, path.pixels);
}

TEST(Picture, AtTheEndThePathTracedImageIsShown) {
    TestFilm traced(32, 32);
    std::mt19937 random(6);
    std::exponential_distribution<float> noisy(1.0f);
    for (int s = 0; s < 4; ++s)
        addColors(traced, [&](int, int) { return glm::vec3(noisy(random)); });
    const Picture path = pictureOf(traced);
    const Picture half = refine(noise(32, 32, 1.0f, 7), path, noiseOf(traced), 0.5f);
    EXPECT_NE(half.pixels, path.pixels);
    EXPECT_EQ(refine(noise(32, 32, 1.0f, 7), path, noiseOf(traced), 1.0f).pixels, path.pixels);
}
