// SPDX-License-Identifier: Apache-2.0
// The measured methods of domes: where they are good, and where each fails.
#include "hdDelegate/raster/measure/domeMethods.h"
#include "hdDelegate/raster/measure/measureDome.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace {

using namespace patina;
using namespace patina::measure;
using glm::vec3;

/// All rows, measured once.
const std::vector<Row>& rows() {
    static const std::vector<Row> all = domeLight(false);
    return all;
}

/// A row's mean error over its mean light.
double errorOf(const std::string& method, const std::string& subject) {
    for (const Row& r : rows())
        if (r.method == method && r.subject == subject)
            return r.mean / std::accumulate(r.truths.begin(), r.truths.end(), 0.0) *
                   double(r.truths.size());
    ADD_FAILURE() << method << ": " << subject;
    return NAN;
}

const MeasuredSky& sun() {
    static const MeasuredSky sky = MeasuredSky::sun();
    return sky;
}

DomePoint pointAt(Reflector::Kind kind, double alpha, const vec3& n) {
    return DomePoint(Reflector(kind, {bake::slanted(0.7), alpha}), n, 0.3f);
}

TEST(DomeMethods, filteringConvergesWithItsSamples) {
    for (const char* kind : {"diffuse", "sheen", "dielectric", "conductor"})
        for (const char* sky : {"soft", "sun"}) {
            // Few samples blur a sun away or hit it by chance: below 16 nothing is in order.
            double last = errorOf("filtered", std::string(kind) + ", " + sky + ", 16 samples");
            for (const int samples : {64, 256, 1024}) {
                const std::string count = std::to_string(samples);
                const double error =
                    errorOf("filtered", std::string(kind) + ", " + sky + ", " + count + " samples");
                EXPECT_LT(error, 0.9 * last) << kind << ", " << sky << ", " << samples;
                last = error;
            }
        }
    for (const char* kind : {"diffuse", "dielectric", "conductor"})
        EXPECT_LT(errorOf("filtered", std::string(kind) + ", soft, 1024 samples"), 0.003) << kind;
    EXPECT_GT(errorOf("filtered", "diffuse, sun, 16 samples"), 0.2); // a sun is too small for it
}

TEST(DomeMethods, samplesConverge) {
    for (const char* kind : {"diffuse", "sheen", "dielectric", "conductor"})
        EXPECT_LT(errorOf("sampled", std::string(kind) + ", sun, 16 passes"),
                  0.5 * errorOf("sampled", std::string(kind) + ", sun"));
}

TEST(DomeMethods, aConstantSkyIsKnownToAllButSamples) {
    for (const char* method : {"harmonics", "prefiltered", "harmonicsUnwindowed"})
        EXPECT_LT(errorOf(method, "diffuse, constant"), 0.01) << method;
    EXPECT_LT(errorOf("prefiltered", "conductor, constant"), 0.01);
}

TEST(DomeMethods, harmonicsAreGoodForDiffuseAndUselessForMirrors) {
    EXPECT_LT(errorOf("harmonics", "diffuse, sun"), 0.03);
    EXPECT_LT(errorOf("harmonics", "diffuse, soft"), 0.1);
    // Beyond the rasterizer: a mirror with the light of all directions.
    const MeasuredSky soft = MeasuredSky::soft();
    double error = 0.0, light = 0.0;
    for (int i = 0; i < 64; ++i) {
        const float z = 1.0f - (2.0f * float(i) + 1.0f) / 64.0f, r = std::sqrt(1.0f - z * z);
        const DomePoint p =
            pointAt(Reflector::Conductor, 0.01,
                    vec3(r * std::cos(2.4f * float(i)), z, r * std::sin(2.4f * float(i))));
        const double truth = domeTruth(p, soft);
        error += std::fabs(byHarmonics(p, soft, false) - truth);
        light += truth;
    }
    EXPECT_GT(error, 0.2 * light);
    EXPECT_LT(errorOf("harmonics", "conductor, soft"), 0.5 * error / light);
}

TEST(DomeMethods, withoutAWindowTheSunRingsBelowZero) {
    float bare = 0.0f, windowed = 0.0f;
    for (const MeasuredSky::Texel& t : sun().texels) {
        bare = std::min(bare, sun().bare.at(t.direction).x);
        windowed = std::min(windowed, sun().harmonics.at(t.direction).x);
    }
    EXPECT_LT(bare, -0.01f);
    EXPECT_GE(windowed, 0.0f);
    EXPECT_GT(errorOf("harmonicsUnwindowed", "diffuse, sun"),
              2.0 * errorOf("harmonics", "diffuse, sun"));
}

TEST(DomeMethods, bothTruthsAgree) {
    for (const double alpha : {0.1, 0.3})
        for (const auto kind : {Reflector::Diffuse, Reflector::Dielectric, Reflector::Conductor})
            for (const vec3& n : {vec3(0, 1, 0), glm::normalize(vec3(0.5f, 0.6f, -0.4f)),
                                  glm::normalize(vec3(0.1f, 0.9f, -0.2f)), vec3(0, 0, 1)}) {
                const DomePoint p = pointAt(kind, alpha, n);
                const double sum = overTexels(p, sun());
                EXPECT_NEAR(overDrawn(p, sun()), sum, 0.01 * sum + 1e-4) << alpha << " " << kind;
            }
}

TEST(DomeMethods, theImageIsItsMeanAtTheLastLevel) {
    // Of texels, not of directions.
    double mean = 0.0;
    for (int y = 0; y < MeasuredSky::height; ++y)
        for (int x = 0; x < MeasuredSky::width; ++x)
            mean += double(sun().radiance(
                SkyTexture::direction(x, y, MeasuredSky::width, MeasuredSky::height)));
    mean /= MeasuredSky::width * MeasuredSky::height;
    EXPECT_NEAR(sun().image.at(vec3(1, 0, 0), 100.0f).x, mean, 1e-3 * mean);
    EXPECT_NEAR(sun().image.at(vec3(0.6f, 0.8f, 0), 0.0f).x, sun().radiance(vec3(0.6f, 0.8f, 0)),
                1e-4);
}

} // namespace
