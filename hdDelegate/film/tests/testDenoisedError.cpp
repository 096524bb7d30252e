// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/film/denoiser.h"

#include "hdDelegate/film/tests/filmFixtures.h"

#include <cmath>
#include <memory>
#include <random>

namespace patina {

namespace {

constexpr int side = 96;
using Picture = float (*)(int x, int y);

std::unique_ptr<Film> noisy(Picture truth, int samples, uint32_t seed) {
    std::vector<AovSpec> aovs;
    for (const char* name : {denoisingAlbedoAov, denoisingNormalAov, denoisingHalfColorAov,
                             denoisingHalfAlbedoAov, denoisingHalfNormalAov})
        aovs.push_back(standardAov(name));
    auto film = std::make_unique<TestFilm>(side, side, aovs);
    std::mt19937 random(seed);
    std::exponential_distribution<float> noise(1.0f);
    const glm::vec3 albedo(0.5f), normal(0.0f, 0.0f, 1.0f);
    forPixels(*film, [&](int x, int y) {
        for (int i = 0; i < samples; ++i) {
            const glm::vec3 color(truth(x, y) * noise(random));
            film->addAov(0, x, y, &albedo.x, 0.0f);
            film->addAov(1, x, y, &normal.x, 0.0f);
            if (i % 2 == 0) {
                film->addAov(2, x, y, &color.x, 0.0f);
                film->addAov(3, x, y, &albedo.x, 0.0f);
                film->addAov(4, x, y, &normal.x, 0.0f);
            }
            film->addColor(x, y, color, 1.0f);
        }
    });
    return film;
}

double trueError(const Film& film, Picture truth) {
    const std::vector<float> color = film.resolve("color");
    double sum = 0.0;
    forPixels(film, [&](int x, int y) {
        const size_t i = 3 * size_t(y * side + x);
        const double shown = 0.2126 * double(color[i]) + 0.7152 * double(color[i + 1]) +
                             0.0722 * double(color[i + 2]);
        sum += std::abs(shown - double(truth(x, y))) / (double(truth(x, y)) + 0.01);
    });
    return sum / (side * side);
}

float smooth(int x, int y) {
    return 0.2f + 0.6f * float(x + y) / (2 * side);
}

/// As fine as noise, and no guide knows of it.
float fine(int x, int y) {
    return (x * 7 + y * 13 + x * y * 5) % 3 == 0 ? 0.9f : 0.3f;
}

} // namespace

TEST(DenoisedError, FilmsWithoutHalvesTellNothing) {
    TestFilm film(2, 2, {standardAov(denoisingAlbedoAov), standardAov(denoisingNormalAov)});
    EXPECT_FALSE(hasHalves(film));
    EXPECT_LT(denoisedError(film), 0.0);
    EXPECT_LT(denoisedError(*noisy(smooth, 1, 1)), 0.0) << "one sample has no second half";
}

/// By its margin of two standard errors, a film with another seed is above the bound once in 44
/// runs at most.
TEST(DenoisedError, BoundsWhatTheFilterLeavesAndWhatItBlurs) {
    if (!denoiserMissing().empty()) GTEST_SKIP() << denoiserMissing();
    for (const Picture truth : {smooth, fine})
        for (const uint32_t seed : {1u, 2u, 3u})
            for (const int samples : {16, 17}) {
                const auto film = noisy(truth, samples, seed);
                const double told = denoisedError(*film, 1), means = trueError(*film, truth);
                denoise(*film, 1);
                EXPECT_EQ(denoisedError(*film, 1), told) << "it is about the noisy colour";
                const std::string which = (truth == smooth ? "smooth, seed " : "fine, seed ") +
                                          std::to_string(seed) + ", " + std::to_string(samples);
                EXPECT_LE(trueError(*film, truth), told) << which;
                // What nobody can tell from noise is blurred, else most of the noise goes.
                if (truth != smooth) continue;
                EXPECT_LT(told, 0.5 * means) << which;
            }
}

} // namespace patina
