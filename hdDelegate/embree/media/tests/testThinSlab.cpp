// SPDX-License-Identifier: Apache-2.0
// Thin slabs: light goes straight through, also to lights, with the colour of the wall.

#include "hdDelegate/embree/media/tests/mediaScene.h"

#include "materialNetwork/cpu/bsdf.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace patina;
using namespace patina::test;

namespace {

std::vector<NetworkNode> pane(const vec3& tint, float roughness) {
    return {node("/m/surface", "ND_surface", {{"thin_walled", Value::makeBool(true)}},
                 {{"bsdf", {"/m/glass", ""}}}),
            node("/m/glass", "ND_dielectric_bsdf",
                 {{"tint", Value::makeColor3(tint.x, tint.y, tint.z)},
                  {"ior", Value::makeFloat(1.5f)},
                  {"roughness", Value::makeVec2(roughness, roughness)},
                  {"scatter_mode", Value::makeString("RT")}})};
}

std::vector<NetworkNode> white() {
    return {
        node("/m/surface", "ND_surface", {}, {{"bsdf", {"/m/diffuse", ""}}}),
        node("/m/diffuse", "ND_oren_nayar_diffuse_bsdf", {{"color", Value::makeColor3(1, 1, 1)}})};
}

} // namespace

TEST(ThinSlabs, ShadowsHaveTheColourOfTheSlab) {
    const vec3 tint(0.9f, 0.5f, 0.1f);
    const auto lit = [&](bool withPane) {
        MediaScene s;
        s.material("/m", white());
        s.material("/pane", pane(tint, 0.0f));
        s.plane("/floor", vec3(0), 1.0f, "/m");
        // Between the sun and what the camera sees, but not seen itself.
        if (withPane) s.plane("/window", vec3(0, 2, 2), 2.0f, "/pane");
        s.distant(vec3(1), vec3(0, -1, -1));
        s.camera(vec3(0, 0, 5), 0.1f);
        return s.render(4, 16).mean;
    };
    const vec3 without = lit(false), with = lit(true);
    const float once = sh::fresnelDielectric(std::sqrt(0.5f), 1.5f);
    const float transmittance = (1.0f - once) / (1.0f + once);
    ASSERT_GT(without.x, 0.1f);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(with[c] / without[c], tint[c] * transmittance, 1e-3f);
}

// Significance: five standard errors, as in testMedia.cpp.
TEST(ThinSlabs, WhiteOnesLoseNothing) {
    for (float roughness : {0.0f, 0.4f}) {
        MediaScene s;
        s.material("/pane", pane(vec3(1), roughness));
        s.cube("/box", vec3(0), vec3(1), "/pane");
        s.plane("/front", vec3(0, 0, 2), 4.0f, "/pane");
        s.dome(1.0f);
        s.camera(vec3(0, 0, 5), 1.2f);
        const auto image = s.render(16, 32);
        SCOPED_TRACE(roughness);
        expectMean(image, vec3(1), 4e-3f);
    }
}

TEST(ThinSlabs, LightIsTintedOnceByEach) {
    const vec3 tint(0.9f, 0.5f, 0.1f);
    MediaScene s;
    s.material("/pane", pane(tint, 0.0f));
    s.material("/light",
               {node("/m/surface", "ND_surface", {}, {{"edf", {"/m/edf", ""}}}),
                node("/m/edf", "ND_uniform_edf", {{"color", Value::makeColor3(1, 1, 1)}})});
    s.plane("/first", vec3(0, 0, 2), 4.0f, "/pane");
    s.plane("/second", vec3(0, 0, 1), 4.0f, "/pane");
    s.plane("/light", vec3(0), 1.0f, "/light");
    s.camera(vec3(0, 0, 5), 0.1f);
    s.settings.maxDepth = 0; // without light that bounces between the walls
    const auto image = s.render(16, 256);
    const float transmittance = 0.96f / 1.04f;
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(image.mean[c], tint[c] * tint[c] * transmittance * transmittance,
                    5.0f * image.error[c] + 1e-4f);
}
