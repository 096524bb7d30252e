// SPDX-License-Identifier: Apache-2.0
// Extremes of every input: nothing is ever NaN, infinite or negative, mirrors are exact, the switch
// to a mirror is not seen, and the identities between lobes hold.

#include <limits>
#include <tuple>

#include <gtest/gtest.h>

#include "shaders/tests/lobeCase.h"

using namespace patina;
using namespace patina::test;

namespace {

const float quietNan = std::numeric_limits<float>::quiet_NaN();
const float infinity = std::numeric_limits<float>::infinity();

const float roughnesses[] = {0.0f, 1e-8f, 1e-4f, 9.99e-4f, 1e-3f,   1e-2f,
                             0.3f, 1.0f,  7.0f,  -1.0f,    quietNan};
const float colors[] = {0.0f, 1.0f, 2.0f, -1.0f, infinity, quietNan};
const float iors[] = {1.5f,  1.0f, 1.000001f, 0.999999f, 1.001f, 0.999f,   0.6f,
                      10.0f, 0.0f, -2.0f,     1e9f,      1e-9f,  quietNan, infinity};

/// Roughnesses along and across.
const std::vector<vec2> alphas = [] {
    std::vector<vec2> all;
    for (float ax : roughnesses)
        for (float ay : {ax, 0.0f, 0.5f})
            all.push_back(vec2(ax, ay));
    return all;
}();

/// Inputs, for messages.
template <class... T> std::string values(T... inputs) {
    return ::testing::PrintToString(std::make_tuple(inputs...));
}

std::vector<vec3> directions() {
    std::vector<vec3> all; // both azimuths of a height after each other
    for (double z : {1.0, 0.7, 1e-1, 1e-3, 1e-6, 1e-8, 0.0, -1e-8, -1e-4, -0.3, -0.75, -1.0})
        for (double phi : {0.0, 2.0})
            all.push_back(direction(z, phi));
    return all;
}

std::vector<vec3> randoms() {
    const double last = 1.0 - 0x1p-24;
    std::vector<vec3> all;
    for (double x : {0.0, 0.37, last})
        for (double y : {0.0, 0.61, last})
            for (double z : {0.0, 0.5, last})
                all.push_back(vec3(x, y, z));
    return all;
}

// Everything a lobe can be asked, from every direction. Returns false at the first bad number. What
// has no direction along the surface is seen from one side only.
::testing::AssertionResult sane(const LobeCase& c, bool isotropic = false) {
    const BoundLobe& lobe = c.f32;
    static const std::vector<vec3> all = directions();
    static const std::vector<vec3> us = randoms();
    for (size_t i = 0; i < all.size(); i += isotropic ? 2 : 1) {
        const vec3 wo = all[i];
        const auto at = [&](const char* what) {
            return ::testing::AssertionFailure() << what << " at wo.z " << wo.z;
        };
        const vec3 albedo = lobe.albedo(wo);
        if (!finiteAndPositive(albedo)) return at("albedo") << " " << albedo.x;
        for (vec3 wi : all) {
            const sh64::LobeEval e = lobe.eval(wo, wi);
            if (!finiteAndPositive(e.value)) return at("value") << " wi.z " << wi.z;
            if (!(e.pdf >= 0.0) || std::isinf(e.pdf)) return at("pdf") << " wi.z " << wi.z;
        }
        const sh64::LobeEval opposite = lobe.eval(wo, -wo);
        if (!finiteAndPositive(opposite.value) || !std::isfinite(opposite.pdf))
            return at("wi = -wo");
        for (vec3 u : us) {
            const sh64::LobeSample s = lobe.sample(wo, u);
            if (!finiteAndPositive(s.weight)) return at("weight");
            if (!(s.pdf >= 0.0) || std::isinf(s.pdf)) return at("sample pdf");
            if (s.event != 0 && !(s.pdf > 0.0)) return at("sample of pdf 0");
            const double length = sh64::length(s.wi);
            if (!(std::fabs(length - 1.0) < 1e-4)) return at("direction") << " length " << length;
        }
    }
    return ::testing::AssertionSuccess();
}

} // namespace

