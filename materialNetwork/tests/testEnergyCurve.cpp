// SPDX-License-Identifier: Apache-2.0
// The interpolated energy of constant interfaces against the tables that it is measured from.
#include "materialNetwork/cpu/lobeEnergy.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace patina;

namespace {

float largest(const glm::vec3& v) {
    return std::max(std::fabs(v.x), std::max(std::fabs(v.y), std::fabs(v.z)));
}

/// Largest difference of the albedos over all angles.
float worst(const BsdfLobe& lobe) {
    EnergyCurve curve;
    curve.measure(lobe);
    EXPECT_FALSE(curve.empty());
    float error = 0.0f;
    for (int i = 0; i <= 2000; ++i) {
        const float x = float(i) / 2000.0f, z = x * x * x;
        const glm::vec3 wo(std::sqrt(1.0f - z * z), 0.0f, z);
        const EnergyCurve::Energy a = curve.at(z), b = lobeEnergy(lobe, wo);
        error = std::max(error, largest(a.r - b.r));
        error = std::max(error, largest(a.t - b.t));
        // The factors multiply the lobe, so their relative error is that of the albedo.
        error = std::max(error, largest(a.kr - b.kr) / largest(b.kr) * largest(b.r));
    }
    return error;
}

} // namespace

TEST(EnergyCurve, FollowsTheTables) {
    for (const float alpha : {0.01f, 0.02f, 0.05f, 0.25f, 0.6f, 1.0f}) {
        BsdfLobe lobe;
        for (const float f0 : {0.04f, 0.5f, 1.0f}) {
            lobe.kind = LobeKind::Schlick;
            lobe.schlick =
                sh::schlickSetup(glm::vec3(f0, 0.5f * f0, 0.1f), glm::vec3(1.0f), glm::vec3(1.0f),
                                 5.0f, glm::vec2(alpha), false, sh::SCATTER_R, false, 1);
            EXPECT_LT(worst(lobe), 1.5e-3f) << "Schlick " << f0 << " alpha " << alpha;
        }
        for (const float ior : {1.05f, 1.5f, 2.5f})
            for (const int mode : {sh::SCATTER_R, sh::SCATTER_RT}) {
                lobe.kind = LobeKind::Dielectric;
                lobe.dielectric = sh::dielectricSetup(glm::vec3(1.0f), ior, glm::vec2(alpha), false,
                                                      mode, false, 1);
                EXPECT_LT(worst(lobe), 1.5e-3f) << "ior " << ior << " alpha " << alpha;
            }
    }
}

// Methods that sum over facets are slow: what stands in for them must be as good as they are.
TEST(EnergyCurve, IsFineForSlowMethods) {
    for (const float alpha : {0.02f, 0.1f, 0.5f, 1.0f}) {
        BsdfLobe lobe;
        lobe.kind = LobeKind::Dielectric;
        lobe.dielectric =
            sh::dielectricMethods(sh::dielectricSetup(glm::vec3(1.0f), 1.5f, glm::vec2(alpha),
                                                      false, sh::SCATTER_RT, false, 1),
                                  sh::ALBEDO_QUADRATURE, sh::SAMPLING_VNDF);
        EnergyCurve curve;
        curve.measure(lobe);
        ASSERT_TRUE(curve.covers(0.5f) && curve.covers(-0.5f));
        float error = 0.0f;
        for (int i = 0; i < 60; ++i) {
            const float x = (float(i) + 0.37f) / 60.0f, z = x * x;
            const glm::vec3 wo(std::sqrt(1.0f - z * z), 0.0f, z);
            error = std::max(error, largest(curve.at(z).r - lobeEnergy(lobe, wo).r));
        }
        EXPECT_LT(error, 2e-5f) << alpha;
        lobe.kind = LobeKind::Conductor;
        lobe.conductor = sh::conductorMethods(
            sh::conductorSetup(glm::vec3(0.2f), glm::vec3(3.0f), glm::vec2(alpha), false, 1),
            sh::ALBEDO_QUADRATURE, sh::SAMPLING_VNDF, sh::FILM_GAUSSIANS);
        curve.measure(lobe);
        ASSERT_FALSE(curve.empty());
        const glm::vec3 wo(0.6f, 0.0f, 0.8f);
        EXPECT_LT(largest(curve.at(wo.z).kr - lobeEnergy(lobe, wo).kr), 2e-5f) << alpha;
    }
}

// The film's share may fill a curve up to 1 at some angles alone: beside such a step a cubic
// swings beyond its nodes, and no factor or albedo is negative.
TEST(EnergyCurve, NeverSwingsBelowZero) {
    BsdfLobe lobe;
    lobe.kind = LobeKind::Schlick;
    lobe.schlick = sh::schlickMethods(
        sh::schlickFilm(sh::schlickSetup(glm::vec3(0.5f, 0.0f, 0.0f), glm::vec3(0.0f, 1.0f, 0.5f),
                                         glm::vec3(0.727f), 0.0f, glm::vec2(0.05f), false,
                                         sh::SCATTER_RT, false, sh::COMPENSATE_SCALE),
                        295.6f, 1.64f),
        sh::ALBEDO_SAMPLES_16, sh::SAMPLING_VNDF, sh::FILM_GAUSSIANS);
    EnergyCurve curve;
    curve.measure(lobe);
    for (int i = 0; i <= 4000; ++i) {
        const EnergyCurve::Energy e = curve.at(float(i) / 4000.0f);
        for (const glm::vec3& v : {e.kr, e.kt, e.r, e.t})
            ASSERT_GE(std::min(v.x, std::min(v.y, v.z)), 0.0f) << i;
        ASSERT_LE(std::max(e.r.x, std::max(e.r.y, e.r.z)), 1.0f) << i;
    }
}

TEST(EnergyCurve, LeavesOtherLobesAlone) {
    EnergyCurve curve;
    BsdfLobe lobe;
    lobe.kind = LobeKind::Dielectric;
    const auto setup = [&](float ior, glm::vec2 alpha) {
        lobe.dielectric =
            sh::dielectricSetup(glm::vec3(1.0f), ior, alpha, false, sh::SCATTER_RT, false, 1);
        curve.measure(lobe);
        return curve.empty();
    };
    EXPECT_TRUE(setup(1.5f, glm::vec2(0.0f)));
    EXPECT_TRUE(setup(1.5f, glm::vec2(0.002f)));
    EXPECT_TRUE(setup(1.5f, glm::vec2(0.1f, 0.3f)));
    EXPECT_TRUE(setup(0.7f, glm::vec2(0.3f)));
    EXPECT_FALSE(setup(1.5f, glm::vec2(0.3f)));
}
