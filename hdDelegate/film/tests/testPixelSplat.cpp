// SPDX-License-Identifier: Apache-2.0
// Samples that count for all pixels that their filter reaches: against the filter itself, and their
// error against that of images of known limit.

#include "hdDelegate/film/pixelFilter.h"
#include "hdDelegate/film/pixelSplat.h"
#include "hdDelegate/film/relativeError.h"
#include "hdDelegate/film/sampler.h"
#include "base/maths.h"

#include "hdDelegate/film/tests/filmFixtures.h"

#include <cmath>
#include <numeric>
#include <random>

namespace patina {

namespace {

constexpr int columns = 12, lines = 8;

class SplatFilm : public TestFilm {
public:
    explicit SplatFilm(float radius)
        : TestFilm(columns, lines, {standardAov("quarterColors"), standardAov("quarterShares")}),
          _radius(radius) {}

    void add(int x, int y, const glm::vec2& offset, const glm::vec3& color, float alpha = 1.0f) {
        addQuarter(0, 1, x, y, PixelFilter::quarterOf(offset), color, alpha, _radius);
        addColor(x, y, color, alpha);
    }

private:
    float _radius;
};

float atPixel(const std::vector<float>& color, int x, int y) {
    return color[size_t(y * columns + x) * 3];
}

} // namespace

TEST(PixelSplat, CellsHaveTheMassOfTheFilter) {
    for (const float radius : {0.6f, 1.0f, 1.5f, 2.3f}) {
        const std::vector<float> cells = PixelFilter(radius).halfPixelWeights();
        const int side = int(cells.size() / 2);
        EXPECT_NEAR(std::accumulate(cells.begin(), cells.end(), 0.0), 1.0, 1e-6);
        std::vector<double> mass(cells.size());
        constexpr int steps = 20000;
        double sum = 0.0;
        for (int i = 0; i < steps; ++i) {
            const double x = ((i + 0.5) / steps * 2.0 - 1.0) * double(radius);
            const double f = std::exp(-2.0 * (x / double(radius)) * (x / double(radius)));
            mass[size_t(int(std::floor(2.0 * x)) + side)] += f;
            sum += f;
        }
        for (size_t i = 0; i < cells.size(); ++i)
            EXPECT_NEAR(double(cells[i]), mass[i] / sum, 1e-3) << radius << " " << i;
    }
}

TEST(PixelSplat, OneColourStaysWhateverTheNumbersOfSamples) {
    SplatFilm film(1.0f);
    std::mt19937 random(3);
    std::uniform_real_distribution<float> place(-0.5f, 0.5f);
    EXPECT_FALSE(film.splats());
    forPixels(film, [&](int x, int y) {
        for (int i = 0; i <= (x + 3 * y) % 5; ++i)
            film.add(x, y, {place(random), place(random)}, {0.3f, 0.7f, 11.0f});
    });
    EXPECT_TRUE(film.splats());
    EXPECT_FLOAT_EQ(film.splatRadius(4, 4), 1.0f);
    const std::vector<float> color = film.resolve("color"), alpha = film.resolve("alpha");
    for (size_t i = 0; i < alpha.size(); ++i) {
        EXPECT_EQ(alpha[i], 1.0f);
        EXPECT_FLOAT_EQ(color[3 * i], 0.3f);
        EXPECT_FLOAT_EQ(color[3 * i + 1], 0.7f);
        EXPECT_FLOAT_EQ(color[3 * i + 2], 11.0f);
    }
}

TEST(PixelSplat, ASlopeStaysWhereThePixelsAroundAreThere) {
    SplatFilm film(1.0f);
    const auto slope = [](double x, double y) { return float(1.0 + 0.5 * x + 0.25 * y); };
    forPixels(film, [&](int x, int y) {
        for (const float v : {-0.25f, 0.25f})
            for (const float u : {-0.25f, 0.25f})
                film.add(x, y, {u, v}, glm::vec3(slope(double(x) + u, double(y) + v)));
    });
    const std::vector<float> color = film.resolve("color");
    for (int y = 1; y + 1 < lines; ++y)
        for (int x = 1; x + 1 < columns; ++x)
            EXPECT_NEAR(atPixel(color, x, y), slope(x, y), 1e-5);
}

TEST(PixelSplat, AQuarterCountsAsTheFilterDoesThere) {
    for (const float radius : {0.75f, 1.0f, 1.6f}) {
        SplatFilm film(radius);
        forPixels(film, [&](int x, int y) {
            for (const float v : {-0.25f, 0.25f})
                for (const float u : {-0.25f, 0.25f})
                    film.add(x, y, {u, v}, glm::vec3(x == 5 && y == 4 && u > 0 && v < 0 ? 1 : 0));
        });
        const std::vector<float> color = film.resolve("color");
        const std::vector<float> cells = PixelFilter(radius).halfPixelWeights();
        const int side = int(cells.size() / 2);
        const auto weight = [&](int i) {
            return i < -side || i >= side ? 0.0f : cells[size_t(i + side)];
        };
        for (int y = 2; y + 2 < lines; ++y)
            for (int x = 2; x + 2 < columns; ++x)
                EXPECT_NEAR(atPixel(color, x, y), weight(2 * (5 - x)) * weight(2 * (4 - y) - 1),
                            1e-6)
                    << radius << " " << x << " " << y;
    }
}

TEST(PixelSplat, OtherMeansKeepWhatQuartersTheyHadComeFrom) {
    SplatFilm film(1.0f);
    forPixels(film, [&](int x, int y) {
        film.add(x, y, {-0.2f, 0.2f}, glm::vec3(4.0f));
        film.add(x, y, {0.2f, 0.2f}, glm::vec3(x == 3 ? 0.0f : 2.0f));
    });
    const PixelSplat splat(film);
    std::vector<float> own(size_t(columns * lines * 3));
    forPixels(film, [&](int x, int y) {
        for (int c = 0; c < 3; ++c)
            own[size_t((y * columns + x) * 3 + c)] = 0.5f * film.color(x, y)[c];
    });
    const std::vector<float> half = splat.color(own), whole = film.resolve("color");
    for (size_t i = 0; i < half.size(); ++i)
        EXPECT_NEAR(half[i], 0.5f * whole[i], 1e-6);
}

TEST(PixelSplat, LightThatCancelsOutIsNotBlownUp) {
    SplatFilm film(1.0f);
    film.allowNegative(true);
    forPixels(film, [&](int x, int y) {
        film.add(x, y, {-0.2f, 0.2f}, glm::vec3(4.0f));
        film.add(x, y, {0.2f, 0.2f}, glm::vec3(-3.999f));
    });
    const std::vector<float> own(size_t(columns * lines * 3), 0.25f);
    const std::vector<float> whole = film.resolve("color"), other = PixelSplat(film).color(own);
    for (size_t i = 0; i < other.size(); ++i)
        EXPECT_NEAR(other[i], whole[i] + 0.25f - 0.0005f, 1e-3);
}

TEST(PixelSplat, OwnMeansShowOnceQuartersAreForgotten) {
    SplatFilm film(1.0f);
    forPixels(film, [&](int x, int y) { film.add(x, y, {0.2f, 0.2f}, glm::vec3(x == 4)); });
    EXPECT_LT(atPixel(film.resolve("color"), 4, 3), 1.0f);
    film.forgetQuarters();
    EXPECT_EQ(atPixel(film.resolve("color"), 4, 3), 1.0f);
    EXPECT_EQ(atPixel(film.resolve("color"), 5, 3), 0.0f);
}

TEST(PixelSplat, AForgedRadiusIsNoLargerThanTheLargest) {
    SplatFilm film(1e30f);
    forPixels(film, [&](int x, int y) { film.add(x, y, {0.2f, 0.2f}, glm::vec3(1.0f)); });
    EXPECT_EQ(film.splatRadius(0, 0), float(PixelFilter::largestReach));
}

TEST(PixelSplat, ErrorIsToldAsSmallAsItIs) {
    constexpr int images = 40;
    constexpr float limit = 0.5f;
    for (const int samples : {16, 64}) {
        double told = 0.0, there = 0.0, alone = 0.0;
        for (int image = 0; image < images; ++image) {
            SplatFilm film(1.0f);
            forPixels(film, [&](int x, int y) {
                for (int i = 0; i < samples; ++i) {
                    Sampler sampler{uint32_t(x), uint32_t(y), uint32_t(image), uint32_t(i)};
                    const glm::vec2 place = sampler.next2() - 0.5f;
                    film.add(x, y, place, glm::vec3(sampler.random()));
                }
                alone += std::abs(double(film.luminance(x, y)) - limit) / (limit + 0.01);
            });
            const std::vector<float> color = film.resolve("color");
            for (size_t i = 0; i < color.size(); i += 3)
                there += std::abs(double(color[i]) - limit) / (limit + 0.01);
            told += relativeError(film, 0, 0, columns, lines) * columns * lines;
        }
        // The deviation of a pixel over that of its own samples, along an axis of so many pixels:
        // those at the ends have neighbours on one side alone.
        const auto less = [](int pixels) {
            const std::vector<float> w = PixelFilter(1.0f).halfPixelWeights();
            const double inner = 2.0 * (2.0 * w[0] * w[0] + 2.0 * w[1] * w[1]);
            const double outer = 2.0 * (w[0] * w[0] + 2.0 * w[1] * w[1]) /
                                 std::pow(double(w[0]) + 2.0 * double(w[1]), 2.0);
            return ((pixels - 2) * std::sqrt(inner) + 2.0 * std::sqrt(outer)) / pixels;
        };
        // A mean of |normal numbers| has a relative standard error of 0.756 / sqrt(numbers); as
        // many as err alike count as one. Four of them: a significance of 1e-4.
        const double together = PixelSplat::Noise(1.0f).together;
        const double numbers = images * columns * lines;
        const double chance = 4.0 * 0.756 * std::sqrt((1.0 + together) / numbers);
        EXPECT_NEAR(there / alone / (less(columns) * less(lines)), 1.0, chance) << samples;
        // What is told lies above by relativeError()'s margin of two standard errors.
        const double margin =
            2.0 * std::sqrt(0.639 * 0.5 * double(pi) * together / (columns * lines));
        EXPECT_NEAR(told / there, 1.0 + margin, 2.0 * chance) << samples;
    }
}

} // namespace patina
