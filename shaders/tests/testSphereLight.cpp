// SPDX-License-Identifier: Apache-2.0
// Samples of sphere lights: their density is that of where they are, and it does not change much
// over what a point sees of the light. Fixed seeds; the limits are far above what they leave.

#include <cmath>
#include <random>

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include "shaders/lights.h"
#include "shaders/tests/lobeCase.h"

using namespace patina;
using sh::vec2;
using sh::vec3;

namespace {

/// A light under an affine map, seen from the origin.
struct Pose {
    vec3 origin;
    glm::mat3 axes;

    bool hit(const vec3& wi, float& t, float& density) const {
        const glm::mat3 inverse = glm::inverse(axes);
        return shLights::sphereLightHit(inverse * -origin, inverse * wi,
                                        std::fabs(glm::determinant(axes)), t, density);
    }
    vec3 place(const vec3& u) const { return origin + axes * shLights::sphereLightPlace(u); }
};

std::vector<Pose> poses() {
    const glm::mat3 round(0.5f),
        skewed(vec3(1.2f, 0.1f, 0.0f), vec3(-0.2f, 0.4f, 0.1f), vec3(0.0f, 0.3f, -0.7f));
    std::vector<Pose> all;
    for (const glm::mat3& axes : {round, skewed})
        for (const vec3& at :
             {vec3(1.6f, 1.2f, 0.1f), vec3(0.1f, -1.2f, 0.9f), vec3(-0.5f, 1.7f, -1.3f)})
            all.push_back({at, axes});
    return all;
}

/// Directions of equal solid angle.
vec3 direction(vec2 u) {
    const float z = 1.0f - 2.0f * u.x, r = std::sqrt(1.0f - z * z), a = 2.0f * sh::PI * u.y;
    return vec3(r * std::cos(a), r * std::sin(a), z);
}

} // namespace

// The solid angle is a sum of one over density over samples, and a count over all directions.
TEST(SphereLight, samplesHaveTheirDensity) {
    std::mt19937 random(11);
    std::uniform_real_distribution<float> u(0.0f, 1.0f);
    constexpr int count = 200000, side = 1500;
    for (const Pose& p : poses()) {
        double bySamples = 0.0, lit = 0.0, turned = 0.0, turnedLit = 0.0;
        for (int i = 0; i < count; ++i) {
            const vec3 wi = glm::normalize(p.place(vec3(u(random), u(random), u(random))));
            float t, density;
            if (!p.hit(wi, t, density)) continue;
            bySamples += 1.0 / density / count;
            turned += wi.y / density / count; // where they are, not only how many
        }
        for (int i = 0; i < side * side; ++i) {
            const vec3 wi =
                direction((vec2(float(i % side), float(i / side)) + 0.5f) / float(side));
            float t, density;
            if (!p.hit(wi, t, density)) continue;
            lit += 4.0 * sh::PI / (double(side) * side);
            turnedLit += wi.y * 4.0 * sh::PI / (double(side) * side);
        }
        ASSERT_GT(lit, 0.0);
        EXPECT_NEAR(bySamples / lit, 1.0, 0.01);
        EXPECT_NEAR(turned / lit, turnedLit / lit, 0.01);
    }
}

// From far away all samples of a ball count alike: that is what they are for.
TEST(SphereLight, densityIsEvenFromFarAway) {
    const Pose p{vec3(100.0f, 3.0f, 1.0f), glm::mat3(0.5f)};
    std::mt19937 random(12);
    std::uniform_real_distribution<float> u(0.0f, 1.0f);
    float low = 1e30f, high = 0.0f;
    for (int i = 0; i < 1000; ++i) {
        float t, density;
        if (!p.hit(glm::normalize(p.place(vec3(u(random), u(random), u(random)))), t, density))
            continue;
        low = std::min(low, density);
        high = std::max(high, density);
    }
    EXPECT_LT(high / low, 1.02f);
}

TEST(SphereLight, nothingShinesInwards) {
    float t, density;
    EXPECT_FALSE(shLights::sphereLightHit(vec3(0.2f, 0.0f, 0.0f), vec3(1, 0, 0), 1.0f, t, density));
    EXPECT_FALSE(shLights::sphereLightHit(vec3(2.0f, 0.0f, 0.0f), vec3(1, 0, 0), 1.0f, t, density));
}

// A lamp of a centimetre, ten kilometres away.
TEST(SphereLight, smallOnesFarAwayAreNotLost) {
    const Pose p{vec3(8000.0f, 5000.0f, 3000.0f), glm::mat3(0.01f)};
    const float solidAngle = sh::PI * 0.01f * 0.01f / glm::dot(p.origin, p.origin);
    std::mt19937 random(13);
    std::uniform_real_distribution<float> u(0.0f, 1.0f);
    for (int i = 0; i < 1000; ++i) {
        float t, density;
        p.hit(glm::normalize(p.place(vec3(u(random), u(random), u(random)))), t, density);
        ASSERT_NEAR(density * solidAngle, 1.0f, 0.001f);
    }
}
