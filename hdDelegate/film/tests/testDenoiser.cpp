// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/film/denoiser.h"

#include "hdDelegate/film/tests/filmFixtures.h"

#include <random>

namespace patina {

namespace {

/// A grey film of independent exponential samples: mean 1, deviation 1.
void fillWithNoise(Film& film) {
    std::mt19937 random(7);
    std::exponential_distribution<float> noise(1.0f);
    forPixels(film, [&](int x, int y) { film.addColor(x, y, glm::vec3(noise(random)), 0.5f); });
}

double variance(const std::vector<float>& values) {
    double sum = 0, squares = 0;
    for (float v : values)
        sum += v, squares += double(v) * v;
    const double n = double(values.size());
    return squares / n - sum / n * (sum / n);
}

} // namespace

TEST(Denoiser, TheNoisyColourStaysBesideWhatReplacesIt) {
    TestFilm film(2, 1);
    film.addColor(0, 0, {1, 2, 3}, 1.0f);
    film.addColor(1, 0, {4, 5, 6}, 1.0f);
    EXPECT_TRUE(film.resolve("color.noisy").empty());
    const std::vector<float> noisy = film.resolve("color"), clean = {9, 8, 7, 6, 5, 4};
    film.setDenoised(clean);
    EXPECT_TRUE(film.denoised());
    EXPECT_EQ(film.resolve("color"), clean);
    EXPECT_EQ(film.resolve("color.noisy"), noisy);
    EXPECT_THROW(film.setDenoised({1, 2, 3}), std::invalid_argument);
    film.reset(2, 1, {}, true); // as a render does that adds samples
    EXPECT_FALSE(film.denoised());
    EXPECT_EQ(film.resolve("color"), noisy);
}

TEST(Denoiser, FlatNoiseBecomesFlatterAndKeepsItsAlpha) {
    if (!denoiserMissing().empty()) GTEST_SKIP() << denoiserMissing();
    TestFilm film(64, 64);
    fillWithNoise(film);
    const std::vector<float> noisy = film.resolve("color"), alpha = film.resolve("alpha");
    denoise(film);
    // A filter that averages four pixels would reach a quarter.
    EXPECT_LT(variance(film.resolve("color")), 0.25 * variance(noisy));
    EXPECT_EQ(film.resolve("color.noisy"), noisy);
    EXPECT_EQ(film.resolve("alpha"), alpha);
    const std::vector<float> once = film.resolve("color");
    denoise(film); // from the noisy colour again
    EXPECT_EQ(film.resolve("color"), once);
}

TEST(Denoiser, AovsOfLightAreDenoisedOnRequest) {
    if (!denoiserMissing().empty()) GTEST_SKIP() << denoiserMissing();
    TestFilm film(
        64, 64,
        {standardAov("diffuse"), standardAov("key=lpe:C.*<L.'key'>"), standardAov("normal")});
    fillWithNoise(film);
    std::mt19937 random(8);
    std::exponential_distribution<float> noise(1.0f);
    forPixels(film, [&](int x, int y) {
        for (int aov = 0; aov < 3; ++aov) {
            const float values[3] = {noise(random), noise(random), noise(random)};
            film.addAov(aov, x, y, values, 0.0f);
        }
    });
    const std::vector<float> diffuse = film.resolve("diffuse"), normal = film.resolve("normal");
    denoise(film);
    EXPECT_EQ(film.resolve("diffuse"), diffuse);
    const std::vector<float> color = film.resolve("color");
    denoise(film, 0, true);
    EXPECT_EQ(film.resolve("color"), color) << "the colour is the same either way";
    EXPECT_LT(variance(film.resolve("diffuse")), 0.25 * variance(diffuse));
    EXPECT_EQ(film.resolve("diffuse.noisy"), diffuse);
    EXPECT_TRUE(film.denoised("key=lpe:C.*<L.'key'>"));
    EXPECT_LT(variance(film.resolve("key")), 0.25) << "also by the name of its channels";
    EXPECT_EQ(film.resolve("normal"), normal);
    const std::vector<float> once = film.resolve("diffuse");
    denoise(film, 0, true); // from the noisy ones again
    EXPECT_EQ(film.resolve("diffuse"), once);
}

TEST(Denoiser, AnEmptyFilmIsRefused) {
    Film film;
    EXPECT_THROW(denoise(film), std::runtime_error);
}

} // namespace patina