TEST(LobeDegenerate, DielectricIsSane) {
    for (vec2 a : alphas)
        for (float ior : iors)
            for (int mode : {1, 2, 3})
                for (int variant : {0, 1, 2})
                    ASSERT_TRUE(
                        sane(PATINA_LOBE_CASE("d", dielectric, vec3(1.0, quietNan, infinity), ior,
                                              vec2(a), variant == 0, mode, variant == 1,
                                              int(variant != 2)),
                             a.x == a.y))
                        << values(a.x, a.y, ior, mode, variant);
}

TEST(LobeDegenerate, SchlickIsSane) {
    for (float ax : roughnesses)
        for (float ay : {ax, 0.0f})
            for (float f0 : {0.0f, 1e-7f, 0.04f, 1.0f, 3.0f, quietNan})
                for (float f90 : {0.0f, 1.0f})
                    for (float exponent : {0.0f, 0.5f, 5.0f, 200.0f, -1.0f, quietNan})
                        for (int mode : {1, 2, 3})
                            ASSERT_TRUE(sane(PATINA_LOBE_CASE("s", schlick, vec3(f0, 0.0, 1.0),
                                                              vec3(1.0, 0.0, f0), vec3(f90),
                                                              exponent, vec2(ax, ay), false, mode,
                                                              exponent == 5.0f, 1),
                                             ax == ay))
                                << values(ax, ay, f0, f90, exponent, mode);
}

TEST(LobeDegenerate, ConductorIsSane) {
    for (vec2 a : alphas)
        for (float n : {0.0f, 1e-6f, 1.0f, 1.5f, 50.0f, 1e9f, -1.0f, quietNan})
            for (float k : {0.0f, 1e-8f, 3.0f, infinity, -1.0f})
                ASSERT_TRUE(sane(PATINA_LOBE_CASE("c", conductor, vec3(n, 1.0, 0.2),
                                                  vec3(k, 0.0, 3.0), vec2(a), k == 3.0f, 1)))
                    << values(a.x, a.y, n, k);
}

TEST(LobeDegenerate, BeckmannIsSane) {
    const int ndf = sh::NDF_BECKMANN;
    for (vec2 a : alphas) {
        ASSERT_TRUE(
            sane(PATINA_LOBE_CASE_WITH("c", conductor, conductor, l.ndf = ndf, vec3(0.2, 1.0, 0.0),
                                       vec3(3.0, 0.0, 1.0), vec2(a), false, 1)))
            << values(a.x, a.y);
        for (float ior : iors)
            for (int mode : {1, 2, 3})
                ASSERT_TRUE(sane(PATINA_LOBE_CASE_WITH("d", dielectric, dielectric, l.ndf = ndf,
                                                       vec3(1.0, quietNan, infinity), ior, vec2(a),
                                                       false, mode, mode == 2, 1)))
                    << values(a.x, a.y, ior, mode);
        for (float f0 : {0.0f, 0.04f, 1.0f, quietNan})
            ASSERT_TRUE(sane(PATINA_LOBE_CASE_WITH("s", schlick, schlick, l.ndf = ndf,
                                                   vec3(f0, 0.0, 1.0), vec3(1.0, 0.0, f0),
                                                   vec3(1.0), 5.0, vec2(a), false, 3, false, 1)))
                << values(a.x, a.y, f0);
    }
}

