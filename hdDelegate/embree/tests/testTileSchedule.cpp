// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/tileSchedule.h"

#include "hdDelegate/film/tests/filmFixtures.h"

#include <cmath>
#include <random>

using namespace patina;

namespace {

void fill(Film& film, const Tile& tile, int samples, bool noisy) {
    forTile(tile, [&](int x, int y) {
        for (int i = int(film.sampleCount(x, y)); i < samples; ++i)
            film.addColor(x, y, glm::vec3(noisy && i % 3 == 0 ? 0.0f : 1.0f), 1.0f);
    });
}

/// As many samples as the error asks for, from 16 on.
RenderSettings adaptive(double tolerance, int samples = 1024) {
    RenderSettings settings;
    settings.samples = samples;
    settings.minSamples = 16;
    settings.tolerance = tolerance;
    return settings;
}

/// Targets of an image of one tile, after so many samples without noise.
using Targets = std::vector<std::pair<int, int>>;
void expectTargets(const RenderSettings& settings, const Targets& targets) {
    for (const auto& [samples, target] : targets) {
        TestFilm film(4, 4);
        const TileSchedule schedule(film, settings);
        fill(film, schedule.tiles()[0], samples, false);
        EXPECT_EQ(schedule.target(0), target) << samples;
    }
}

} // namespace

TEST(TileSchedule, TilesCoverTheImageOnce) {
    TestFilm film(50, 35);
    const TileSchedule schedule(film, RenderSettings());
    std::vector<int> covered(50 * 35, 0);
    for (const Tile& t : schedule.tiles())
        forTile(t, [&](int x, int y) { ++covered[y * 50 + x]; });
    EXPECT_EQ(covered, std::vector<int>(50 * 35, 1));
}

TEST(TileSchedule, DataWindowLimitsTheTiles) {
    TestFilm film(50, 35);
    RenderSettings settings;
    settings.dataWindow[0] = 10, settings.dataWindow[1] = 5;
    settings.dataWindow[2] = 12, settings.dataWindow[3] = 5;
    const TileSchedule schedule(film, settings);
    ASSERT_EQ(schedule.tiles().size(), 1u);
    const Tile t = schedule.tiles()[0];
    EXPECT_EQ(t.x1 - t.x0, 3);
    EXPECT_EQ(t.y1 - t.y0, 1);
}

TEST(TileSchedule, OnlyTheSlowestTilesArePending) {
    TestFilm film(32, 16);
    RenderSettings settings;
    settings.samples = 4;
    TileSchedule schedule(film, settings);
    fill(film, schedule.tiles()[0], 1, true);
    EXPECT_EQ(schedule.pending(), std::vector<int>{1});
    fill(film, schedule.tiles()[1], 4, true);
    EXPECT_EQ(schedule.pending(), std::vector<int>{0});
    fill(film, schedule.tiles()[0], 4, true);
    EXPECT_TRUE(schedule.pending().empty());
    EXPECT_DOUBLE_EQ(schedule.outlook().needed, 0.0);
    EXPECT_DOUBLE_EQ(schedule.outlook().taken, 4.0);
}

TEST(TileSchedule, QuietTilesStopAtTheToleranceAndNoisyOnesDoNot) {
    TestFilm film(32, 16);
    TileSchedule schedule(film, adaptive(0.05));
    fill(film, schedule.tiles()[0], 16, false);
    fill(film, schedule.tiles()[1], 16, true);
    EXPECT_EQ(schedule.target(0), 0);
    EXPECT_EQ(schedule.target(1), 18);
}

TEST(TileSchedule, TilesAreLookedAtAtSomeStepsOnly) {
    expectTargets(adaptive(0.05), {{16, 0}, {24, 26}, {32, 0}, {48, 0}, {80, 88}});
}

TEST(TileSchedule, WithoutAToleranceStepsAreLong) {
    RenderSettings settings;
    settings.samples = 40;
    expectTargets(settings, {{0, 1}, {8, 16}, {16, 32}, {18, 32}, {32, 40}});
}

TEST(TileSchedule, ATileThatWasBrokenOffGoesOn) {
    TestFilm film(4, 4);
    TileSchedule schedule(film, adaptive(0.05));
    fill(film, schedule.tiles()[0], 32, false); // would be enough
    fill(film, {0, 0, 4, 1}, 48, false);        // but its first row has gone on
    EXPECT_EQ(schedule.target(0), 36);
}

