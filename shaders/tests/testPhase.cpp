// SPDX-License-Identifier: Apache-2.0
// The phase function: normalised, sampled by its own density, with the mean cosine that it
// promises.

#include <limits>

#include <gtest/gtest.h>

#include "shaders/tests/lobeCase.h"

using namespace patina;
using namespace patina::test;

namespace {

const double anisotropies[] = {-1.0, -0.9, -0.5, -1e-4, 0.0, 1e-4, 0.3, 0.8, 0.99, 1.0};

} // namespace

TEST(Phase, IntegratesToOneWithItsMeanCosine) {
    for (double g : anisotropies) {
        const auto l = sh64::phaseHenyeyGreensteinSetup(g);
        const vec3 wo(0, 0, 1);
        double sum = 0.0, mean = 0.0;
        const int n = 20000;
        // Tanh-spaced cosines: the peak at |g| = 0.999 is 1e-6 wide.
        for (int i = 0; i < n; ++i) {
            const double s = -14.0 + 28.0 * (i + 0.5) / n, c = std::tanh(s);
            const double sine = 1.0 / std::cosh(s), width = sine * sine * 28.0 / n;
            const double value =
                2.0 * M_PI * sh64::phaseHenyeyGreensteinEval(l, wo, vec3(sine, 0, -c)).pdf * width;
            sum += value;
            mean += value * c;
        }
        EXPECT_NEAR(sum, 1.0, 1e-4) << g;
        EXPECT_NEAR(mean, l.g, 1e-4) << g;
    }
}

TEST(Phase, SamplesAreUnitAndHaveTheirDensity) {
    for (double g : anisotropies)
        for (const vec3 wo :
             {vec3(0, 0, 1), vec3(0, 0, -1), direction(0.3, 1.0), direction(-0.9, 4)})
            for (int i = 0; i < 300; ++i) {
                const auto l = sh64::phaseHenyeyGreensteinSetup(g);
                const vec3 u = quasiRandom(i);
                const auto s = sh64::phaseHenyeyGreensteinSample(l, wo, u);
                ASSERT_NEAR(sh64::length(s.wi), 1.0, 1e-9);
                // The share of the sphere's measure up to the sampled cosine is u, in closed form.
                const double c = -sh64::dot(wo, s.wi);
                const double root = std::sqrt(1 + l.g * l.g - 2 * l.g * c);
                const double below = std::fabs(l.g) < 1e-6
                                         ? 0.5 * (1 + c)
                                         : (1 - l.g * l.g) / (2 * l.g) * (1 / root - 1 / (1 + l.g));
                ASSERT_NEAR(below, u.x, 1e-6) << g;
                const auto f = sh::phaseHenyeyGreensteinSample(
                    sh::phaseHenyeyGreensteinSetup(float(g)), sh::vec3(wo), sh::vec3(u));
                ASSERT_NEAR(sh64::length(vec3(f.wi)), 1.0, 1e-5);
                ASSERT_TRUE(std::isfinite(f.pdf) && f.pdf > 0.0f);
                ASSERT_NEAR(-sh64::dot(wo, vec3(f.wi)), c, 2e-4) << g;
            }
}

TEST(Phase, BadAnisotropyIsIsotropicOrClamped) {
    EXPECT_EQ(sh::phaseHenyeyGreensteinSetup(NAN).g, 0.0f);
    EXPECT_EQ(sh::phaseHenyeyGreensteinSetup(7.0f).g, sh::PHASE_ANISOTROPY_MAX);
    EXPECT_EQ(sh::phaseHenyeyGreensteinSetup(-std::numeric_limits<float>::infinity()).g,
              -sh::PHASE_ANISOTROPY_MAX);
}