TEST(LobeDegenerate, DiffuseIsSane) {
    for (float r : {0.0f, 1e-8f, 1.0f, 5.0f, -1.0f, quietNan})
        for (float color : colors)
            for (const LobeCase& l :
                 {PATINA_LOBE_CASE("eon", orenNayar, vec3(color, 1.0, 0.5), r, true),
                  PATINA_LOBE_CASE("orenNayar", orenNayar, vec3(color, 1.0, 0.5), r, false),
                  PATINA_LOBE_CASE("burley", burley, vec3(color, 1.0, 0.5), r),
                  PATINA_LOBE_CASE("translucent", translucent, vec3(color, 1.0, 0.5))})
                ASSERT_TRUE(sane(l)) << l.name << values(r, color);
}

TEST(LobeDegenerate, SheenIsSane) {
    for (float r : {0.0f, 1e-8f, 0.02f, 0.3f, 1.0f, 5.0f, -1.0f, quietNan})
        for (float color : colors)
            for (int mode : {0, 1})
                ASSERT_TRUE(sane(PATINA_LOBE_CASE("s", sheen, vec3(color, 1.0, 0.5), r, mode)))
                    << values(mode, r, color);
}

TEST(LobeDegenerate, ClassicsAreSane) {
    for (float color : colors) {
        for (float n : {0.0f, 1e-8f, 1.0f, 1e3f, 1e9f, -1.0f, infinity, quietNan})
            for (const LobeCase& l :
                 {PATINA_LOBE_CASE("phong", phong, vec3(color, 1.0, 0.5), n),
                  PATINA_LOBE_CASE("blinn", blinnPhong, vec3(color, 1.0, 0.5), n)})
                ASSERT_TRUE(sane(l)) << l.name << values(n, color);
        for (vec2 a : alphas)
            for (int choice : {0, 1})
                for (const LobeCase& l :
                     {PATINA_LOBE_CASE("ward", ward, vec3(color, 1.0, 0.5), vec2(a), choice),
                      PATINA_LOBE_CASE("cook", cookTorrance, vec3(color, 1.0, 0.5),
                                       vec3(a.y, 1.0, 0.2), vec3(color, 0.0, 3.0), a.x, choice)})
                    ASSERT_TRUE(sane(l)) << l.name << values(a.x, a.y, color, choice);
    }
}

TEST(LobeDegenerate, ClassicsOfPowerZeroAreLambert) {
    const vec3 wo = direction(0.3, 0.2), wi = direction(0.4, 2.0);
    const auto blinn = sh64::blinnPhongSetup(vec3(0.8), 0.0);
    EXPECT_NEAR(sh64::blinnPhongEval(blinn, wo, wi).value.x, 0.8 * 0.4 / sh64::PI, 1e-12);
    const auto phong = sh64::phongSetup(vec3(0.8), 0.0);
    EXPECT_NEAR(sh64::phongEval(phong, wo, wi).value.x, 0.8 * 0.4 / sh64::PI, 1e-12);
}

TEST(LobeDegenerate, FilmsAreSane) {
    for (float thickness : {0.0f, 1e-3f, 0.1f, 300.0f, 2000.0f, 1e9f, -1.0f, quietNan, infinity})
        for (float film : {1.0f, 1.0001f, 1.5f, 2.5f, 0.0f, quietNan, infinity})
            for (float ior : {1.5f, 1.0f, 1.0001f, 1.0f / 1.5f, 0.0f, infinity})
                for (float alpha : {0.0f, 0.3f, 1.0f})
                    for (int mode : {1, 2, 3})
                        ASSERT_TRUE(
                            sane(PATINA_LOBE_CASE_AS("f", filmDielectric, schlick,
                                                     vec3(1.0, 0.5, 0.1), ior, vec2(alpha),
                                                     thickness, film, false, mode, mode == 2, 1),
                                 true))
                            << values(thickness, film, ior, alpha, mode);
}