namespace {

/// Samples of luminance 1 with noise that is independent and uniform, +- `noise`.
void fillRandomly(Film& film, const Tile& tile, int samples, float noise, std::mt19937& random) {
    std::uniform_real_distribution<float> u(-1.0f, 1.0f);
    forTile(tile, [&](int x, int y) {
        for (int i = int(film.sampleCount(x, y)); i < samples; ++i)
            film.addColor(x, y, glm::vec3(1.0f + noise * u(random)), 1.0f);
    });
}

/// Two tiles, of which the right one has all the noise: 0.9 / sqrt(3 n), times 0.8 as the mean of
/// absolute values: 0.104 after 16 samples.
struct HalfNoisy : testing::Test {
    TestFilm film{32, 16};
    RenderSettings settings = adaptive(0.08); // the tile has more, both together half
    std::mt19937 random{5};

    void fill(int samples) {
        const TileSchedule tiles(film, settings);
        fillRandomly(film, tiles.tiles()[0], 16, 0.0f, random);
        fillRandomly(film, tiles.tiles()[1], samples, 0.9f, random);
    }
};

} // namespace

TEST_F(HalfNoisy, TheImageIsDoneWhenItsMeanErrorIsWithinTheTolerance) {
    fill(16);
    const TileSchedule schedule(film, settings);
    EXPECT_EQ(schedule.target(1), 18) << "the tile alone is not done";
    EXPECT_TRUE(schedule.pending().empty());
    settings.tolerance = 0.03;
    EXPECT_EQ(TileSchedule(film, settings).pending(), std::vector<int>{1});
}

TEST_F(HalfNoisy, APartOfTheFrameDoesNotKnowTheOtherTiles) {
    fill(16);
    settings.tileParts = 2;
    int waiting = 0;
    for (settings.tilePart = 0; settings.tilePart < 2; ++settings.tilePart)
        waiting += int(TileSchedule(film, settings).pending().size());
    EXPECT_EQ(waiting, 1) << "the noisy tile goes on, in whichever part it is";
}

TEST_F(HalfNoisy, AnImageThatWasToldToGoOnGoesOn) {
    fill(16);
    const Tile noisy = TileSchedule(film, settings).tiles()[1];
    fillRandomly(film, {noisy.x0, noisy.y0, noisy.x1, noisy.y0 + 1}, 32, 0.9f, random);
    EXPECT_EQ(TileSchedule(film, settings).pending(), std::vector<int>{1});
}

TEST_F(HalfNoisy, TheOutlookFollowsFromTheSlopeOfTheNoise) {
    fill(64);
    settings.tolerance = 0.01;
    const TileSchedule::Outlook now = TileSchedule(film, settings).outlook();
    EXPECT_DOUBLE_EQ(now.taken, 40.0);
    // Half of the pixels have noise e, the image e / 2: it is done with (e / 2 / tolerance)^2 times
    // the samples of the noisy tile.
    const double over = now.error / settings.tolerance;
    ASSERT_GT(over, 1.5);
    EXPECT_NEAR(now.needed, 0.5 * 64.0 * (over * over - 1.0), 0.05 * now.needed);
    settings.tolerance = 0.0;
    EXPECT_DOUBLE_EQ(TileSchedule(film, settings).outlook().needed, 0.5 * (960.0 + 1008.0));
}

/// A picture like that of a room, whose limit is known: from dark to bright, with noise of its
/// lamps in every sample and bright light that one sample in 50 finds. Nine pictures of 3072
/// pixels, whose mean error chance changes by about half a percent: error and samples are more than
/// three standard errors within the bounds.
TEST(TileSchedule, AToleranceTakesTheSamplesThatItsNoiseNeeds) {
    constexpr int width = 64, height = 48;
    const auto limit = [](int x, int y) { return 0.05 + 0.01 * x + (y > 24 ? 0.3 : 0.0); };
    double over = 0.0, error = 0.0;
    for (const double tolerance : {0.1, 0.08, 0.06})
        for (unsigned seed = 0; seed < 3; ++seed) {
            TestFilm film(width, height);
            std::mt19937 random(seed);
            std::uniform_real_distribution<double> u;
            const TileSchedule schedule(film, adaptive(tolerance, 1 << 16));
            for (auto tiles = schedule.pending(); !tiles.empty(); tiles = schedule.pending())
                for (const int tile : tiles) {
                    const int target = schedule.target(tile);
                    forTile(schedule.tiles()[size_t(tile)], [&](int x, int y) {
                        while (int(film.sampleCount(x, y)) < target) {
                            const double rare = u(random) < 0.02 ? 5.0 : 0.0;
                            const double l = limit(x, y) * (1.8 * u(random) + rare);
                            film.addColor(x, y, glm::vec3(float(l)), 1.0f);
                        }
                    });
                }
            double found = 0.0;
            forPixels(film, [&](int x, int y) {
                found += std::abs(film.luminance(x, y) - limit(x, y)) / (limit(x, y) + 0.01) /
                         (width * height);
            });
            error += found / tolerance / 9.0;
            over += std::pow(tolerance / found, 2.0) / 9.0; // samples taken over those needed
        }
    EXPECT_LE(error, 1.03);
    EXPECT_LE(over, 1.2);
}
