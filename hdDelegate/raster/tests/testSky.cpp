// SPDX-License-Identifier: Apache-2.0
// Harmonics and prefiltered maps against sums over all directions, and where they fail.
#include "hdDelegate/raster/lights/prefilteredSky.h"
#include "hdDelegate/raster/lights/skyHarmonics.h"
#include "shaders/shaders.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace patina;
using glm::vec3;

constexpr float pi = 3.14159265f;

vec3 directionAt(int x, int y, int w, int h) {
    const float phi = (float(x) + 0.5f) / float(w) * 2.0f * pi;
    const float theta = (float(y) + 0.5f) / float(h) * pi;
    return vec3(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi));
}

/// The integral of f over the sphere, midpoints of 512 by 256.
template <typename F> vec3 overSphere(const F& f) {
    const int w = 512, h = 256;
    glm::dvec3 sum(0.0);
    for (int y = 0; y < h; ++y) {
        const float angle =
            (std::cos(float(y) / h * pi) - std::cos(float(y + 1) / h * pi)) * 2.0f * pi / w;
        for (int x = 0; x < w; ++x)
            sum += glm::dvec3(f(directionAt(x, y, w, h)) * angle);
    }
    return vec3(sum);
}

vec3 irradiance(const std::function<vec3(const vec3&)>& sky, const vec3& n) {
    return overSphere([&](const vec3& d) { return sky(d) * std::max(0.0f, glm::dot(d, n)); });
}

/// A horizon, a blue zenith and a broad glow.
vec3 softSky(const vec3& d) {
    const float glow =
        std::pow(std::max(0.0f, glm::dot(d, glm::normalize(vec3(1, 1, 0.5f)))), 8.0f);
    return vec3(0.2f, 0.25f, 0.3f) + std::max(d.y, 0.0f) * vec3(0.2f, 0.4f, 0.9f) +
           2.0f * glow * vec3(1.0f, 0.9f, 0.7f);
}

const vec3 sun = glm::normalize(vec3(0.3f, 0.8f, -0.5f));

/// A grey sky with one bright pixel of a 512 by 256 image.
vec3 onePixel(const vec3& d) {
    return vec3(0.3f) +
           (std::acos(std::min(1.0f, glm::dot(d, sun))) < 0.0123f ? vec3(1e5f) : vec3(0.0f));
}

TEST(SkyHarmonics, irradianceOfASoftSkyIsWithinThreePercent) {
    const SkyHarmonics sky = makeSkyHarmonics(softSky);
    EXPECT_EQ(sky.window, 0.0f);
    for (int i = 0; i < 20; ++i) {
        const vec3 n = directionAt(i % 5, i / 5, 5, 4);
        const vec3 truth = irradiance(softSky, n);
        vec3 found = sky.at(n);
        found += sky.sunIrradiance * std::max(0.0f, glm::dot(n, sky.sunDirection));
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(found[c] / truth[c], 1.0f, 0.03f) << i;
    }
}

TEST(SkyHarmonics, aConstantSkyIsExact) {
    const SkyHarmonics sky = makeSkyHarmonics([](const vec3&) { return vec3(2.0f); });
    EXPECT_EQ(sky.sunIrradiance, vec3(0.0f));
    for (const vec3& n : {vec3(0, 1, 0), vec3(0.6f, 0, 0.8f), vec3(0, -1, 0)})
        EXPECT_NEAR(sky.at(n).x, 2.0f * pi, 1e-3f);
}

TEST(SkyHarmonics, oneBrightPixelIsSplitOff) {
    const SkyHarmonics sky = makeSkyHarmonics(onePixel);
    EXPECT_GT(glm::dot(sky.sunDirection, sun), std::cos(0.01f));
    const vec3 facing = irradiance(onePixel, sun);
    // Both grids see a disk of few directions: its area is known to a sixth.
    EXPECT_NEAR(sky.sunIrradiance.x / (facing.x - 0.3f * pi), 1.0f, 0.17f);
    for (const vec3& n : {sun, -sun, vec3(0, 1, 0), vec3(1, 0, 0)})
        EXPECT_NEAR(sky.at(n).x, 0.3f * pi, 0.02f);
}

