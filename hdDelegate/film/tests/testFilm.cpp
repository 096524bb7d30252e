// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/film/tests/filmFixtures.h"
#include "hdDelegate/parallel.h"

#include <cmath>
#include <numeric>
#include <limits>

namespace patina {

namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float inf = std::numeric_limits<float>::infinity();

int32_t bitsOf(float value) {
    int32_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    return bits;
}

} // namespace

TEST(Film, MeanColourAlphaAndVarianceAreThoseOfTheSamples) {
    TestFilm film(3, 2);
    film.addColor(2, 1, {1, 2, 3}, 1.0f);
    film.addColor(2, 1, {3, 2, 1}, 0.5f);
    EXPECT_EQ(film.color(2, 1), glm::vec3(2, 2, 2));
    EXPECT_FLOAT_EQ(film.alpha(2, 1), 0.75f);
    EXPECT_EQ(film.sampleCount(2, 1), 2u);
    double l1 = 0.2126 + 2 * 0.7152 + 3 * 0.0722, l2 = 3 * 0.2126 + 2 * 0.7152 + 0.0722;
    EXPECT_NEAR(film.luminance(2, 1), 0.5 * (l1 + l2), 1e-6);
    // two samples: s^2 = (l1-l2)^2/2, of the mean half of it
    EXPECT_NEAR(film.varianceOfMean(2, 1), (l1 - l2) * (l1 - l2) / 4, 1e-6);
    EXPECT_EQ(film.color(0, 0), glm::vec3(0));
    EXPECT_EQ(film.varianceOfMean(0, 0), 0.0f);
}

TEST(Film, VarianceOfEqualSamplesIsZeroAndNeverNegative) {
    TestFilm film(1, 1);
    for (int i = 0; i < 1000; ++i)
        film.addColor(0, 0, glm::vec3(0.1f, 0.7f, 12345.6f), 1);
    EXPECT_GE(film.varianceOfMean(0, 0), 0.0f);
    EXPECT_LT(film.varianceOfMean(0, 0), 1e-9f);
}

TEST(Film, DeviationComparesPartsOfTheSequence) {
    TestFilm film(1, 1);
    const auto add = [&](float v) { film.addColor(0, 0, glm::vec3(v), 1.0f); };
    add(1.0f);
    EXPECT_EQ(film.deviationOfMean(0, 0), 0.0f);
    add(3.0f); // means 1, 2
    EXPECT_NEAR(film.deviationOfMean(0, 0), 1.0f, 1e-6f);
    add(5.0f); // means 2, 3 of two and three: two parts to one
    EXPECT_NEAR(film.deviationOfMean(0, 0), 0.25 * std::sqrt(2.0) + 0.75 * std::sqrt(2.0 / 3),
                1e-6);
    add(7.0f); // means 2, 4
    const double four = 0.5 * (2.0 + std::sqrt(0.5));
    EXPECT_NEAR(film.deviationOfMean(0, 0), four, 1e-6);
    for (int i = 0; i < 4; ++i)
        add(4.0f); // the second half as the first
    EXPECT_NEAR(film.deviationOfMean(0, 0), 0.5 * four * std::sqrt(0.5), 1e-6);
    // A mean that is replaced is no noise.
    film.setMean(0, 0, glm::vec3(9.0f), 1.0f);
    EXPECT_NEAR(film.deviationOfMean(0, 0), 0.5 * four * std::sqrt(0.5), 1e-5);
}

TEST(Film, BadSamplesAreDroppedCountedAndBlack) {
    TestFilm film(2, 1);
    for (glm::vec3 bad : {glm::vec3(nan, 0, 0), glm::vec3(0, inf, 0), glm::vec3(0, 0, -1)})
        EXPECT_FALSE(film.addColor(0, 0, bad, 1.0f));
    EXPECT_FALSE(film.addColor(0, 0, {1, 1, 1}, nan));
    EXPECT_TRUE(film.addColor(0, 0, {5, 5, 5}, 1.0f));
    EXPECT_EQ(film.droppedSamples(), 4u);
    EXPECT_EQ(film.sampleCount(0, 0), 5u);
    EXPECT_EQ(film.color(0, 0), glm::vec3(1));
    EXPECT_FLOAT_EQ(film.alpha(0, 0), 0.8f) << "only the alpha that is not a number is missing";
}

TEST(Film, NegativeSamplesCountWhereLightsTakeLightAway) {
    TestFilm film(1, 1), copy(0, 0);
    film.allowNegative(true);
    EXPECT_TRUE(film.addColor(0, 0, {-3, 1, 0}, 1.0f));
    EXPECT_FALSE(film.addColor(0, 0, {-inf, 0, 0}, 1.0f));
    EXPECT_FALSE(film.addColor(0, 0, {1, 1, 1}, -1.0f)) << "coverage is never negative";
    copy.copyFrom(film);
    EXPECT_TRUE(copy.addColor(0, 0, {-3, 0, 0}, 1.0f));
    EXPECT_EQ(copy.color(0, 0).x, -1.5f);
    film.reset(1, 1, {});
    EXPECT_FALSE(film.addColor(0, 0, {-1, 0, 0}, 1.0f)) << "each render says it anew";
}

