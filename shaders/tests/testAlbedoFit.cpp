// SPDX-License-Identifier: Apache-2.0
// The methods for directional albedos against quadrature, over the 32 x 32 cell centres of (cosine,
// root of alpha): RMSE times 65535, single scattering. Everything here is deterministic.

#include <gtest/gtest.h>

#include "shaders/bake/albedoQuadrature.h"
#include "shaders/tests/lobeCase.h"

using namespace patina;
using sh64::vec2;
using sh64::vec3;

namespace {

constexpr int gridSide = 32;
constexpr double referenceBound = 12.4; // of the reference curve that the fit had to beat

/// A reflectance: exact, and as a lobe with a method for its albedo.
struct Curve {
    std::string name;
    std::function<double(double c)> exact;
    std::function<test::LobeCase(double alpha, int method)> lobe;
};

Curve dielectric(double ior) {
    return {"ior " + std::to_string(ior), [=](double c) { return sh64::fresnelDielectric(c, ior); },
            [=](double alpha, int method) {
                return PATINA_LOBE_CASE_WITH("", dielectric, dielectric, l.albedo = method,
                                             vec3(1.0), ior, vec2(alpha), false, sh::SCATTER_R,
                                             false, sh::COMPENSATE_NONE);
            }};
}

Curve conductor(double n, double k) {
    return {"n " + std::to_string(n) + " k " + std::to_string(k),
            [=](double c) { return sh64::fresnelConductorChannel(c, n, k); },
            [=](double alpha, int method) {
                return PATINA_LOBE_CASE_WITH("", conductor, conductor, l.albedo = method, vec3(n),
                                             vec3(k), vec2(alpha), false, 0);
            }};
}

Curve schlick(double f0, double f82, double f90, double exponent) {
    return {"f0 " + std::to_string(f0) + " exponent " + std::to_string(exponent),
            [=](double c) {
                return sh64::fresnelSchlick(
                           c, sh64::schlickFresnel(vec3(f0), vec3(f82), vec3(f90), exponent))
                    .x;
            },
            [=](double alpha, int method) {
                return PATINA_LOBE_CASE_WITH("", schlick, schlick, l.albedo = method, vec3(f0),
                                             vec3(f82), vec3(f90), exponent, vec2(alpha), false,
                                             sh::SCATTER_R, false, 0);
            }};
}

/// For every place of the grid once: the spread of cosines, from which the truth of every curve is
/// a sum. A mirror below the threshold of the lobes has a single cosine in both.
class Grid {
public:
    static const Grid& shared() {
        static const Grid grid;
        return grid;
    }

    test::Error error(const Curve& curve, int method) const {
        test::Error error;
        for (const Place& p : _places) {
            double truth = 0.0;
            for (int i = 0; i < binCount; ++i)
                if (p.light[i] > 0.0) truth += p.light[i] * curve.exact(p.cosine[i]);
            error.add(curve.lobe(p.alpha, method).f32.albedo(p.wo).x - truth);
        }
        return error;
    }

private:
    static constexpr int binCount = 300;
    struct Place {
        vec3 wo;
        double alpha;
        std::vector<double> light, cosine;
    };

    Grid() {
        bake::InterfaceQuadrature quadrature(96, sh::NDF_GGX);
        for (int a = 0; a < gridSide; ++a)
            for (int m = 0; m < gridSide; ++m) {
                Place p;
                p.wo = bake::slanted((m + 0.5) / gridSide);
                p.alpha = std::pow((a + 0.5) / gridSide, 2.0);
                p.light.resize(binCount);
                p.cosine.resize(binCount);
                quadrature.setView(p.wo, vec2(p.alpha));
                quadrature.spread(binCount, p.light.data(), p.cosine.data());
                _places.push_back(p);
            }
    }

    std::vector<Place> _places;
};

double rms(const Curve& curve, int method) {
    return Grid::shared().error(curve, method).rms() * 65535.0;
}

} // namespace

TEST(AlbedoFit, DielectricsFromNearlyMatchedToDiamond) {
    for (int i = 0; i <= 26; ++i) {
        const double ior = 1.05 + 1.95 * std::pow(i / 26.0, 1.5);
        EXPECT_LE(rms(dielectric(ior), sh::ALBEDO_FIT), referenceBound) << ior;
    }
    const test::Error glass = Grid::shared().error(dielectric(1.5), sh::ALBEDO_FIT);
    EXPECT_LE(glass.rms() * 65535.0, 2.5);
    EXPECT_LE(glass.largest, 1e-3);
}

// Silver to carbon, none of them among those that were fitted to but the last.
TEST(AlbedoFit, Conductors) {
    for (const Curve& c :
         {conductor(0.15, 2.5), conductor(0.27, 3.6), conductor(1.4, 1.9), conductor(1.9, 3.9),
          conductor(2.4, 0.9), conductor(4.2, 5.1), conductor(1.0, 8.0), conductor(0.05, 2.1)})
        EXPECT_LE(rms(c, sh::ALBEDO_FIT), referenceBound) << c.name;
}

TEST(AlbedoFit, GeneralizedSchlick) {
    for (const Curve& c :
         {schlick(0.04, 1.0, 1.0, 5.0), schlick(0.6, 0.8, 1.0, 5.0), schlick(0.04, 1.0, 1.0, 4.0),
          schlick(0.04, 1.0, 0.5, 3.0), schlick(0.0, 1.0, 1.0, 6.0), schlick(1.0, 1.0, 0.2, 2.0)})
        EXPECT_LE(rms(c, sh::ALBEDO_FIT), referenceBound) << c.name;
}

// A known figure of others, so that the scale is the same as theirs; 3 % for reading it off.
TEST(AlbedoFit, KarisErrsAsKnown) {
    EXPECT_NEAR(rms(dielectric(1.5), sh::ALBEDO_KARIS), 1545.0, 0.03 * 1545.0);
}

TEST(AlbedoMethods, MoreWorkIsLessError) {
    for (const Curve& c : {dielectric(1.5), conductor(0.2, 3.9), schlick(0.04, 1.0, 1.0, 5.0)}) {
        const double few = rms(c, sh::ALBEDO_SAMPLES_16);
        const double truth = rms(c, sh::ALBEDO_QUADRATURE);
        EXPECT_LT(truth, 5.0) << c.name;
        EXPECT_LT(truth, 0.1 * few) << c.name;
        EXPECT_LT(rms(c, sh::ALBEDO_TABLE), 150.0) << c.name;
        std::printf("%s: karis %.0f, 16 samples %.0f, table %.1f, fit %.1f, quadrature %.2f\n",
                    c.name.c_str(), rms(c, sh::ALBEDO_KARIS), few, rms(c, sh::ALBEDO_TABLE),
                    rms(c, sh::ALBEDO_FIT), truth);
    }
}
