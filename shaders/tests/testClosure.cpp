// SPDX-License-Identifier: Apache-2.0
// How lobes become a material: frames, slabs, the choice of a lobe, media. Layers are tested with
// whole materials (materialNetwork/tests/testLayerReturn.cpp).

#include "shaders/closure.h"
#include "shaders/tests/estimate.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

using namespace patina;

namespace {

const float notANumber = std::numeric_limits<float>::quiet_NaN();
const float infinite = std::numeric_limits<float>::infinity();

void expectSame(const glm::vec3& found, const glm::vec3& expected, float error) {
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(found[c], expected[c], error) << c;
}

/// sh::bendNormal() by its words, in double.
glm::dvec3 bent(glm::dvec3 n, const glm::dvec3& v, const glm::dvec3& g) {
    const double margin = 1e-3;
    if (glm::dot(n, v) <= 0.0) n = glm::normalize(n + v * (margin - glm::dot(n, v)));
    const glm::dvec3 mirror = n * (2.0 * glm::dot(n, v)) - v;
    const double wanted = std::min(margin, glm::dot(v, g));
    const double above = glm::dot(mirror, g);
    if (above >= wanted) return n;
    return glm::normalize(v + glm::normalize(mirror + g * (wanted - above)));
}

} // namespace

TEST(ClosureAmounts, AuthoredNumbersBecomeUsable) {
    EXPECT_EQ(sh::unit(notANumber), 0.0f);
    EXPECT_EQ(sh::unit(-infinite), 0.0f);
    EXPECT_EQ(sh::unit(infinite), 1.0f);
    EXPECT_EQ(sh::unit(0.25f), 0.25f);
    const glm::vec3 wild(notANumber, -1.0f, infinite);
    EXPECT_EQ(sh::factor(wild), glm::vec3(0.0f, 0.0f, sh::COLOR_MAX));
    EXPECT_EQ(sh::emitted(wild), glm::vec3(0.0f, 0.0f, sh::EMISSION_MAX));
    EXPECT_EQ(sh::coefficient(wild), glm::vec3(0.0f, 0.0f, sh::COEFFICIENT_MAX));
}

TEST(ClosureFrame, IsOrthonormalWhateverIsAuthored) {
    test::Random random(1);
    const glm::vec3 odd[] = {glm::vec3(0.0f),     glm::vec3(notANumber),   glm::vec3(infinite),
                             glm::vec3(1e-20f),   glm::vec3(0, 0, -1e18f), glm::vec3(1, 0, 0),
                             glm::vec3(0, 0, -1), glm::vec3(-0.0f, 0, 1)};
    for (int i = 0; i < 500; ++i) {
        const glm::vec3 g = random.direction(), view = random.direction();
        glm::vec3 x, y;
        sh::completeBasis(g, x, y);
        for (const glm::vec3& normal : odd)
            for (const glm::vec3& tangent : odd)
                for (const bool flips : {false, true}) {
                    const sh::Frame f =
                        sh::shadingFrame(view, g, g, x, normal, tangent, flips, true);
                    // A tangent close to the normal keeps few digits.
                    const bool given = sh::hasDirection(glm::length(tangent));
                    const float sine =
                        glm::length(glm::cross(f.normal, given ? glm::normalize(tangent) : x));
                    const float bound = 2e-6f / (sine > 2e-6f ? std::min(sine, 0.2f) : 0.2f);
                    EXPECT_NEAR(glm::dot(f.normal, f.normal), 1.0f, 1e-5f);
                    EXPECT_NEAR(glm::dot(f.tangent, f.tangent), 1.0f, 1e-5f);
                    EXPECT_NEAR(glm::dot(f.tangent, f.normal), 0.0f, bound);
                    expectSame(glm::cross(f.normal, f.tangent), f.bitangent, 1e-6f);
                    expectSame(sh::toWorld(f, f.wo), view, bound);
                    if (flips)
                        EXPECT_GE(f.wo.z, 0.0f);
                    else
                        EXPECT_EQ(f.wo.z >= 0.0f, glm::dot(view, g) >= 0.0f);
                    // Where the normal is not bent, the view is lifted into its hemisphere.
                    const sh::Frame kept =
                        sh::shadingFrame(view, g, g, x, normal, tangent, true, false);
                    const float side = glm::dot(view, g) >= 0.0f ? 1.0f : -1.0f;
                    expectSame(kept.normal, sh::unitOr(normal, g) * side, 1e-6f);
                    EXPECT_GE(kept.wo.z, sh::BEND_MARGIN);
                    EXPECT_NEAR(glm::dot(kept.wo, kept.wo), 1.0f, 1e-5f);
                }
    }
}