TEST(Film, DroppedSamplesAreCountedWithoutRaces) {
    TestFilm film(64, 64);
    parallelFor(0, 64 * 64, [&](int i) {
        for (int s = 0; s < 50; ++s)
            film.addColor(i % 64, i / 64, glm::vec3(nan), 1);
    });
    EXPECT_EQ(film.droppedSamples(), 64u * 64u * 50u);
}

TEST(Film, FirstKeepsTheSampleNearestTheCentre) {
    TestFilm film(2, 2, {standardAov("position"), standardAov("depth")});
    glm::vec3 far(9), near(1), middle(5), late(7);
    film.addAov(0, 1, 0, &far.x, 0.5f);
    film.addAov(0, 1, 0, &near.x, 0.1f);
    film.addAov(0, 1, 0, &middle.x, 0.3f);
    film.addAov(0, 1, 0, &late.x, 0.1f);
    std::vector<float> p = film.resolve("position");
    EXPECT_EQ(p, (std::vector<float>{0, 0, 0, 1, 1, 1, 0, 0, 0, 0, 0, 0}));
    EXPECT_EQ(film.resolve("depth"), std::vector<float>(4, 1e10f)) << "clear value";
}

TEST(Film, PixelsWithoutSamplesShowTheirBlock) {
    TestFilm film(7, 4, {standardAov("depth"), standardAov("primId")});
    film.showBlocks(2, {1, 0, 6, 3}); // block corners at x 1, 3, 5 and y 0, 2
    const auto add = [&](int x, int y, float value) {
        film.addColor(x, y, glm::vec3(value), 1.0f);
        film.addAov(0, x, y, &value, 0.0f);
    };
    add(1, 0, 1.0f);
    add(3, 0, 2.0f);
    add(1, 2, 3.0f);
    add(4, 1, 9.0f);
    const float far = 1e10f;
    // (3, 2), (5, 0) and (5, 2) have no samples: blocks to the left or above stand in.
    const std::vector<float> expected = {far, 1,   1,   2,   2,   2,   far, //
                                         far, 1,   1,   2,   9,   2,   far, //
                                         far, 3,   3,   3,   3,   2,   far, //
                                         far, far, far, far, far, far, far};
    EXPECT_EQ(film.resolve("depth"), expected);
    std::vector<float> alpha = film.resolve("alpha"), counts = film.resolve("sampleCount");
    EXPECT_EQ(std::accumulate(alpha.begin(), alpha.end(), 0.0f), 15.0f);
    EXPECT_EQ(std::accumulate(counts.begin(), counts.end(), 0.0f), 4.0f) << "none is claimed";
    film.showBlocks(1, {});
    alpha = film.resolve("alpha");
    EXPECT_EQ(std::accumulate(alpha.begin(), alpha.end(), 0.0f), 4.0f);
}

TEST(Film, MeanAovsAverageWhatWasAdded) {
    TestFilm film(1, 1, {standardAov("albedo")});
    glm::vec3 a(0.2f, 0.4f, 0.6f), b(0.4f, 0.6f, 0.8f), bad(nan, 0, 0);
    film.addAov(0, 0, 0, &a.x, 0);
    film.addAov(0, 0, 0, &b.x, 0);
    film.addAov(0, 0, 0, &bad.x, 0);
    std::vector<float> v = film.resolve("albedo");
    EXPECT_FLOAT_EQ(v[0], 0.3f);
    EXPECT_FLOAT_EQ(v[1], 0.5f);
    EXPECT_FLOAT_EQ(v[2], 0.7f);
    EXPECT_EQ(film.droppedSamples(), 1u);
}

TEST(Film, IdsKeepTheirBitsThoughTheyAreNoNumbers) {
    TestFilm film(2, 1, {standardAov("primId")});
    float id = floatOfBits(-1);
    film.addAov(0, 0, 0, &id, 0.2f);
    id = floatOfBits(0x7f800001); // a signalling NaN when seen as a float
    film.addAov(0, 0, 0, &id, 0.1f);
    std::vector<float> v = film.resolve("primId");
    EXPECT_EQ(bitsOf(v[0]), 0x7f800001);
    EXPECT_EQ(bitsOf(v[1]), -1);
    EXPECT_EQ(film.droppedSamples(), 0u);
}

