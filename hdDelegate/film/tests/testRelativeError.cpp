// SPDX-License-Identifier: Apache-2.0
// The error that a film expects of its image, against the error that there is: of samples whose
// limit is known. Each case has many images of fixed seeds; what is asked holds with a significance
// of 1e-3 or better for any other seeds.

#include "hdDelegate/film/relativeError.h"
#include "hdDelegate/film/sampler.h"

#include "hdDelegate/film/tests/filmFixtures.h"

#include <cmath>
#include <functional>

namespace patina {

namespace {

constexpr int width = 12, height = 8, images = 40;

/// Luminance of a sample of a pixel, its limit the same in all pixels.
using Sample = std::function<float(Sampler&, int x)>;

struct Found {
    double ratio = 0.0;  ///< expected error over the true one, mean over images
    double plain = 0.0;  ///< that of independent samples of the same variance over the true one
    double lowest = 1e9; ///< of the ratios
};

Found find(int samples, float limit, const Sample& sample) {
    Found found;
    for (int image = 0; image < images; ++image) {
        TestFilm film(width, height);
        double error = 0.0, plain = 0.0;
        forPixels(film, [&](int x, int y) {
            for (int i = 0; i < samples; ++i) {
                Sampler sampler{uint32_t(x), uint32_t(y), uint32_t(image), uint32_t(i)};
                film.addColor(x, y, glm::vec3(sample(sampler, x)), 1.0f);
            }
            error += std::abs(double(film.luminance(x, y)) - limit) / (limit + 0.01);
            plain += 0.7979 * std::sqrt(double(film.varianceOfMean(x, y))) / (limit + 0.01);
        });
        const double pixels = width * height;
        const double expected = relativeError(film, 0, 0, width, height);
        found.ratio += expected * pixels / error / images;
        found.plain += plain / error / images;
        found.lowest = std::min(found.lowest, expected * pixels / error);
    }
    return found;
}

} // namespace

TEST(RelativeError, OfIndependentSamplesIsALittleMoreThanThatOfTheirVariance) {
    for (int samples : {64, 96, 1024}) {
        const Found found =
            find(samples, 0.5f, [](Sampler& sampler, int) { return sampler.random(); });
        EXPECT_NEAR(found.plain, 1.0, 0.05) << samples;
        EXPECT_GT(found.ratio, 0.95) << samples;
        EXPECT_LT(found.ratio, 1.3) << samples;
        EXPECT_GT(found.lowest, 0.65) << samples;
    }
}

TEST(RelativeError, KnowsThatSamplesAreSpreadEvenly) {
    // The edge of something through each pixel.
    // The mean of 0.425 - 0.25 u.y, 0.3, is its share of the square.
    const Found found = find(256, 0.27f, [](Sampler& sampler, int) {
        const glm::vec2 u = sampler.next2();
        return 0.8f * u.x + 0.2f * u.y < 0.34f ? 0.9f : 0.0f;
    });
    EXPECT_GT(found.plain, 3.0);
    EXPECT_LT(found.ratio, 0.75 * found.plain);
    EXPECT_GT(found.ratio, 1.0);
    EXPECT_GT(found.lowest, 0.8);
}

TEST(RelativeError, DoesNotForgetLightThatFewSamplesFind) {
    // One sample in 50 finds what is 50 times as bright; the variance falls for the pixels without.
    for (int samples : {32, 64, 256}) {
        const Found found = find(samples, 1.0f, [](Sampler& sampler, int) {
            return sampler.random() < 0.02f ? 50.0f : 0.0f;
        });
        EXPECT_GT(found.lowest, 0.65) << samples;
        EXPECT_LT(found.ratio, 1.6) << samples;
    }
}

TEST(RelativeError, OfFewFindsFollowsFromPoissonsLaw) {
    // The numbers of docs/measurements/tolerance.md, "Thresholds", where samples find 1 / chance or
    // nothing. The relative variance of |n| is 0.57 and that of the halves 0.19, so 3840 pixels
    // tell a ratio to 0.014: 0.055 is four standard errors.
    constexpr int side = 64, rows = 60, samples = 256;
    for (const auto& [finds, byHalves] : {std::pair{1, 0.77}, {5, 0.93}, {16, 0.97}}) {
        TestFilm film(side, rows);
        const float chance = float(finds) / samples;
        double error = 0.0, halves = 0.0;
        forPixels(film, [&](int x, int y) {
            for (uint32_t i = 0; i < samples; ++i) {
                Sampler sampler{uint32_t(x), uint32_t(y), 7u, i};
                const float found = sampler.random() < chance ? 1.0f / chance : 0.0f;
                film.addColor(x, y, glm::vec3(found), 1.0f);
            }
            error += std::abs(double(film.luminance(x, y)) - 1.0);
            halves += double(film.deviationOfMean(x, y));
        });
        EXPECT_NEAR(halves / error, byHalves, 0.055) << finds;
        // The estimate takes the standard deviation where halves tell less than 0.93.
        EXPECT_GT(relativeError(film, 0, 0, side, rows) * 1.01 * side * rows / error, 0.93 - 0.055)
            << finds;
    }
}

TEST(RelativeError, IsThatOfTheRectangleAlone) {
    TestFilm film(8, 4);
    for (int i = 0; i < 64; ++i)
        addColors(film, [&](int x, int) { return glm::vec3(x < 4 || i % 3 ? 1.0f : 0.0f); });
    EXPECT_EQ(relativeError(film, 0, 0, 4, 4), 0.0);
    EXPECT_GT(relativeError(film, 4, 0, 8, 4), 0.001);
    EXPECT_EQ(relativeError(film, 3, 2, 3, 4), 0.0) << "no pixels";
    EXPECT_EQ(relativeError(film, 0, 0, 4, 4, PixelNoise::Shared), 0.0);
}

TEST(RelativeError, OfPixelsThatShareTheirNumbersIsNeverFarBelowThatOfTheirVariance) {
    // Pairs of samples that agree by chance whenever the film compares.
    TestFilm film(8, 8);
    for (int i = 0; i < 64; ++i)
        addColors(film, [&](int, int) { return glm::vec3(i == 0 || i % 4 == 1 || i % 4 == 2); });
    const double plain =
        0.7979 * std::sqrt(double(film.varianceOfMean(1, 1))) / (film.luminance(1, 1) + 0.01);
    EXPECT_LT(relativeError(film, 0, 0, 8, 8), 0.45 * plain);
    EXPECT_NEAR(relativeError(film, 0, 0, 8, 8, PixelNoise::Shared), 0.5 * plain, 0.01 * plain);
}

TEST(RelativeError, StepsDoubleAndThenGrowByAShareOfWhatIsThere) {
    int count = 0;
    for (int expected :
         {1, 2, 4, 8, 16, 18, 20, 22, 24, 26, 28, 30, 32, 36, 40, 44, 48, 52, 56, 60, 64, 70})
        EXPECT_EQ(count = nextStep(count, 70), expected);
    EXPECT_EQ(nextStep(37, 1000), 40) << "after an interruption, back to the steps of all";
    EXPECT_EQ(nextStep(128, 1000), 144);
    EXPECT_EQ(nextStep(256, 1000), 272);
    EXPECT_EQ(nextStep(512, 1 << 20), 544);
    EXPECT_EQ(nextStep(5000, 1 << 20), 5120);
    EXPECT_EQ(nextStep(1 << 20, 1 << 22), (1 << 20) + 256);
}

TEST(RelativeError, SumsOfRectanglesMakeThatOfAll) {
    // Without borders between pixels that are averaged: columns of one pixel's width each.
    TestFilm film(4, 1);
    for (int i = 0; i < 48; ++i)
        for (int x = 0; x < 3; ++x) // the last has no samples
            film.addColor(x, 0, glm::vec3(float((i * 7 + x * 5) % 11)), 1.0f);
    ErrorSums sums;
    for (int x = 0; x < 4; ++x)
        sums += errorSums(film, x, 0, x + 1, 1);
    EXPECT_EQ(sums.pixels, 3.0);
    double mean = 0.0;
    for (int x = 0; x < 3; ++x)
        mean += film.deviationOfMean(x, 0) / (film.luminance(x, 0) + 0.01) / 3.0;
    EXPECT_GE(relativeError(sums), 0.7978 * mean) << "halves or variance, whichever counts";
    EXPECT_EQ(relativeError(ErrorSums()), 0.0);
}

TEST(RelativeError, EveryLookIsAStep) {
    int looks = 0;
    for (int count = 0; count < 100000;) {
        const int next = nextStep(count, 1 << 20);
        for (int n = count + 1; n < next; ++n)
            EXPECT_FALSE(isErrorStep(n)) << n;
        looks += isErrorStep(next);
        count = next;
    }
    EXPECT_EQ(looks, 17 + 12) << "1 to 65536, and 48 to 98304";
    EXPECT_FALSE(isErrorStep(0));
}

} // namespace patina
