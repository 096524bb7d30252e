// SPDX-License-Identifier: Apache-2.0
// Thin film against the exact spectral Airy formula, integrated over the channels' sensitivities,
// and the identities that hold whatever the fit.

#include <complex>
#include <cstdio>

#include <gtest/gtest.h>

#include "shaders/tests/lobeCase.h"

using namespace patina;
using namespace patina::test;

namespace {

using Complex = std::complex<double>;

// Colour matching functions: multi-lobe fits of Wyman, Sloan and Shirley 2013.
double lobe(double x, double center, double below, double above) {
    const double t = (x - center) / (x < center ? below : above);
    return std::exp(-0.5 * t * t);
}

vec3 sensitivity(double nm) {
    const double x = 1.056 * lobe(nm, 599.8, 37.9, 31.0) + 0.362 * lobe(nm, 442.0, 16.0, 26.7) -
                     0.065 * lobe(nm, 501.1, 20.4, 26.2);
    const double y = 0.821 * lobe(nm, 568.8, 46.9, 40.5) + 0.286 * lobe(nm, 530.9, 16.3, 31.1);
    const double z = 1.217 * lobe(nm, 437.0, 11.8, 36.0) + 0.681 * lobe(nm, 459.0, 26.0, 13.8);
    return vec3(3.2404542 * x - 1.5371385 * y - 0.4985314 * z,
                -0.9692660 * x + 1.8760108 * y + 0.0415560 * z,
                0.0556434 * x - 0.2040259 * y + 1.0572252 * z);
}

// Reflectance of one wavelength by the characteristic matrix of one layer (Born and Wolf 1999,
// section 1.6), mean of both polarisations.
double airy(double c, double thickness, double film, Complex base, double nm) {
    const double s = std::sqrt(1.0 - c * c);
    const Complex c2 = std::sqrt(Complex(1.0 - s * s / (film * film)));
    const Complex c3 = std::sqrt(1.0 - s * s / (base * base));
    const Complex beta = 2.0 * M_PI * film * thickness * c2 / nm;
    double sum = 0.0;
    for (bool p : {false, true}) {
        // Admittances for s; for p the impedances stand in their place.
        const Complex q2 = p ? c2 / film : film * c2;
        const Complex q3 = p ? c3 / base : base * c3;
        const Complex i(0.0, 1.0);
        const Complex m11 = std::cos(beta), m12 = -i * std::sin(beta) / q2,
                      m21 = -i * q2 * std::sin(beta);
        const Complex above = (m11 + m12 * q3) * c, below = m21 + m11 * q3;
        sum += 0.5 * std::norm((above - below) / (above + below));
    }
    return sum;
}

vec3 exact(double c, double thickness, double film, vec3 n, vec3 k) {
    vec3 sum(0.0), all(0.0);
    for (double nm = 360.0; nm < 831.0; nm += 0.5) {
        const vec3 s = sensitivity(nm);
        all += s;
        for (int i = 0; i < 3; ++i)
            sum[i] += s[i] * airy(c, thickness, film, Complex(n[i], k[i]), nm);
    }
    return vec3(sum.x / all.x, sum.y / all.y, sum.z / all.z);
}

struct Base {
    const char* name;
    vec3 n, k;
    double budget;
};

// Budgets are the measured errors; the largest ones stand at 87 degrees, where the sum over orders
// is slow to converge.
const Base bases[] = {{"glass", vec3(1.5), vec3(0.0), 1e-2},
                      {"matched", vec3(1.0), vec3(0.0), 0.11},
                      {"gold", goldIor, goldExtinction, 5e-2},
                      {"silver", vec3(0.15), vec3(3.6, 3.0, 2.4), 5e-2}};

vec3 coated(const Base& b, double thickness, double film, double c) {
    return sh64::filmReflectance(sh64::makeFilm(thickness, film), c, b.n, b.k);
}

vec3 bare(const Base& b, double c) {
    return sh64::fresnelConductor(c, b.n, b.k);
}

} // namespace