// A sine of 1e-3 has 1e-4 of its value as the rounding of unit vectors; what a lobe makes of it, as
// much. Sums of nearly opposite directions left ten times that, and more.
TEST(ClosureFrame, TurnedNormalsAreExactAtGrazingAngles) {
    test::Random random(3);
    int turned = 0;
    for (int i = 0; i < 2000; ++i) {
        const float sine = std::pow(10.0f, -3.5f + 3.0f * random());
        const float phi = 6.2831853f * random();
        const glm::vec3 g(0, 0, 1);
        const glm::vec3 v = glm::normalize(glm::vec3(std::cos(phi), std::sin(phi), sine));
        const float theta = glm::radians(89.0f) * random(), turn = 6.2831853f * random();
        const glm::vec3 n(std::sin(theta) * std::cos(turn), std::sin(theta) * std::sin(turn),
                          std::cos(theta));
        const glm::dvec3 expected =
            bent(glm::normalize(glm::dvec3(n)), glm::normalize(glm::dvec3(v)), g);
        const glm::vec3 found = sh::bendNormal(n, v, g);
        turned += glm::length(expected - glm::dvec3(n)) > 1e-3;
        const double seen = glm::dot(expected, glm::normalize(glm::dvec3(v)));
        EXPECT_NEAR(glm::dot(glm::dvec3(found), glm::dvec3(v)), seen, 1e-3 * seen + 5e-7)
            << i << " sine " << sine;
    }
    EXPECT_GT(turned, 500);
}

// The series of bounces between two faces loses nothing.
TEST(ClosureSlab, WhatDoesNotPassIsReflected) {
    for (const float once : {0.0f, 0.04f, 0.5f, 0.99f, 1.0f}) {
        const sh::Slab two = sh::slabOf(glm::vec3(once), glm::vec3(1.0f), true, true);
        expectSame(two.transmittance + two.reflected * once, glm::vec3(1.0f), 1e-6f);
        const sh::Slab one = sh::slabOf(glm::vec3(once), glm::vec3(1.0f), false, true);
        expectSame(one.transmittance + one.reflected * once, glm::vec3(1.0f), 1e-6f);
        EXPECT_EQ(sh::slabOf(glm::vec3(once), glm::vec3(1.0f), true, false).reflected,
                  glm::vec3(0.0f));
    }
}

TEST(ClosureSlab, PresenceLosesNoLight) {
    glm::vec3 passes;
    const glm::vec3 through(0.1f, 0.6f, 0.3f);
    const float presence = sh::presenceOf(0.75f, through, passes);
    expectSame(passes * (1.0f - presence), 0.25f + 0.75f * through, 1e-6f);
    // Where it is met, lobes count so much more.
    EXPECT_NEAR(presence * sh::slabScale(through), 0.75f, 1e-6f);
    // Whatever a colour is, neither way makes much of little.
    test::Random random(2);
    for (int i = 0; i < 1000; ++i) {
        const auto any = [&] { return std::pow(random(), 8.0f); };
        const glm::vec3 c(any(), 1.0f - any(), random());
        sh::presenceOf(1.0f, c, passes);
        const glm::vec3 met = (1.0f - c) * sh::slabScale(c);
        EXPECT_LE(std::max({passes.x, passes.y, passes.z, met.x, met.y, met.z}), 3.001f);
    }
    EXPECT_EQ(sh::slabScale(glm::vec3(1.0f)), 0.0f);
    EXPECT_EQ(sh::presenceOf(1.0f, glm::vec3(0.0f), passes), 1.0f);
    EXPECT_EQ(passes, glm::vec3(1.0f));
}

