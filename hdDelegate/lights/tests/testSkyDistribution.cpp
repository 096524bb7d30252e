// SPDX-License-Identifier: Apache-2.0
// The density that images of domes are sampled by: worth times the cosine of a surface.

#include "hdDelegate/lights/skyDistribution.h"
#include "hdDelegate/lights/tests/lightTools.h"
#include "shaders/tests/pearson.h"

using namespace patina;

namespace {

struct View {
    vec3 normal{0.0f};
    bool twoSided = false;
};

/// No normal, the poles, and some others, from one side and from both.
std::vector<View> views(uint32_t seed) {
    std::vector<View> result = {{}, {vec3(0.0f, 1.0f, 0.0f)}, {vec3(0.0f, -1.0f, 0.0f), true}};
    Random random(seed);
    for (int i = 0; i < 4; ++i)
        result.push_back({random.direction(), i % 2 == 1});
    return result;
}

/// A third of the cells black, and a sun.
std::vector<float> noisySky(int width, int height, uint32_t seed) {
    Random random(seed);
    std::vector<float> weights(size_t(width) * size_t(height));
    for (float& w : weights)
        w = random() < 0.33f ? 0.0f : random();
    weights[weights.size() / 3] = 1000.0f;
    return weights;
}

} // namespace

TEST(SkyDistribution, probabilitiesSumToOneAndAreThoseOfSamples) {
    // Sizes that blocks divide, that they do not, and of fewer cells than blocks.
    for (const glm::ivec2 size : {glm::ivec2(128, 64), glm::ivec2(75, 37), glm::ivec2(5, 3)}) {
        const std::vector<float> weights = noisySky(size.x, size.y, 41);
        const SkyDistribution sky(size.x, size.y, weights);
        for (const View& view : views(42)) {
            double sum = 0.0;
            for (int y = 0; y < size.y; ++y)
                for (int x = 0; x < size.x; ++x) {
                    const float p = sky.probability({x, y}, view.normal, view.twoSided);
                    const float weight = weights[size_t(y * size.x + x)];
                    // A part of the sky that a surface of any normal may see is never left out.
                    EXPECT_EQ(p > 0.0f, weight > 0.0f) << x << " " << y;
                    sum += double(p);
                }
            EXPECT_NEAR(sum, 1.0, 1e-5); // cumulative sums in float
            Random random(43);
            for (int i = 0; i < 2000; ++i) {
                glm::ivec2 cell;
                vec2 within;
                const float p =
                    sky.sample(random.square(), view.normal, view.twoSided, cell, within);
                ASSERT_EQ(p, sky.probability(cell, view.normal, view.twoSided));
                ASSERT_GT(p, 0.0f);
                ASSERT_TRUE(within.x >= 0.0f && within.x < 1.0f);
                ASSERT_TRUE(within.y >= 0.0f && within.y < 1.0f);
            }
        }
    }
}

TEST(SkyDistribution, samplesFollowTheProbabilities) {
    // Chi-squared over all cells that are expected 10 times, the others pooled; significance 3.4e-6
    // each, seeds 44 to 46.
    const int width = 70, height = 35, count = 150000;
    const SkyDistribution sky(width, height, noisySky(width, height, 44));
    for (const View& view : views(45)) {
        std::vector<int> hits(size_t(width * height), 0);
        Random random(46);
        for (int i = 0; i < count; ++i) {
            glm::ivec2 cell;
            vec2 within;
            sky.sample(random.square(), view.normal, view.twoSided, cell, within);
            ++hits[size_t(cell.y * width + cell.x)];
        }
        std::vector<double> expected(hits.size());
        for (size_t i = 0; i < hits.size(); ++i)
            expected[i] = count * double(sky.probability({int(i) % width, int(i) / width},
                                                         view.normal, view.twoSided));
        const test::Pearson result = test::pearson(expected, hits, 10.0);
        ASSERT_GT(result.cells(), 1);
        EXPECT_GT(result.tail(), 3.4e-6);
    }
}

TEST(SkyDistribution, skyBelowTheHorizonTakesFewSamples) {
    // Under an even sky half of all samples of the worth alone lie below. Now it is half of the
    // fiftieth that follows the worth, and what parts of blocks (2.8 by 2.8 degrees) and tables'
    // normals (within 9 degrees) are off: sin^2(12 degrees) of the cosines' sum, where both are at
    // their worst all around.
    const int width = 128, height = 64;
    std::vector<float> even;
    for (int y = 0; y < height; ++y)
        even.insert(even.end(), size_t(width),
                    std::sin(float(testPi) * (float(y) + 0.5f) / float(height)));
    const SkyDistribution sky(width, height, even);
    const double below12 = std::pow(std::sin(12.0 * testPi / 180.0), 2.0);
    Random random(47);
    for (int k = 0; k < 20; ++k) {
        const vec3 normal = random.direction();
        double below = 0.0, mean = 0.0, squares = 0.0;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const double p = sky.probability({x, y}, normal, false);
                const double cosine =
                    glm::dot(normal, latlongDirection((float(x) + 0.5f) / float(width),
                                                      (float(y) + 0.5f) / float(height)));
                const double value = even[size_t(y * width + x)] * std::max(cosine, 0.0);
                below += cosine < 0.0 ? p : 0.0;
                mean += value;
                squares += value * value / p;
            }
        EXPECT_LT(below, 0.01 + below12);
        // Variance of one sample over its squared mean: 5/3 by the worth alone, since the cosine's
        // square has a mean of 1/6 over the sphere and the cosine 1/4; a quarter at most is left.
        EXPECT_LT(squares / (mean * mean) - 1.0, 5.0 / 12.0);
    }
}

TEST(SkyDistribution, noWorthIsEmpty) {
    EXPECT_TRUE(SkyDistribution().empty());
    EXPECT_TRUE(SkyDistribution(4, 2, std::vector<float>(8, 0.0f)).empty());
    // All light below the horizon of a surface: what is there is sampled all the same.
    std::vector<float> low(64 * 32, 0.0f);
    for (int x = 0; x < 64; ++x)
        low[size_t(31 * 64 + x)] = 1.0f;
    const SkyDistribution sky(64, 32, low);
    glm::ivec2 cell;
    vec2 within;
    EXPECT_GT(sky.sample({0.3f, 0.6f}, {0.0f, 1.0f, 0.0f}, false, cell, within), 0.0f);
    EXPECT_EQ(cell.y, 31);
}