TEST(Film, FollowsTheSpectralAiryFormula) {
    for (const Base& b : bases) {
        Error error;
        for (double film : {1.2, 1.33, 1.5, 2.0})
            for (double thickness : {10.0, 100.0, 250.0, 400.0, 600.0, 1000.0, 2000.0})
                for (double c : {1.0, 0.8, 0.5, 0.2, 0.05}) {
                    const double e = largest(coated(b, thickness, film, c) -
                                             exact(c, thickness, film, b.n, b.k));
                    error.add(e);
                    EXPECT_LT(e, b.budget)
                        << b.name << " film " << film << " nm " << thickness << " c " << c;
                }
        std::printf("film on %s: largest error %.2g, rms %.2g\n", b.name, error.largest,
                    error.rms());
    }
}

// A film of the ior outside is not there, whatever its thickness, on any base.
TEST(Film, MatchedFilmIsNone) {
    for (const Base& b : bases)
        for (double thickness : {0.2, 100.0, 700.0})
            for (double c : {1.0, 0.6, 0.1})
                EXPECT_LT(largest(coated(b, thickness, 1.0, c) - bare(b, c)), 1e-6)
                    << b.name << thickness << " " << c;
    const vec3 wo = direction(0.6, 0.3);
    const auto s = sh64::schlickSetup(vec3(1.0, 0.71, 0.29), vec3(1.0), vec3(1.0), 5.0, vec2(0.3),
                                      false, 1, false, 0);
    const auto f = sh64::schlickFilm(s, 300.0, 1.0);
    EXPECT_LT(largest(sh64::schlickEval(s, wo, direction(0.5, 3.0)).value -
                      sh64::schlickEval(f, wo, direction(0.5, 3.0)).value),
              1e-6);
}

TEST(Film, FilmOfTheBaseIsTheBareBase) {
    for (double thickness : {50.0, 300.0, 2000.0})
        for (double c : {1.0, 0.5, 0.1})
            EXPECT_NEAR(coated(bases[0], thickness, 1.5, c).x, sh64::fresnelDielectric(c, 1.5),
                        1e-6);
}

TEST(Film, ThinFilmsFadeOut) {
    for (const Base& b : bases)
        for (double film : {1.33, 1.5, 2.0})
            for (double c : {1.0, 0.5, 0.2})
                EXPECT_LT(largest(coated(b, 0.11, film, c) - bare(b, c)), 3e-2)
                    << b.name << film << " " << c;
}

// The limit of many bounces without interference.
TEST(Film, ThickFilmsAddUpWithoutInterference) {
    for (double c : {1.0, 0.6, 0.3}) {
        const double s2 = 1.0 - c * c, ct = std::sqrt(1.0 - s2 / (1.33 * 1.33));
        double mean = 0.0;
        for (bool p : {false, true}) {
            const auto power = [&](double n1, double c1, double n2, double c2) {
                const double r = p ? (n2 * c1 - n1 * c2) / (n2 * c1 + n1 * c2)
                                   : (n1 * c1 - n2 * c2) / (n1 * c1 + n2 * c2);
                return r * r;
            };
            const double a = power(1.0, c, 1.33, ct);
            const double b = power(1.33, ct, 1.8, std::sqrt(1.0 - s2 / (1.8 * 1.8)));
            mean += 0.5 * (a + (1.0 - a) * (1.0 - a) * b / (1.0 - a * b));
        }
        const vec3 thick =
            sh64::filmReflectance(sh64::makeFilm(60000.0, 1.33), c, vec3(1.8), vec3(0.0));
        EXPECT_LT(largest(thick - vec3(mean)), 1e-6) << c;
    }
}

TEST(Film, SmoothGlassUnderAFilmLosesNothing) {
    for (double ior : {1.5, 1.0, 0.7})
        for (double z : {1.0, 0.6, 0.1, -0.1, -0.6, -1.0}) {
            const auto l = sh64::filmDielectricSetup(vec3(1.0), ior, vec2(0.0), 400.0, 1.33, false,
                                                     sh::SCATTER_RT, false, 1);
            EXPECT_NEAR(sh64::schlickAlbedo(l, direction(z, 0.0)).y, 1.0, 1e-6) << ior << z;
        }
}