TEST(SkyHarmonics, withoutTheSplitOneBrightPixelRingsOrIsSpread) {
    // Away from the sun the truth is the grey sky alone. Order 2 gives light there: the window
    // keeps it from being negative, and cannot keep it from being wrong.
    const SkyHarmonics whole = makeSkyHarmonics(onePixel, false);
    EXPECT_GT(whole.window, 0.0f);
    float maximum = 0.0f;
    for (int i = 0; i < 200; ++i) {
        const vec3 n = directionAt(i % 20, i / 20, 20, 10);
        EXPECT_GE(whole.at(n).x, -1e-3f);
        if (glm::dot(n, sun) < 0.0f) maximum = std::max(maximum, whole.at(n).x);
    }
    EXPECT_GT(maximum, 2.0f * 0.3f * pi);
}

TEST(SkyHarmonics, withoutAWindowOneBrightPixelRingsBelowZero) {
    const SkyHarmonics bare = makeSkyHarmonics(onePixel, false, false);
    EXPECT_EQ(bare.window, 0.0f);
    float minimum = 0.0f;
    for (int i = 0; i < 200; ++i)
        minimum = std::min(minimum, bare.at(directionAt(i % 20, i / 20, 20, 10)).x);
    EXPECT_LT(minimum, -0.1f);
}

TEST(SkyHarmonics, survivesWhatIsNoLight) {
    const SkyHarmonics sky = makeSkyHarmonics(
        [](const vec3& d) { return d.x > 0.0f ? vec3(NAN) : vec3(-1.0f, INFINITY, 0.0f); });
    EXPECT_EQ(sky.at(vec3(0, 1, 0)), vec3(0.0f));
}

/// The reflection of a sky in a white GGX mirror, normal +y: the sum over all directions and the
/// ratio of the prefiltered map to it.
float prefilteredOverTruth(const PrefilteredSky& maps, float alpha, int level, float degrees,
                           const std::function<vec3(const vec3&)>& sky) {
    const float a = degrees * pi / 180.0f;
    const vec3 wo(std::sin(a), 0.0f, std::cos(a)); // local, z up
    const sh::ConductorLobe lobe =
        sh::conductorSetup(vec3(0.2f), vec3(5.0f), glm::vec2(alpha), false, 0);
    const vec3 truth = overSphere([&](const vec3& d) {
        const vec3 wi(d.x, d.z, d.y);
        return sh::conductorEval(lobe, wo, wi).value * sky(d);
    });
    const vec3 white = overSphere(
        [&](const vec3& d) { return sh::conductorEval(lobe, wo, vec3(d.x, d.z, d.y)).value; });
    const vec3 mirrored(-wo.x, wo.z, -wo.y);
    return white.y * maps.at(mirrored, level).y / truth.y;
}

TEST(PrefilteredSky, isTheLobesOwnAlongTheNormal) {
    const PrefilteredSky maps(softSky);
    for (int level = 1; level < 4; ++level) {
        const float ratio =
            prefilteredOverTruth(maps, PrefilteredSky::alphaOf(level), level, 1.0f, softSky);
        EXPECT_NEAR(ratio, 1.0f, 0.04f) << level;
    }
}

TEST(PrefilteredSky, failsAtGrazingAngles) {
    // Half of what it takes in there is below the horizon, which no mirror shows.
    const auto above = [](const vec3& d) { return vec3(d.y > 0.0f ? 1.0f : 0.0f); };
    const PrefilteredSky maps(above);
    EXPECT_LT(prefilteredOverTruth(maps, 0.4f, 2, 87.0f, above), 0.8f);
}

TEST(PrefilteredSky, levelsAreInOrder) {
    for (int i = 0; i < PrefilteredSky::levels; ++i)
        EXPECT_NEAR(PrefilteredSky::levelOf(PrefilteredSky::alphaOf(i)), float(i), 1e-5f);
    EXPECT_EQ(PrefilteredSky::levelOf(0.0f), 0.0f);
}

} // namespace
