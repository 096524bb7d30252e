// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/tileSchedule.h"

#include <gtest/gtest.h>

using namespace patina;

namespace {

void fill(Film& film, const Tile& tile, int samples, bool noisy) {
    for (int y = tile.y0; y < tile.y1; ++y)
        for (int x = tile.x0; x < tile.x1; ++x)
            for (int i = int(film.sampleCount(x, y)); i < samples; ++i)
                film.addColor(x, y, glm::vec3(noisy && i % 2 ? 0.0f : 1.0f), 1.0f);
}

} // namespace

TEST(TileSchedule, TilesCoverTheImageOnce) {
    Film film;
    film.reset(50, 35, {});
    const TileSchedule schedule(film, RenderSettings());
    std::vector<int> covered(50 * 35, 0);
    for (const Tile& t : schedule.tiles())
        for (int y = t.y0; y < t.y1; ++y)
            for (int x = t.x0; x < t.x1; ++x)
                ++covered[y * 50 + x];
    for (int c : covered)
        EXPECT_EQ(c, 1);
}

TEST(TileSchedule, DataWindowLimitsTheTiles) {
    Film film;
    film.reset(50, 35, {});
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
    Film film;
    film.reset(32, 16, {});
    RenderSettings settings;
    settings.samples = 4;
    TileSchedule schedule(film, settings);
    fill(film, schedule.tiles()[0], 1, true);
    EXPECT_EQ(schedule.pending(), std::vector<int>{1});
    fill(film, schedule.tiles()[1], 4, true);
    EXPECT_EQ(schedule.pending(), std::vector<int>{0});
    fill(film, schedule.tiles()[0], 4, true);
    EXPECT_TRUE(schedule.pending().empty());
    EXPECT_DOUBLE_EQ(schedule.fraction(), 1.0);
}

TEST(TileSchedule, QuietTilesStopAtTheToleranceAndNoisyOnesDoNot) {
    Film film;
    film.reset(32, 16, {});
    RenderSettings settings;
    settings.samples = 1024;
    settings.minSamples = 16;
    settings.tolerance = 0.05;
    TileSchedule schedule(film, settings);
    fill(film, schedule.tiles()[0], 16, false);
    fill(film, schedule.tiles()[1], 16, true);
    EXPECT_EQ(schedule.target(0), 0);
    EXPECT_EQ(schedule.target(1), 32);
}

TEST(TileSchedule, TilesAreLookedAtAtSomeStepsOnly) {
    for (const auto& [samples, target] : {std::pair(16, 0), {24, 32}, {32, 0}, {48, 0}, {80, 96}}) {
        Film film;
        film.reset(4, 4, {});
        RenderSettings settings;
        settings.samples = 1024;
        settings.minSamples = 16;
        settings.tolerance = 0.05;
        const TileSchedule schedule(film, settings);
        fill(film, schedule.tiles()[0], samples, false);
        EXPECT_EQ(schedule.target(0), target) << samples;
    }
}

TEST(TileSchedule, ATileThatWasBrokenOffGoesOn) {
    Film film;
    film.reset(4, 4, {});
    RenderSettings settings;
    settings.samples = 1024;
    settings.minSamples = 16;
    settings.tolerance = 0.05;
    TileSchedule schedule(film, settings);
    fill(film, schedule.tiles()[0], 32, false); // would be enough
    fill(film, {0, 0, 4, 1}, 48, false);        // but its first row has gone on
    EXPECT_EQ(schedule.target(0), 48);
}
