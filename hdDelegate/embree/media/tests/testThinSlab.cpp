// SPDX-License-Identifier: Apache-2.0
// Thin slabs: light goes straight through, also to lights, with the colour of the wall.

#include "hdDelegate/embree/media/tests/mediaScene.h"

#include "materialNetwork/cpu/bsdf.h"

using namespace patina;
using namespace patina::test;

namespace {

std::vector<NetworkNode> pane(const vec3& tint, float roughness) {
    return surfaceOf("ND_dielectric_bsdf",
                     {{"tint", rgb(tint)},
                      {"ior", number(1.5f)},
                      {"roughness", pair(roughness)},
                      {"scatter_mode", text("RT")}},
                     {{"thin_walled", Value::makeBool(true)}});
}

} // namespace

TEST(ThinSlabs, ShadowsHaveTheColourOfTheSlab) {
    const vec3 tint(0.9f, 0.5f, 0.1f);
    const auto lit = [&](bool withPane) {
        MediaScene s;
        s.material("/m", whiteNodes());
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
        s.whiteRoom(1.2f);
        SCOPED_TRACE(roughness);
        expectMean(s.render(16, 32), vec3(1), 4e-3f);
    }
}

TEST(ThinSlabs, LightIsTintedOnceByEach) {
    const vec3 tint(0.9f, 0.5f, 0.1f);
    MediaScene s;
    s.material("/pane", pane(tint, 0.0f));
    s.material("/light", {makeNode("surface", "ND_surface", {}, {{"edf", {"edf", ""}}}),
                          makeNode("edf", "ND_uniform_edf", {{"color", grey(1)}})});
    s.plane("/first", vec3(0, 0, 2), 4.0f, "/pane");
    s.plane("/second", vec3(0, 0, 1), 4.0f, "/pane");
    s.plane("/light", vec3(0), 1.0f, "/light");
    s.camera(vec3(0, 0, 5), 0.1f);
    s.settings.maxDepth = 0; // without light that bounces between the walls
    const float transmittance = 0.96f / 1.04f;
    expectMean(s.render(16, 256), tint * tint * transmittance * transmittance, 1e-4f);
}