// Smooth lobes are mirrors: what they sample is the reflectance itself, and of lossless interfaces
// the rest is transmitted, from both sides, by whichever mode. Against the spectrum, with the
// largest budget of the formula; Schlick's curve has the base's error on top.
TEST(Film, ABaseThatReflectsAllDoesSoUnderAnyFilm) {
    const auto white =
        sh64::schlickSetup(vec3(1.0), vec3(1.0), vec3(1.0), 5.0, vec2(0.0), false, 0, false, 0);
    for (double ior : {1.2, 1.8, 2.5})
        for (double thickness : {100.0, 300.0, 800.0})
            for (double z : {1.0, 0.5, 0.01})
                EXPECT_EQ(sh64::schlickOutside(sh64::schlickFilm(white, thickness, ior), z),
                          vec3(1.0))
                    << ior << " " << thickness << " " << z;
}

TEST(Film, EveryLobeFollowsTheSpectrum) {
    const double ior = 1.5, film = 1.33, budget = 1e-2;
    const vec3 u(0.3, 0.6, 0.999999);
    for (double thickness : {150.0, 400.0, 700.0})
        for (double z : {1.0, 0.7, 0.3}) {
            const vec3 wo = direction(z, 0.4);
            const vec3 coated = exact(z, thickness, film, vec3(ior), vec3(0.0));
            for (int mode : {sh::SCATTER_R, sh::SCATTER_T, sh::SCATTER_RT}) {
                const auto l = sh64::filmDielectricSetup(vec3(1.0), ior, vec2(0.0), thickness, film,
                                                         false, mode, false, 1);
                // The far side sees the same interface at the refracted angle.
                const double zt = std::sqrt(1.0 - (1.0 - z * z) / (ior * ior));
                for (const vec3& from : {wo, direction(-zt, 0.4)}) {
                    const vec3 all = sh64::schlickAlbedo(l, from);
                    vec3 expected = mode == sh::SCATTER_R ? coated : vec3(1.0) - coated;
                    if (mode == sh::SCATTER_RT) expected = vec3(1.0);
                    EXPECT_LT(largest(all - expected), budget) << mode << " " << from.z;
                    const auto s = sh64::schlickSample(l, from, u);
                    ASSERT_NE(s.event, 0);
                    if (mode == sh::SCATTER_RT) expected = (vec3(1.0) - coated) / s.pdf;
                    EXPECT_EQ((s.event & sh::LOBE_TRANSMIT) != 0, mode != sh::SCATTER_R);
                    EXPECT_LT(largest(s.weight - expected), 2.0 * budget) << mode << " " << from.z;
                }
            }
            const vec3 &n = goldIor, &k = goldExtinction;
            const auto metal = sh64::conductorFilm(sh64::conductorSetup(n, k, vec2(0.0), false, 1),
                                                   thickness, film);
            EXPECT_LT(largest(sh64::conductorAlbedo(metal, wo) - exact(z, thickness, film, n, k)),
                      5e-2)
                << z;
            const auto curve =
                sh64::schlickFilm(sh64::schlickSetup(vec3(0.04), vec3(1.0), vec3(1.0), 5.0,
                                                     vec2(0.0), false, sh::SCATTER_RT, false, 1),
                                  thickness, film);
            // How far the curve is off, by the factor on what is not reflected.
            const double bare = sh64::fresnelDielectric(z, ior);
            const double off = std::fabs(bare - 0.04 - 0.96 * std::pow(1.0 - z, 5.0)) *
                               largest(vec3(1.0) - coated) / (1.0 - bare);
            EXPECT_LT(largest(sh64::schlickReflectance(curve, z, curve.ior) - coated), budget + off)
                << z;
            EXPECT_NEAR(sh64::schlickAlbedo(curve, wo).x, 1.0, 1e-6);
        }
}