namespace {

int drawn(const std::vector<float>& chances, float u) {
    sh::Selection s = sh::selectionNone();
    for (size_t i = 0; i < chances.size(); ++i)
        sh::selectLobe(s, int(i), chances[i], u);
    return s.lobe;
}

} // namespace

TEST(ClosureSelection, DrawsByChanceAndNeverWhatHasNone) {
    const std::vector<float> chances = {0.0f, 0.25f, 0.0f, 0.5f, 0.25f, 0.0f};
    EXPECT_EQ(drawn(chances, 0.0f), 1);
    EXPECT_EQ(drawn(chances, 0.2499f), 1);
    EXPECT_EQ(drawn(chances, 0.25f), 3);
    EXPECT_EQ(drawn(chances, 0.75f), 4);
    EXPECT_EQ(drawn(chances, std::nextafter(1.0f, 0.0f)), 4);
    // Rounding has left the chances below 1.
    EXPECT_EQ(drawn({0.3f, 0.3f, 0.0f}, 0.9f), 1);
    EXPECT_EQ(drawn({0.0f, 0.0f}, 0.5f), -1);
    EXPECT_EQ(drawn({}, 0.5f), -1);
}

TEST(ClosureMedium, KeepsFourPhaseFunctionsAndAllScattering) {
    sh::Medium m = sh::mediumNone();
    const glm::vec3 s(0.5f, 1.0f, 2.0f);
    const float anisotropies[] = {0.0f, 0.5f, -0.5f, 0.5f, 0.9f, 0.1f, notANumber};
    for (const float g : anisotropies)
        sh::addScattering(m, s, g);
    EXPECT_EQ(m.phaseCount, 4);
    expectSame(sh::mediumScattering(m), 7.0f * s, 1e-5f);
    expectSame(m.phases[0].scattering, 2.0f * s, 0.0f); // NaN counts as 0
    expectSame(m.phases[1].scattering, 2.0f * s, 0.0f);
    EXPECT_EQ(m.phases[2].anisotropy, -0.5f);
    EXPECT_NEAR(m.phases[3].anisotropy, 0.5f, 1e-6f); // of 0.9 and 0.1
    sh::addScattering(m, glm::vec3(0.0f), 0.7f);
    EXPECT_EQ(m.phaseCount, 4);
}

// Means over directions, with a standard error that the samples themselves tell.
TEST(ClosureMedium, PhaseMixtureIsADensityAndItsSamplesFollowIt) {
    sh::Medium m = sh::mediumNone();
    sh::addScattering(m, glm::vec3(1.0f, 0.2f, 0.0f), 0.4f);
    sh::addScattering(m, glm::vec3(0.5f, 0.8f, 0.0f), -0.3f);
    const glm::vec3 throughput(0.5f, 0.3f, 0.2f);
    const sh::PhaseMixture p = sh::phaseMixture(m, throughput);
    EXPECT_NEAR(p.parts[0].chance + p.parts[1].chance, 1.0f, 1e-6f);
    test::Random random(7);
    const glm::vec3 wo = random.direction();
    const int count = 20000;
    test::Mean value, density, mean, expected, weight;
    for (int i = 0; i < count; ++i) {
        const glm::vec3 wi = random.direction();
        const sh::LobeEval e = sh::phaseMixtureEval(p, wo, wi);
        value.add(4.0 * test::pi * double(e.value.x));
        density.add(4.0 * test::pi * double(e.pdf));
        expected.add(4.0 * test::pi * double(e.pdf * glm::dot(wo, wi)));
        const sh::LobeSample s = sh::phaseMixtureSample(p, wo, random.cube(), random());
        mean.add(double(glm::dot(wo, s.wi)));
        weight.add(double(s.weight.y));
        const sh::LobeEval there = sh::phaseMixtureEval(p, wo, s.wi);
        EXPECT_EQ(there.pdf, s.pdf);
        EXPECT_EQ(s.weight.z, 0.0f); // nothing scatters blue light
    }
    for (const test::Mean* one : {&value, &density, &weight})
        EXPECT_TRUE(agree(*one, 1.0));
    EXPECT_TRUE(agree(mean, expected));
}
