// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/film/outliers.h"

#include "hdDelegate/film/tests/filmFixtures.h"

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

/// What spreadOutliers() leaves of a film.
struct Spread {
    std::vector<float> before, color;
    int found;

    explicit Spread(const Film& film) : before(film.resolve("color")), color(before) {
        found = spreadOutliers(film, color);
    }
    void expectMeanKept(double tolerance) const {
        EXPECT_NEAR(meanOf(color), meanOf(before), tolerance * meanOf(before));
    }
};

struct OutliersOfAWall : testing::Test {
    TestFilm film{size, size};
    std::minstd_rand random{7};

    void fill(float light = 0.2f) {
        forPixels(film, [&](int x, int y) { addWall(film, x, y, light, random); });
    }
};

} // namespace

TEST_F(OutliersOfAWall, TheLightOfAFireflyGoesToThePixelsAround) {
    film.addColor(20, 30, glm::vec3(900.0f, 300.0f, 0.0f), 1.0f); // one sample of 32
    film.addColor(0, 0, glm::vec3(500.0f), 1.0f);                 // in a corner
    fill();
    const Spread spread(film);
    EXPECT_EQ(spread.found, 2);
    spread.expectMeanKept(1e-5);
    for (size_t i = 0; i < spread.color.size(); ++i)
        EXPECT_LT(spread.color[i], 0.5f)
            << "no spot shows at " << i / 3 % size << " " << i / 3 / size;
}

TEST(Outliers, TheLightOfAnyFireflyHasNoEdge) {
    constexpr int wide = 400;
    TestFilm film(wide, wide);
    film.addColor(120, 90, glm::vec3(9e4f), 1.0f);
    std::minstd_rand random(7);
    forPixels(film, [&](int x, int y) { addWall(film, x, y, 0.2f, random); });
    const Spread spread(film);
    const std::vector<float>& color = spread.color;
    EXPECT_EQ(spread.found, 1);
    spread.expectMeanKept(1e-5);
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
    TestFilm film(400, 400);
    std::minstd_rand random(7);
    int fireflies = 0;
    forPixels(film, [&](int x, int y) {
        if (x % 9 == 4 && y % 9 == 4) { // areas of every width, from a few pixels to all of them
            film.addColor(x, y, glm::vec3(std::exp2(float(5 + fireflies % 13))), 1.0f);
            ++fireflies;
        }
        addWall(film, x, y, 0.2f, random);
    });
    const Spread spread(film);
    EXPECT_EQ(spread.found, fireflies);
    spread.expectMeanKept(1e-4);
}

TEST_F(OutliersOfAWall, HighlightsWhoseSamplesAgreeStay) {
    for (int i = 0; i < samples; ++i)
        film.addColor(20, 30, glm::vec3(30.0f), 1.0f);
    fill();
    const Spread spread(film);
    EXPECT_EQ(spread.found, 0);
    EXPECT_EQ(spread.color, spread.before);
}

TEST_F(OutliersOfAWall, LinesAndEdgesStay) {
    for (int i = 0; i < size; ++i) { // the rim of something bright, which every second sample meets
        std::uniform_int_distribution<int> coin(0, 1);
        for (int k = 0; k < samples; ++k)
            film.addColor(i, 30, glm::vec3(coin(random) ? 20.0f : 0.2f), 1.0f);
    }
    fill();
    EXPECT_EQ(Spread(film).found, 0);
}

TEST_F(OutliersOfAWall, NothingGoesToWhatIsBlackOrWithoutSamples) {
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size / 2; ++x) {
            if (x == 20 && y == 30) film.addColor(x, y, glm::vec3(900.0f), 1.0f);
            addWall(film, x, y, x < 16 ? 0.0f : 0.2f, random);
        }
    const Spread spread(film);
    EXPECT_EQ(spread.found, 1);
    spread.expectMeanKept(1e-5);
    forPixels(film, [&](int x, int y) {
        if (x < 16 || x >= size / 2) {
            EXPECT_EQ(spread.color[size_t(y * size + x) * 3], 0.0f);
        }
    });
}

TEST_F(OutliersOfAWall, WhereNothingElseIsLitTheyStay) {
    film.addColor(20, 30, glm::vec3(900.0f), 1.0f);
    fill(0.0f);
    const Spread spread(film);
    spread.expectMeanKept(1e-6);
    EXPECT_NEAR(spread.color[(30 * size + 20) * 3], spread.before[(30 * size + 20) * 3], 1e-3);
}