TEST(LobeDegenerate, HairIsSane) {
    for (float v : {0.0f, 1e-6f, 0.01f, 1.0f, 1e6f, -1.0f, quietNan})
        for (float s : {0.0f, 0.05f, 1.0f, infinity, quietNan})
            for (float ior : {1.55f, 1.0f, 0.5f, 0.0f, quietNan})
                for (float cuticle : {0.5f, 0.0f, 1.0f, quietNan})
                    for (float sigma : {0.0f, 1.0f, 1e9f, -1.0f, quietNan})
                        ASSERT_TRUE(sane(PATINA_LOBE_CASE(
                            "hair", chiangHair, vec3(1.0, sigma, 0.5), vec3(1.0), vec3(1.0), ior,
                            vec2(v, s), vec2(s, v), vec2(v, s), cuticle, vec3(sigma, 0.0, 1.0))))
                            << values(v, s, ior, cuticle, sigma);
}

TEST(LobeDegenerate, MirrorGlassFollowsSnell) {
    const auto glass =
        sh64::dielectricSetup(vec3(1.0), 1.5, vec2(0.0), false, sh::SCATTER_RT, false, 1);
    for (double z : {0.9, 0.3, -0.9}) {
        const vec3 wo = direction(z, 0.7);
        const double eta = z > 0.0 ? 1.5 : 1.0 / 1.5;
        const double f = sh64::fresnelDielectric(std::fabs(z), eta);
        const auto r = sh64::dielectricSample(glass, wo, vec3(0.3, 0.6, 0.0));
        EXPECT_EQ(r.event, sh::LOBE_REFLECT | sh::LOBE_DELTA);
        EXPECT_NEAR(sh64::length(r.wi - vec3(-wo.x, -wo.y, wo.z)), 0.0, 1e-12);
        EXPECT_NEAR(r.pdf, f, 1e-12);
        const auto t = sh64::dielectricSample(glass, wo, vec3(0.3, 0.6, 0.999));
        EXPECT_EQ(t.event, sh::LOBE_TRANSMIT | sh::LOBE_DELTA);
        EXPECT_NEAR(t.wi.x * eta, -wo.x, 1e-12);
        EXPECT_NEAR(t.wi.y * eta, -wo.y, 1e-12);
        EXPECT_LT(t.wi.z * wo.z, 0.0);
        EXPECT_NEAR(t.eta, 1.0 / eta, 1e-12);
        EXPECT_NEAR(t.weight.x, 1.0, 1e-12);
        EXPECT_NEAR(t.pdf, 1.0 - f, 1e-12);
    }
}

TEST(LobeDegenerate, MatchedIorIsNotThere) {
    for (double alpha : {0.0, 0.05, 1.0})
        for (double z : {1.0, 0.2, -0.6}) {
            const auto l = sh64::dielectricSetup(vec3(0.5), 1.0, vec2(alpha), false, sh::SCATTER_RT,
                                                 false, alpha > 0.5);
            const vec3 wo = direction(z, 1.0);
            const auto s = sh64::dielectricSample(l, wo, vec3(0.9, 0.8, 0.7));
            EXPECT_EQ(s.event, sh::LOBE_TRANSMIT | sh::LOBE_DELTA);
            EXPECT_NEAR(sh64::length(s.wi + wo), 0.0, 1e-12);
            EXPECT_NEAR(s.weight.x, 0.5, 1e-12);
            EXPECT_NEAR(sh64::dielectricAlbedo(l, wo).x, 0.5, 1e-12);
            EXPECT_EQ(sh64::dielectricEnergy(l, wo).r, 0.0);
        }
}

TEST(LobeDegenerate, FresnelOff) {
    const vec3 wo = direction(0.5, 0.0);
    const auto r = sh64::dielectricSetup(vec3(1.0), 0.0, vec2(0.4), false, sh::SCATTER_R, false, 1);
    EXPECT_NEAR(sh64::dielectricAlbedo(r, wo).x, 1.0, 1e-12);
    const auto t = sh64::dielectricSetup(vec3(0.7), 0.0, vec2(0.4), false, sh::SCATTER_T, false, 1);
    EXPECT_NEAR(sh64::dielectricAlbedo(t, wo).x, 0.7, 1e-7);
}

