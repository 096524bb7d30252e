// SPDX-License-Identifier: Apache-2.0
// eval, sample and albedo of every lobe say the same thing, in float and in double.

#include <gtest/gtest.h>

#include "shaders/tests/lobeCase.h"

using namespace patina;
using namespace patina::test;

namespace {

constexpr int sampleCount = 400;

// Rounding of a float direction, seen through a lobe of width alpha.
double floatTolerance(const LobeCase& c, double wz) {
    // Beckmann's tail falls exponentially: the error of the slope grows with its distance.
    const double steep = c.name.find("beckmann") == 0 ? 4.0 : 1.0;
    return steep * (1e-4 + 2e-6 / c.alpha + 2e-7 / (c.alpha * std::max(std::fabs(wz), 1e-3)));
}

} // namespace

TEST(LobeConsistency, SampleWeightIsValueOverPdf) {
    for (int compensate : {0, 1})
        for (const LobeCase& c : lobeCases(compensate))
            for (vec3 wo : outgoing(c))
                expectSamplesAreOfEval(c, wo, sampleCount, 1e-9 / c.alpha);
}

TEST(LobeConsistency, FloatSamplesHaveThePdfOfFloatEval) {
    for (const LobeCase& c : lobeCases(1))
        for (vec3 wo : outgoing(c))
            for (int i = 0; i < sampleCount; ++i) {
                const sh64::LobeSample s = c.f32.sample(wo, quasiRandom(i));
                if (s.event == 0 || (s.event & sh::LOBE_DELTA) != 0) continue;
                if (std::fabs(s.wi.z) < 1e-4) continue; // its cosine has no digits left
                const sh64::LobeEval e = c.f32.eval(wo, s.wi);
                const double tol = floatTolerance(c, s.wi.z);
                // Next to the critical angle 1 - F keeps half of the digits.
                ASSERT_LT(std::fabs(e.pdf - s.pdf), tol * s.pdf + 1e-4)
                    << c.name << " wo.z " << wo.z;
                const double bound = 2.0 * tol * largest(s.weight) + 2e-3;
                ASSERT_LT(largest(e.value / e.pdf - s.weight), bound)
                    << c.name << " wo.z " << wo.z << " wi.z " << s.wi.z;
            }
}

TEST(LobeConsistency, FloatEqualsDouble) {
    for (const LobeCase& c : lobeCases(1))
        for (vec3 wo : outgoing(c)) {
            EXPECT_LT(largest(c.f32.albedo(wo) - c.f64.albedo(wo)), 1e-4) << c.name << wo.z;
            for (int i = 0; i < sampleCount; ++i) {
                // Half of the directions from the lobe, half from the sphere.
                const vec3 u = quasiRandom(i);
                vec3 wi = sphereDirection(u);
                if (i % 2 == 0) {
                    const sh64::LobeSample s = c.f64.sample(wo, u);
                    if (s.event == 0) continue;
                    wi = s.wi;
                }
                if (std::fabs(wi.z) < 1e-4) continue;
                // Both get the rounded directions.
                const vec3 o = vec3(sh::vec3(wo));
                const vec3 w = vec3(sh::vec3(wi));
                const sh64::LobeEval a = c.f32.eval(o, w);
                const sh64::LobeEval b = c.f64.eval(o, w);
                const double tol = floatTolerance(c, wi.z);
                // Refraction next to facets that turn away: o.h of vectors of length 1 and 1 + ior
                // cancels, after six roundings. Sums that are fused round less often.
                const double cancelled = wi.z * wo.z < 0.0 ? 6.0 * 6e-8 * (1.0 + 1.5) : 0.0;
                ASSERT_LT(std::fabs(a.pdf - b.pdf), tol * (b.pdf + 1e-3) + cancelled)
                    << c.name << wo.z;
                ASSERT_LT(largest(a.value - b.value),
                          2.0 * tol * (largest(b.value) + 1e-3) + cancelled)
                    << c.name << wo.z;
            }
        }
}

TEST(LobeConsistency, PdfIsPositiveWhereTheLobeIs) {
    for (const LobeCase& c : lobeCases(1))
        for (vec3 wo : outgoing(c))
            for (int i = 0; i < sampleCount; ++i) {
                const vec3 wi = sphereDirection(quasiRandom(i));
                const sh64::LobeEval e = c.f32.eval(wo, wi);
                ASSERT_TRUE(finiteAndPositive(e.value)) << c.name;
                ASSERT_TRUE(e.pdf >= 0.0 && std::isfinite(e.pdf)) << c.name;
                if (largest(e.value) > 0.0) {
                    ASSERT_GT(e.pdf, 0.0) << c.name << " wo.z " << wo.z << " wi.z " << wi.z;
                }
            }
}

TEST(LobeConsistency, OneSidedLobesAreBlackFromBelow) {
    for (const LobeCase& c : lobeCases(1)) {
        if (c.twoSided) continue;
        const vec3 up = direction(0.6, 1.0);
        const vec3 down = direction(-0.6, 2.0);
        EXPECT_EQ(c.f32.eval(down, up).pdf, 0.0) << c.name;
        EXPECT_EQ(c.f32.eval(up, down).pdf, 0.0) << c.name;
        EXPECT_EQ(largest(c.f32.eval(up, down).value), 0.0) << c.name;
        EXPECT_EQ(c.f32.sample(down, vec3(0.3, 0.4, 0.5)).event, 0) << c.name;
        EXPECT_EQ(largest(c.f32.albedo(down)), 0.0) << c.name;
    }
}
