// SPDX-License-Identifier: Apache-2.0
// Wavelengths of paths, and the weights that keep their mean.
#include "hdDelegate/embree/heroWavelengths.h"
#include "hdDelegate/embree/wavelengths.h"
#include "materialNetwork/tests/materialFixture.h"

#include <cmath>

namespace patina {

TEST(Wavelengths, WhatAllHaveInCommonStaysAsItIs) {
    constexpr int n = 1 << 20;
    glm::dvec3 sum(0.0);
    float last = 0.0f;
    for (int i = 0; i < n; ++i) {
        const Wavelengths::Drawn drawn = Wavelengths::of().draw((float(i) + 0.5f) / float(n));
        EXPECT_GE(drawn.nm, last);
        last = drawn.nm;
        sum += glm::dvec3(drawn.weight);
        for (int c = 0; c < 3; ++c)
            ASSERT_TRUE(drawn.weight[c] >= 0.0f && drawn.weight[c] <= 3.0001f);
    }
    // A midpoint rule errs in the 400 bins' edges alone: by at most a step of 3 / n in each.
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(sum[c] / n, 1.0, 400.0 * 3.0 / n);
}

TEST(Wavelengths, TheyAreDrawnByWhatChannelsSee) {
    // The share of draws below a wavelength is the mean share of what channels see below it.
    for (const float u : {0.1f, 0.35f, 0.6f, 0.9f}) {
        const float nm = Wavelengths::of().draw(u).nm;
        double below = 0.0;
        for (float x = 380.0f + 0.05f; x < nm; x += 0.1f) {
            const vec3 s = Wavelengths::of().sensitivity(x);
            below += 0.1 * double(s.x + s.y + s.z) / 3.0;
        }
        EXPECT_NEAR(below, u, 2e-3); // a step of 0.1 nm sees 0.001 at most
    }
}

TEST(Wavelengths, OneOfThreeStandsForAll) {
    // The mean over heroes of what is left when the others are left out is what all had together.
    for (const float u : {0.0f, 0.2f, 0.77f, 0.999f}) {
        HeroWavelengths waves;
        const vec3 all = waves.begin(u);
        float chances = 0.0f;
        vec3 shares(0.0f), mean(0.0f);
        for (int hero = 0; hero < HeroWavelengths::count; ++hero) {
            chances += waves.chances[hero];
            shares += waves.shares[hero];
            HeroWavelengths turned;
            const float third = u + float(hero) / float(HeroWavelengths::count);
            const vec3 together = turned.begin(third < 1.0f ? third : third - 1.0f);
            EXPECT_LT(glm::length(together - all), 1e-3f) << "the set of wavelengths is the same";
            mean += together * turned.leaveOthers() / float(HeroWavelengths::count);
            EXPECT_TRUE(turned.alone);
            EXPECT_EQ(turned.shares[0], vec3(1.0f));
        }
        EXPECT_FLOAT_EQ(chances, float(HeroWavelengths::count));
        EXPECT_LT(glm::length(mean - all), 1e-3f);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(shares[c], all[c] > 0.0f ? 1.0f : 0.0f, 1e-6f);
    }
}

// Directions of two wavelengths, computed apart, differ in their last bits, and more so on surfaces
// that lie askew. A path whose hero does not find its own direction would end there. Five standard
// errors: p = 6e-7 for each of 3 channels and 8 materials, with one seed.
TEST(Wavelengths, GlassThatDispersesLosesNoLightHoweverItLies) {
    for (const float ior : {1.0f, 1.52f})
        for (const float scale : {0.01f, 1.0f})
            for (const float roughness : {0.0f, 0.3f}) {
                const Compiled c(
                    makeNetwork({makeNode("surface", "ND_open_pbr_surface_surfaceshader",
                                          {{"transmission_weight", number(1.0f)},
                                           {"specular_ior", number(ior)},
                                           {"specular_roughness", number(roughness)},
                                           {"transmission_dispersion_abbe_number", number(64.0f)},
                                           {"transmission_dispersion_scale", number(scale)}})}));
                Random random(3);
                constexpr int n = 4000;
                glm::dvec3 sum(0.0), squares(0.0);
                for (int i = 0; i < n; ++i) {
                    ShadingPoint point;
                    point.normal = point.geometricNormal = random.direction();
                    point.tangent = glm::normalize(glm::cross(point.normal, random.direction()));
                    point.bitangent = glm::cross(point.normal, point.tangent);
                    point.viewDirection = random.direction();
                    HeroWavelengths waves, after;
                    vec3 throughput = waves.begin(random.next());
                    point.wavelength = waves.nm[0];
                    vec3 passes;
                    const float presence = c.program->opacity(point, &passes);
                    if (random.next() >= presence) {
                        throughput *= passes;
                    } else {
                        Bsdf hero;
                        c.program->evaluate(point, hero);
                        const DispersedBsdf bsdf(*c.program, point, waves, hero);
                        const vec3 u = random.next3();
                        const BsdfSample s = bsdf.sample(u, random.next(), after);
                        if (roughness == 0.0f) {
                            ASSERT_NE(s.event, 0) << ior << " " << scale;
                        }
                        throughput *= s.weight;
                        if (s.event != 0) {
                            EXPECT_NEAR(after.chances[0] + after.chances[1] + after.chances[2],
                                        float(HeroWavelengths::count), 1e-4f);
                        }
                    }
                    sum += glm::dvec3(throughput);
                    squares += glm::dvec3(throughput) * glm::dvec3(throughput);
                }
                for (int k = 0; k < 3; ++k) {
                    const double mean = sum[k] / n;
                    const double error = std::sqrt((squares[k] / n - mean * mean) / n);
                    // Tables of rough glass are good to 4e-3.
                    EXPECT_NEAR(mean, 1.0, 5.0 * error + (roughness > 0.0f ? 4e-3 : 0.0))
                        << ior << " " << scale << " " << roughness;
                }
            }
}

} // namespace patina
