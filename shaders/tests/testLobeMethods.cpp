// SPDX-License-Identifier: Apache-2.0
// The choice points' effects on a lobe: samplers draw from what they state, the second lobe of
// Kulla and Conty is reciprocal and keeps a white furnace, and no method leaves what is physical.

#include <gtest/gtest.h>

#include "shaders/tests/chiSquared.h"
#include "shaders/tests/lobeCase.h"

using namespace patina;
using namespace patina::test;

namespace {

constexpr int sampleCount = 100000;
constexpr std::uint64_t seeds[] = {17, 171};

/// The microfacet lobes after CHANGE to the lobe `l`.
#define PATINA_CHANGED_CASES(CHANGE, ALPHA, NDF, COMPENSATE)                                       \
    std::vector<LobeCase> {                                                                        \
        PATINA_LOBE_CASE_WITH("conductor", conductor, conductor, (l.ndf = NDF, CHANGE),            \
                              vec3(0.2, 0.9, 1.4), vec3(3.9, 2.4, 1.8), ALPHA, false, COMPENSATE), \
            PATINA_LOBE_CASE_WITH("dielectricR", dielectric, dielectric, (l.ndf = NDF, CHANGE),    \
                                  vec3(1.0), 1.5, ALPHA, false, 1, false, COMPENSATE),             \
            PATINA_LOBE_CASE_WITH("schlickR", schlick, schlick, (l.ndf = NDF, CHANGE),             \
                                  vec3(0.9, 0.5, 0.1), vec3(1.0), vec3(1.0), 5.0, ALPHA, false, 1, \
                                  false, COMPENSATE),                                              \
            PATINA_LOBE_CASE_WITH("dielectricRT", dielectric, dielectric, (l.ndf = NDF, CHANGE),   \
                                  vec3(1.0), 1.5, ALPHA, false, 3, false, COMPENSATE)              \
    }

/// Those of the second lobe of Kulla and Conty.
std::vector<LobeCase> kullaContyCases() {
    return PATINA_CHANGED_CASES((void)l, vec2(0.8), sh::NDF_GGX, sh::COMPENSATE_ADD);
}

void expectConsistent(const LobeCase& c, double z) {
    expectSamplesAreOfEval(c, direction(z, 0.4), 300, 1e-8);
}

void expectDrawsFromItsPdf(const LobeCase& c, double z, double significance) {
    const vec3 wo = direction(z, 0.4);
    const DensityGrid grid(c.f64, wo);
    int rejected = 0;
    double worst = 1.0;
    for (std::uint64_t seed : seeds) {
        const ChiSquared t = grid.test(c.f32, wo, sampleCount, seed);
        EXPECT_FALSE(t.stray) << c.name << " wo.z " << z;
        rejected += t.pValue < significance;
        worst = std::min(worst, t.pValue);
    }
    EXPECT_LT(rejected, 2) << c.name << " wo.z " << z << " p " << worst;
}

} // namespace

TEST(MicrofacetSampling, WeightIsValueOverPdf) {
    for (int ndf : {sh::NDF_GGX, sh::NDF_BECKMANN})
        for (const LobeCase& c :
             PATINA_CHANGED_CASES(l.sampling = sh::SAMPLING_BOUNDED_VNDF, vec2(0.3, 0.7), ndf, 1))
            for (double z : {1.0, 0.5, 0.08, -0.6})
                if (z > 0.0 || c.name == "dielectricRT") expectConsistent(c, z);
}

// Significance 0.01 over all runs (Sidak); a case fails when both seeds reject.
TEST(MicrofacetSampling, DrawsFromItsPdf) {
    const double significance = 1.0 - std::pow(1.0 - 0.01, 1.0 / 8.0);
    for (int ndf : {sh::NDF_GGX, sh::NDF_BECKMANN}) {
        const LobeCase c =
            PATINA_LOBE_CASE_WITH("conductor", conductor, conductor,
                                  (l.ndf = ndf, l.sampling = sh::SAMPLING_BOUNDED_VNDF), vec3(1.0),
                                  vec3(1.0), vec2(0.4, 0.9), false, 0);
        for (double z : {0.9, 0.2})
            expectDrawsFromItsPdf(c, z, significance);
    }
}

