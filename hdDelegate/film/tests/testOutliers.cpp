// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/film/outliers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace patina;

namespace {

constexpr int size = 48, samples = 32;

/// A wall in even light, with noise of a tenth in every sample.
void addWall(Film& film, int x, int y, float light, std::minstd_rand& random) {
    std::uniform_real_distribution<float> noise(0.9f, 1.1f);
    for (int i = int(film.sampleCount(x, y)); i < samples; ++i)
        film.addColor(x, y, light * noise(random) * glm::vec3(1.0f, 0.8f, 0.6f), 1.0f);
}

double meanOf(const std::vector<float>& color) {
    double sum = 0.0;
    for (float value : color)
        sum += value;
    return sum / double(color.size());
}

struct OutliersOfAWall : testing::Test {
    Film film;
    std::minstd_rand random{7};

    OutliersOfAWall() { film.reset(size, size, {}); }
    void fill(float light = 0.2f) {
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x)
                addWall(film, x, y, light, random);
    }
};

} // namespace

TEST_F(OutliersOfAWall, TheLightOfAFireflyGoesToThePixelsAround) {
    film.addColor(20, 30, glm::vec3(900.0f, 300.0f, 0.0f), 1.0f); // one sample of 32
    film.addColor(0, 0, glm::vec3(500.0f), 1.0f);                 // in a corner
    fill();
    std::vector<float> color = film.resolve("color");
    const std::vector<float> before = color;
    EXPECT_EQ(spreadOutliers(film, color), 2);
    EXPECT_NEAR(meanOf(color), meanOf(before), 1e-5 * meanOf(before));
    for (size_t i = 0; i < color.size(); ++i)
        EXPECT_LT(color[i], 0.5f) << "no spot shows at " << i / 3 % size << " " << i / 3 / size;
}

TEST(Outliers, TheLightOfAnyFireflyHasNoEdge) {
    constexpr int wide = 400;
    Film film;
    film.reset(wide, wide, {});
    film.addColor(120, 90, glm::vec3(9e4f), 1.0f);
    std::minstd_rand random(7);
    for (int y = 0; y < wide; ++y)
        for (int x = 0; x < wide; ++x)
            addWall(film, x, y, 0.2f, random);
    std::vector<float> color = film.resolve("color");
    const std::vector<float> before = color;
    EXPECT_EQ(spreadOutliers(film, color), 1);
    EXPECT_NEAR(meanOf(color), meanOf(before), 1e-5 * meanOf(before));
    // 14,000 times the wall's light on 160,000 pixels. A step to the next pixel is some noise: of a
    // mean 0.058 / sqrt(32), so that six standard errors of a difference are 0.09.
    const float step = 0.09f * 0.2f * 1.5f;
    for (int y = 0; y < wide; ++y)
        for (int x = 1; x < wide; ++x) {
            const size_t i = size_t(y * wide + x) * 3;
            EXPECT_LT(color[i], 0.2f * 1.5f);
            EXPECT_LT(std::abs(color[i] - color[i - 3]), step) << x << " " << y;
        }
}

TEST(Outliers, ThousandsOfThemKeepTheMean) {
    constexpr int wide = 400;
    Film film;
    film.reset(wide, wide, {});
    std::minstd_rand random(7);
    int fireflies = 0;
    for (int y = 0; y < wide; ++y)
        for (int x = 0; x < wide; ++x) {
            if (x % 9 == 4 &&
                y % 9 == 4) { // areas of every width, from a few pixels to all of them
                film.addColor(x, y, glm::vec3(std::exp2(float(5 + fireflies % 13))), 1.0f);
                ++fireflies;
            }
            addWall(film, x, y, 0.2f, random);
        }
    std::vector<float> color = film.resolve("color");
    const double mean = meanOf(color);
    EXPECT_EQ(spreadOutliers(film, color), fireflies);
    EXPECT_NEAR(meanOf(color), mean, 1e-4 * mean);
}

TEST_F(OutliersOfAWall, HighlightsWhoseSamplesAgreeStay) {
    for (int i = 0; i < samples; ++i)
        film.addColor(20, 30, glm::vec3(30.0f), 1.0f);
    fill();
    std::vector<float> color = film.resolve("color");
    const std::vector<float> before = color;
    EXPECT_EQ(spreadOutliers(film, color), 0);
    EXPECT_EQ(color, before);
}

TEST_F(OutliersOfAWall, LinesAndEdgesStay) {
    for (int i = 0; i < size; ++i) { // the rim of something bright, which every second sample meets
        std::uniform_int_distribution<int> coin(0, 1);
        for (int k = 0; k < samples; ++k)
            film.addColor(i, 30, glm::vec3(coin(random) ? 20.0f : 0.2f), 1.0f);
    }
    fill();
    std::vector<float> color = film.resolve("color");
    EXPECT_EQ(spreadOutliers(film, color), 0);
}

TEST_F(OutliersOfAWall, NothingGoesToWhatIsBlackOrWithoutSamples) {
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size / 2; ++x) {
            if (x == 20 && y == 30) film.addColor(x, y, glm::vec3(900.0f), 1.0f);
            addWall(film, x, y, x < 16 ? 0.0f : 0.2f, random);
        }
    std::vector<float> color = film.resolve("color");
    const double mean = meanOf(color);
    EXPECT_EQ(spreadOutliers(film, color), 1);
    EXPECT_NEAR(meanOf(color), mean, 1e-5 * mean);
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x)
            if (x < 16 || x >= size / 2) {
                EXPECT_EQ(color[size_t(y * size + x) * 3], 0.0f);
            }
}

TEST_F(OutliersOfAWall, WhereNothingElseIsLitTheyStay) {
    film.addColor(20, 30, glm::vec3(900.0f), 1.0f);
    fill(0.0f);
    std::vector<float> color = film.resolve("color");
    const std::vector<float> before = color;
    spreadOutliers(film, color);
    EXPECT_NEAR(meanOf(color), meanOf(before), 1e-6 * meanOf(before));
    EXPECT_NEAR(color[(30 * size + 20) * 3], before[(30 * size + 20) * 3], 1e-3);
}
