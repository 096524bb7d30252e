// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/samples/previewWeights.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace patina;
using glm::vec3;

namespace {

/// Of a sky that is blue above and brown below, with a bright side: as bright as a density by
/// luminance leaves it.
std::vector<DomeSample> drawn(size_t number, unsigned seed) {
    std::mt19937 numbers(seed);
    std::uniform_real_distribution<float> u;
    std::vector<DomeSample> out;
    while (out.size() < number) {
        const float z = 1.0f - 2.0f * u(numbers), phi = 6.2831853f * u(numbers);
        const float r = std::sqrt(1.0f - z * z);
        const vec3 d(r * std::cos(phi), z, r * std::sin(phi));
        if (u(numbers) > 0.6f + 0.4f * d.x) continue;
        out.push_back({d, d.y > 0.0f ? vec3(0.6f, 0.8f, 1.4f) : vec3(1.5f, 0.9f, 0.5f)});
    }
    return out;
}

/// On a plane that faces up.
vec3 irradiance(const std::vector<DomeSample>& samples, const std::vector<vec3>& factors, vec3 up) {
    vec3 sum(0.0f);
    for (size_t k = 0; k < samples.size(); ++k)
        sum += factors[k] * samples[k].light * std::max(glm::dot(samples[k].direction, up), 0.0f);
    return sum / float(samples.size());
}

} // namespace

TEST(PreviewWeights, FewLightPlanesAsManyDo) {
    const std::vector<vec3> sides = {{0, 1, 0}, {0, -1, 0}, {1, 0, 0}, {0, 0, 1}, {-1, 0, 0}};
    double before = 0.0, after = 0.0;
    for (unsigned seed = 0; seed < 20; ++seed) {
        const std::vector<DomeSample> all = drawn(512, seed);
        const std::vector<DomeSample> few(all.begin(), all.begin() + 32);
        const std::vector<vec3> plain(few.size(), vec3(1.0f)), factors = previewWeights(few, all);
        ASSERT_EQ(factors.size(), few.size());
        for (const vec3& up : sides) {
            const vec3 truth = irradiance(all, std::vector<vec3>(all.size(), vec3(1.0f)), up);
            const vec3 a = irradiance(few, plain, up) - truth,
                       b = irradiance(few, factors, up) - truth;
            before += glm::dot(a, a);
            after += glm::dot(b, b);
        }
    }
    // Worth four times as many shadow maps at the least: half the deviation.
    EXPECT_LT(after, before / 4.0);
}

TEST(PreviewWeights, AllStayAsTheyAreWhereNothingIsMissingOrKnown) {
    const std::vector<DomeSample> all = drawn(32, 1);
    for (const vec3& factor : previewWeights(all, all))
        EXPECT_EQ(factor, vec3(1.0f));
    std::vector<DomeSample> black(64);
    for (DomeSample& s : black)
        s.direction = vec3(0, 1, 0);
    for (const vec3& factor : previewWeights({black.begin(), black.begin() + 32}, black))
        EXPECT_EQ(factor, vec3(1.0f));
    std::vector<DomeSample> one(64, {vec3(0, 1, 0), vec3(1.0f)});
    for (const vec3& factor : previewWeights({one.begin(), one.begin() + 32}, one))
        EXPECT_NEAR(factor.x, 1.0f, 1e-6f);
}