// That is what they are for: of a rough lobe at grazing angles fewer samples go below the surface.
TEST(MicrofacetSampling, BoundsLoseFewerSamples) {
    double found[2];
    for (int sampling : {sh::SAMPLING_VNDF, sh::SAMPLING_BOUNDED_VNDF}) {
        const LobeCase c = PATINA_LOBE_CASE_WITH("c", conductor, conductor, l.sampling = sampling,
                                                 vec3(1.0), vec3(1.0), vec2(0.9), false, 0);
        int count = 0;
        for (int i = 0; i < 4000; ++i)
            count += c.f64.sample(direction(0.2, 0.0), quasiRandom(i)).event != 0;
        found[sampling] = count / 4000.0;
    }
    EXPECT_GT(found[1], found[0] + 0.05);
}

TEST(KullaConty, SamplesWhatItEvaluates) {
    const double significance = 1.0 - std::pow(1.0 - 0.01, 1.0 / 12.0);
    for (const LobeCase& c : kullaContyCases()) {
        for (double z : {1.0, 0.5, 0.08})
            expectConsistent(c, z);
        if (c.name != "dielectricRT") expectDrawsFromItsPdf(c, 0.5, significance);
    }
}

TEST(KullaConty, IsReciprocal) {
    for (const LobeCase& c : kullaContyCases())
        if (c.name != "dielectricRT") {
            EXPECT_LT(asymmetry(c), 5e-7) << c.name;
        }
}

// A white mirror keeps all light; what the lobe states as its albedo is what it reflects.
TEST(KullaConty, KeepsAWhiteFurnace) {
    for (double alpha : {0.1, 0.3, 0.6, 1.0})
        for (int ndf : {sh::NDF_GGX, sh::NDF_BECKMANN})
            for (double z : {1.0, 0.5, 0.1}) {
                const LobeCase white = PATINA_LOBE_CASE_WITH(
                    "white", schlick, schlick, l.ndf = ndf, vec3(1.0), vec3(1.0), vec3(1.0), 5.0,
                    vec2(alpha), false, 1, false, sh::COMPENSATE_ADD);
                const vec3 wo = direction(z, 0.0);
                EXPECT_NEAR(sampledAlbedo(white.f64, wo, 20000).x, 1.0, 1.2e-2)
                    << alpha << " " << ndf << " " << z;
                EXPECT_NEAR(white.f64.albedo(wo).x, 1.0, 1.2e-2) << alpha << " " << z;
                const LobeCase metal = PATINA_LOBE_CASE_WITH(
                    "metal", conductor, conductor, l.ndf = ndf, vec3(0.2, 0.9, 1.4),
                    vec3(3.9, 2.4, 1.8), vec2(alpha), false, sh::COMPENSATE_ADD);
                EXPECT_LT(largest(sampledAlbedo(metal.f64, wo, 20000) - metal.f64.albedo(wo)),
                          1.5e-2)
                    << alpha << " " << ndf << " " << z;
            }
}

// Whatever method and whatever side: finite, not negative, at most 1.
TEST(AlbedoMethods, StayPhysicalEverywhere) {
    for (int method = sh::ALBEDO_TABLE; method <= sh::ALBEDO_QUADRATURE; ++method)
        for (int compensate : {0, 1, 2})
            for (double alpha : {0.0, 1e-3, 0.02, 1.0})
                for (const LobeCase& c :
                     PATINA_CHANGED_CASES(l.albedo = method,
                     vec2(alpha, alpha * (method == sh::ALBEDO_FIT ? 1.0 : 0.3)),
                     (compensate == 0 ? sh::NDF_BECKMANN : sh::NDF_GGX), compensate))
                    for (double z : {1.0, 0.3, 1e-3, 0.0, -0.3}) {
                        const vec3 e = c.f32.albedo(direction(z, 0.7));
                        for (int k = 0; k < 3; ++k)
                            EXPECT_TRUE(e[k] >= 0.0 && e[k] <= 1.02)
                                << c.name << " method " << method << " compensate " << compensate
                                << " alpha " << alpha << " wo.z " << z << ": " << e[k];
                    }
}