TEST(LobeDegenerate, AlbedoIsContinuousAtTheMirrorSwitch) {
    for (double z : {1.0, 0.7, 0.3, 0.1, 0.05, -0.95, -0.8, -0.5, -0.2}) {
        const vec3 wo = direction(z, 0.3);
        const auto glass = [&](double alpha) {
            const LobeCase c = PATINA_LOBE_CASE("glass", dielectric, vec3(1.0), 1.5, vec2(alpha),
                                                false, sh::SCATTER_R, false, 1);
            return c.f64.albedo(wo).x;
        };
        EXPECT_NEAR(glass(1.001e-3) / glass(0.99e-3), 1.0, 5e-3) << z;
        if (z < 0.0) continue;
        const auto metal = [&](double alpha) {
            const LobeCase c =
                PATINA_LOBE_CASE("metal", conductor, vec3(1.4), vec3(1.8), vec2(alpha), false, 1);
            return c.f64.albedo(wo).x;
        };
        EXPECT_NEAR(metal(1.001e-3) / metal(0.99e-3), 1.0, 5e-3) << z;
    }
}

TEST(LobeDegenerate, RotatingByAQuarterSwapsTheAxes) {
    const LobeCase a =
        PATINA_LOBE_CASE("a", dielectric, vec3(1.0), 1.5, vec2(0.1, 0.4), false, 3, false, 1);
    const LobeCase b =
        PATINA_LOBE_CASE("b", dielectric, vec3(1.0), 1.5, vec2(0.4, 0.1), false, 3, false, 1);
    for (int i = 0; i < 200; ++i) {
        const vec3 wo = sphereDirection(quasiRandom(i));
        const vec3 wi = sphereDirection(quasiRandom(i + 999));
        const auto e = a.f64.eval(wo, wi);
        const auto f = b.f64.eval(vec3(-wo.y, wo.x, wo.z), vec3(-wi.y, wi.x, wi.z));
        EXPECT_NEAR(e.pdf, f.pdf, 1e-12 * (1.0 + e.pdf));
        EXPECT_NEAR(e.value.x, f.value.x, 1e-12 * (1.0 + e.value.x));
    }
}

TEST(LobeDegenerate, SmoothDiffuseIsLambert) {
    const vec3 color(0.8, 0.5, 0.1);
    for (bool compensation : {false, true}) {
        const auto l = sh64::orenNayarSetup(color, 0.0, compensation);
        for (double z : {1.0, 0.3, 0.01}) {
            const vec3 wo = direction(z, 0.2);
            EXPECT_NEAR(sh64::orenNayarEval(l, wo, direction(0.4, 2.0)).value.y,
                        0.5 * 0.4 / sh64::PI, 1e-12);
            EXPECT_NEAR(sh64::orenNayarAlbedo(l, wo).x, 0.8, 1e-12);
        }
    }
}

TEST(LobeDegenerate, RetroreflectionMirrorsTheLobe) {
    const LobeCase a =
        PATINA_LOBE_CASE("a", conductor, vec3(0.2), vec3(3.0), vec2(0.1, 0.3), false, 1);
    const LobeCase b =
        PATINA_LOBE_CASE("b", conductor, vec3(0.2), vec3(3.0), vec2(0.1, 0.3), true, 1);
    const vec3 wo = direction(0.5, 0.6), wi = direction(0.6, 3.5);
    EXPECT_NEAR(a.f64.eval(wo, wi).pdf, b.f64.eval(wo, vec3(-wi.x, -wi.y, wi.z)).pdf, 1e-12);
    const auto s = b.f64.sample(wo, vec3(0.2, 0.3, 0.4));
    EXPECT_NEAR(s.pdf, b.f64.eval(wo, s.wi).pdf, 1e-9 * s.pdf);
}
