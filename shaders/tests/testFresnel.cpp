// SPDX-License-Identifier: Apache-2.0
// Identities and textbook values of the reflectance curves.

#include <cmath>

#include <gtest/gtest.h>

#include "shaders/oracle.h"

using namespace patina;
using sh64::vec3;

TEST(Fresnel, NormalIncidence) {
    EXPECT_NEAR(sh64::fresnelDielectric(1.0, 1.5), 0.04, 1e-15);
    EXPECT_NEAR(sh64::fresnelDielectric(1.0, 1.0 / 1.5), 0.04, 1e-15);
    EXPECT_NEAR(sh::fresnelDielectric(1.0f, 1.5f), 0.04f, 1e-8f);
    // Gold at 580 nm or so: ((n - 1)^2 + k^2) / ((n + 1)^2 + k^2).
    const double n = 0.183, k = 3.424;
    EXPECT_NEAR(sh64::fresnelConductorChannel(1.0, n, k),
                ((n - 1) * (n - 1) + k * k) / ((n + 1) * (n + 1) + k * k), 1e-14);
}

TEST(Fresnel, BrewsterAngleHasOnlyTheOtherPolarisation) {
    // tan(theta) = n; there R = Rs / 2 with Rs = ((n^2 - 1) / (n^2 + 1))^2.
    const double n = 1.5, rs = (n * n - 1.0) / (n * n + 1.0);
    EXPECT_NEAR(sh64::fresnelDielectric(1.0 / std::sqrt(1.0 + n * n), n), 0.5 * rs * rs, 1e-14);
}

TEST(Fresnel, MatchedIorReflectsNothing) {
    for (double c : {0.0, 1e-6, 0.3, 1.0})
        EXPECT_EQ(sh64::fresnelDielectric(c, 1.0), 0.0);
    // Relative precision next to it: F0 = ((n - 1) / (n + 1))^2.
    const float n = 1.001f;
    const double f0 = std::pow((double(n) - 1.0) / (double(n) + 1.0), 2.0);
    EXPECT_NEAR(sh::fresnelDielectric(1.0f, n) / f0, 1.0, 1e-5);
}

TEST(Fresnel, TotalReflectionBeyondTheCriticalAngle) {
    const double eta = 1.0 / 1.5, critical = std::sqrt(1.0 - eta * eta);
    EXPECT_EQ(sh64::fresnelDielectric(critical * 0.999, eta), 1.0);
    EXPECT_LT(sh64::fresnelDielectric(critical * 1.001, eta), 1.0);
    EXPECT_EQ(sh64::fresnelDielectric(0.0, eta), 1.0);
    EXPECT_NEAR(sh64::fresnelDielectric(0.0, 1.5), 1.0, 1e-14);
}

TEST(Fresnel, BothSidesReflectAlike) {
    for (double n : {1.05, 1.5, 2.4})
        for (double c = 0.01; c <= 1.0; c += 0.07)
            EXPECT_NEAR(sh64::fresnelDielectric(c, n),
                        sh64::fresnelDielectric(sh64::cosRefracted(c, n), 1.0 / n), 1e-12);
}

TEST(Fresnel, ConductorWithoutExtinctionIsDielectric) {
    for (double n : {0.5, 0.75, 1.0, 1.5, 3.0})
        for (double c = 0.0; c <= 1.0; c += 0.05)
            EXPECT_NEAR(sh64::fresnelConductorChannel(c, n, 0.0), sh64::fresnelDielectric(c, n),
                        1e-7)
                << n << " " << c;
}

TEST(Fresnel, SchlickIsSchlick) {
    const auto s = sh64::schlickFresnel(vec3(0.04), vec3(1.0), vec3(1.0), 5.0);
    for (double c : {0.0, 0.2, 0.7, 1.0})
        EXPECT_NEAR(sh64::fresnelSchlick(c, s).x, 0.04 + 0.96 * std::pow(1.0 - c, 5.0), 1e-7);
}

TEST(Fresnel, Color82ScalesTheReflectanceAt82Degrees) {
    const auto plain = sh64::schlickFresnel(vec3(0.5), vec3(1.0), vec3(0.9), 4.0);
    const auto tinted = sh64::schlickFresnel(vec3(0.5), vec3(0.6), vec3(0.9), 4.0);
    const double c = 1.0 / 7.0;
    EXPECT_NEAR(sh64::fresnelSchlick(c, tinted).x, 0.6 * sh64::fresnelSchlick(c, plain).x, 1e-6);
    EXPECT_NEAR(sh64::fresnelSchlick(0.0, tinted).x, 0.9, 1e-7);
    EXPECT_NEAR(sh64::fresnelSchlick(1.0, tinted).x, 0.5, 1e-7);
}

TEST(Fresnel, AveragesMatchTheirIntegrals) {
    const auto average = [](auto&& f) {
        double sum = 0.0;
        for (int i = 0; i < 20000; ++i)
            sum += f(std::sqrt((i + 0.5) / 20000.0)) / 20000.0;
        return sum;
    };
    const auto s = sh64::schlickFresnel(vec3(0.3), vec3(0.8), vec3(0.9), 3.0);
    EXPECT_NEAR(sh64::fresnelSchlickAverage(s).x,
                average([&](double c) { return sh64::fresnelSchlick(c, s).x; }), 1e-5);
    for (double n : {0.4, 0.7, 1.05, 1.5, 2.5})
        EXPECT_NEAR(sh64::fresnelDielectricAverage(n),
                    average([&](double c) { return sh64::fresnelDielectric(c, n); }), 1e-2)
            << n;
    for (double k : {0.0, 1.0, 4.0})
        EXPECT_NEAR(sh64::conductorAverage(vec3(1.4), vec3(k)).x,
                    average([&](double c) { return sh64::fresnelConductorChannel(c, 1.4, k); }),
                    1.2e-2)
            << k;
}

TEST(Fresnel, AcosMeetsItsBound) {
    for (int i = 0; i <= 1000; ++i)
        EXPECT_NEAR(sh64::acosUnit(i / 1000.0), std::acos(i / 1000.0), 1e-7);
}

// There what passes is small, and the tables of albedos are about it.
TEST(Fresnel, SinglePrecisionHoldsAroundTheCriticalAngle) {
    for (double ior : {1.5, 4.0, 15.0, 20.0})
        for (double share : {1e-3, 0.03, 0.2, 0.7}) {
            const float eta = float(1.0 / ior), g = float(share / ior);
            const double c = std::sqrt((1.0 - eta) * (1.0 + double(eta)) + double(g) * g);
            EXPECT_NEAR(sh::fresnelFromCosines(float(c), g, eta),
                        sh64::fresnelFromCosines(c, g, eta), 2e-6)
                << ior << " " << share;
        }
}
