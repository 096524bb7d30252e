// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/passes/rasterFilterSplat.h"

#include "hdDelegate/film/tests/filmFixtures.h"

#include <cmath>

namespace {

using namespace patina;

/// Moments of where samples lie in the pixels that they go to, by their shares.
void expectMoments(float radius, double weightOfOthers) {
    const PixelFilter filter(radius);
    const int reach = filter.reach(), count = 4096;
    double plain[3] = {0, 0, 0}, shared[3] = {0, 0, 0}, others = 0.0;
    for (int n = 0; n < count; ++n) {
        const float x = filter.sample({(float(n) + 0.5f) / float(count), 0.5f}).x;
        const std::vector<float> weights = filter.splatWeights(x);
        ASSERT_EQ(int(weights.size()), 2 * reach + 1);
        for (int k = 0; k < 3; ++k)
            plain[k] += std::pow(double(x), 2 * k) / count;
        for (int i = -reach; i <= reach; ++i) {
            const double share = double(weights[size_t(i + reach)]);
            if (i != 0) others += share / count;
            for (int k = 0; k < 3; ++k)
                shared[k] += share * std::pow(double(x) - i, 2 * k) / count;
        }
    }
    for (int k = 0; k < 3; ++k)
        EXPECT_NEAR(shared[k], plain[k], 2e-3 * plain[k]) << "radius " << radius;
    EXPECT_NEAR(others, weightOfOthers, 0.01) << "radius " << radius;
}

TEST(RasterFilterSplat, keepThePixelFilter) {
    expectMoments(0.0f, 0.0);
    expectMoments(0.5f, 0.0);
    expectMoments(1.0f,
                  0.3823); // integrals of g(x) (1 - g(x) / sum over k of g(x + k)), by numbers
    expectMoments(1.7f, 0.6372);
}

TEST(RasterFilterSplat, leaveValuesThatAreNoNumbersWhereTheyAre) {
    // All of them infinite, too: for each pixel a look at each would take hours.
    for (const bool all : {false, true}) {
        const int width = 1024, height = 768;
        TestFilm film(width, height);
        RasterSample sample;
        sample.splatX = sample.splatY = {0.1f, 0.7f, 0.2f};
        std::vector<glm::vec4> pixels(size_t(width + 2) * size_t(height + 2),
                                      glm::vec4(all ? INFINITY : 1.0f));
        if (!all) pixels[size_t(height - 5) * size_t(width + 2) + 8] = glm::vec4(NAN);
        const int window[4] = {0, 0, width - 1, height - 1};
        addSplats(pixels, sample, window, film);
        EXPECT_EQ(film.droppedSamples(), uint64_t(all ? width * height : 1));
        EXPECT_EQ(film.color(7, 5), glm::vec3(0.0f)) << "x is 8 less the border, y down";
        EXPECT_NEAR(film.color(20, 5).x, all ? 0.0f : 1.0f, 1e-6f);
    }
}

TEST(RasterFilterSplat, takeASampleToThePixelsThatItLiesIn) {
    const int width = 5, height = 4;
    TestFilm film(width, height);
    RasterSample sample;
    sample.splatX = {0.1f, 0.7f, 0.2f}; // left, own, right
    sample.splatY = {0.3f, 0.6f, 0.1f}; // above, own, below
    std::vector<glm::vec4> pixels(size_t(width + 2) * size_t(height + 2), glm::vec4(0.0f));
    // Column 3 and, y down, row 1 of the film; row height - 1 - 1 + 1 from below with the border.
    pixels[size_t(3) * size_t(width + 2) + 4] = glm::vec4(100.0f, 200.0f, 0.0f, 1.0f);
    pixels[0] = glm::vec4(100.0f, 0.0f, 0.0f, 1.0f); // outside, beside the lower left corner
    const int window[4] = {0, 0, width - 1, height - 1};
    addSplats(pixels, sample, window, film);
    const auto red = [&](int x, int y) { return film.color(x, y).x; };
    const std::tuple<int, int, float> places[] = {
        {3, 1, 42.0f}, {2, 1, 6.0f}, {4, 1, 12.0f},
        {3, 0, 21.0f}, {3, 2, 7.0f}, {0, 3, 6.0f}, // to the right by 0.2, up by 0.3
        {0, 2, 0.0f}};
    for (const auto& [x, y, expected] : places)
        EXPECT_FLOAT_EQ(red(x, y), expected) << x << " " << y;
}

} // namespace