TEST(Film, NamesThatAlwaysExistResolveWithAndWithoutBeingListed) {
    TestFilm film(1, 1, {standardAov("variance"), standardAov("sampleCount")});
    film.addColor(0, 0, {1, 1, 1}, 1);
    film.addColor(0, 0, {3, 3, 3}, 1);
    float ignored = 77;
    film.addAov(0, 0, 0, &ignored, 0);
    EXPECT_EQ(film.resolve("sampleCount"), std::vector<float>{2});
    EXPECT_NEAR(film.resolve("variance")[0], 1.0f, 1e-6f);
    EXPECT_EQ(film.resolve("color"), (std::vector<float>{2, 2, 2}));
    EXPECT_EQ(film.resolve("alpha"), std::vector<float>{1});
    EXPECT_TRUE(film.resolve("nothing").empty());
}

TEST(Film, ResetKeepsOnlyWhenAskedAndWhenNothingChanged) {
    const std::vector<AovSpec> aovs = {standardAov("primId"), standardAov("normal")};
    TestFilm film(4, 4, aovs);
    film.addColor(1, 1, {1, 1, 1}, 1);
    film.reset(4, 4, aovs, true);
    EXPECT_EQ(film.sampleCount(1, 1), 1u);
    film.reset(4, 4, aovs);
    EXPECT_EQ(film.sampleCount(1, 1), 0u);
    film.addColor(1, 1, {1, 1, 1}, 1);
    film.reset(4, 5, aovs, true);
    EXPECT_EQ(film.sampleCount(1, 1), 0u);
    EXPECT_EQ(film.resolve("color").size(), 60u);
    film.resumeToken = "scene 1";
    film.reset(5, 5, aovs);
    EXPECT_EQ(film.resumeToken, "scene 1") << "hosts set it before the renderer resets";
}

TEST(Film, WrongRequestsAreRefusedByName) {
    Film film;
    EXPECT_THROW(film.reset(-1, 4, {}), std::invalid_argument);
    EXPECT_THROW(film.reset(1 << 30, 1 << 30, {}), std::invalid_argument);
    EXPECT_THROW(film.reset(1, 1, {{"wide", 17, AovKind::Mean, 0, false}}), std::invalid_argument);
    // As files of others may ask for them: resolve() and the denoiser write and read three floats.
    const std::vector<AovSpec> others = {{"color", 1, AovKind::Mean, 0, false},
                                         {"color", 3, AovKind::Coverage, 0, false},
                                         {"color.noisy", 1, AovKind::Mean, 0, false},
                                         {"denoisingAlbedo", 1, AovKind::Mean, 0, false},
                                         {"depth", 1, AovKind::Mean, 0, false},
                                         {"primvars:st", 4, AovKind::First, 0, false},
                                         {"alpha=lpe:C", 3, AovKind::Mean, 0, false},
                                         {"lpe:C.*", 2, AovKind::Mean, 0, false}};
    for (const AovSpec& spec : others)
        EXPECT_THROW(film.reset(1, 1, {spec}), std::invalid_argument) << spec.name;
    film.reset(1, 1, {{"color", 3, AovKind::Mean, 0, false}, {"mine", 2, AovKind::Mean, 0, false}});
    EXPECT_EQ(film.resolve("color").size(), 3u);
    EXPECT_TRUE(has(reasonOf([] { standardAov("shininess"); }), "shininess"));
    EXPECT_THROW(standardAov("primvars:"), std::invalid_argument);
    EXPECT_EQ(standardAov("primvars:st").components, 2);
    EXPECT_EQ(standardAov("primvars:displayColor").components, 3);
}

TEST(Film, MeansAreReplacedToTheBit) {
    TestFilm film(2, 1);
    for (int i = 0; i < 7; ++i)
        film.addColor(0, 0, glm::vec3(0.1f * float(i), 0.3f, 1.0f), 0.5f);
    const float variance = film.varianceOfMean(0, 0);
    const glm::vec3 mean(0.123456f, 7.654321f, 1e-7f);
    film.setMean(0, 0, mean, 0.7f);
    film.setMean(1, 0, mean, 0.7f); // without samples it stays as it is
    EXPECT_EQ(film.color(0, 0), mean);
    EXPECT_EQ(film.alpha(0, 0), 0.7f);
    EXPECT_EQ(film.sampleCount(0, 0), 7u);
    EXPECT_NEAR(film.varianceOfMean(0, 0), variance, 1e-4f * variance);
    EXPECT_EQ(film.color(1, 0), glm::vec3(0.0f));
}

TEST(Film, CopiesAreEqualAndApart) {
    TestFilm film(2, 2, {standardAov("depth")}), copy(0, 0);
    const float depth = 3.0f;
    film.addColor(1, 1, glm::vec3(0.25f), 1.0f);
    film.addAov(0, 1, 1, &depth, 0.1f);
    film.addColor(0, 0, glm::vec3(NAN), 1.0f);
    copy.copyFrom(film);
    film.addColor(1, 1, glm::vec3(0.75f), 1.0f);
    EXPECT_EQ(copy.color(1, 1), glm::vec3(0.25f));
    EXPECT_EQ(copy.resolve("depth"), film.resolve("depth"));
    EXPECT_EQ(copy.droppedSamples(), 1u);
}

} // namespace patina
