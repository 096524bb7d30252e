// SPDX-License-Identifier: Apache-2.0
// Volumes of fields against closed forms and homogeneous media.

#include "hdDelegate/embree/media/tests/mediaScene.h"
#include "hdDelegate/image/fieldGrid.h"
#include "hdDelegate/scene/tests/prims.h"
#include "base/tests/testTools.h"

using namespace patina;
using namespace patina::test;

namespace {

/// A cube of -1..1 whose density is what `f` says at voxel centres.
template <class F> std::shared_ptr<const FieldGrid> cubeGrid(int bricks, const F& f) {
    constexpr int edge = FieldGrid::edge;
    const int n = bricks * edge;
    const float size = 2.0f / float(n);
    mat4 place(1.0f);
    for (int a = 0; a < 3; ++a) {
        place[a][a] = size;
        place[3][a] = -1.0f + 0.5f * size;
    }
    auto grid = std::make_shared<FieldGrid>(ivec3(0), ivec3(bricks), 1, place);
    std::vector<float> values(FieldGrid::voxels);
    for (int b = 0; b < bricks * bricks * bricks; ++b) {
        const ivec3 brick(b / (bricks * bricks), b / bricks % bricks, b % bricks);
        for (int i = 0; i < FieldGrid::voxels; ++i) {
            const ivec3 voxel = brick * edge + ivec3(i / (edge * edge), i / edge % edge, i % edge);
            values[size_t(i)] = f((vec3(voxel) + 0.5f) * size - 1.0f);
        }
        grid->setBrick(brick, values);
    }
    return grid;
}

void volume(MediaScene& s, std::shared_ptr<const FieldGrid> grid, const std::string& material,
            const vec3& center = vec3(0)) {
    auto prim = makePrim<Volume>("/volume");
    prim->material = material;
    prim->transform = translate(center.x, center.y, center.z);
    prim->fields.push_back({"density", "", "", std::move(grid)});
    s.scene->edit().set(prim);
}

void volumeMaterial(MediaScene& s, const vec3& absorption, const vec3& scattering,
                    float anisotropy = 0.0f) {
    s.material("/m", volumeNodes(absorption, scattering, anisotropy), "volume");
}

} // namespace

TEST(FieldGrid, InterpolatesLinearlyAndBounds) {
    const auto grid = cubeGrid(2, [](const vec3& p) { return 1.0f + p.x + 2.0f * p.y; });
    for (const vec3& p : {vec3(0.1f, -0.2f, 0.3f), vec3(0.0f), vec3(-0.7f, 0.61f, 0.0f)})
        EXPECT_NEAR(grid->sample(p).x, 1.0f + p.x + 2.0f * p.y, 1e-5f);
    EXPECT_EQ(grid->sample(vec3(1.5f)).x, 0.0f);
    vec3 minimum(INFINITY), maximum(-INFINITY);
    grid->range(vec3(-0.1f), vec3(0.1f), minimum, maximum);
    EXPECT_LE(minimum.x, 0.7f);
    EXPECT_GE(maximum.x, 1.3f);
}

// Significance as in testMedia.cpp: five standard errors.
TEST(Volumes, AbsorptionFollowsTheIntegralOfDensity) {
    MediaScene s;
    const vec3 absorption(0.5f, 1.0f, 2.0f);
    volumeMaterial(s, absorption, vec3(0));
    // Rays along z see the same density at every x and y near the middle: its integral is 2.
    volume(s, cubeGrid(4, [](const vec3& p) { return 1.0f + std::sin(3.0f * p.z); }), "/m");
    s.whiteRoom(0.1f);
    expectMean(s.render(16, 256), glm::exp(-2.0f * absorption), 2e-3f);
}

TEST(Volumes, ShadowsFollowTheIntegralOfDensity) {
    const auto lit = [](bool with) {
        MediaScene s;
        volumeMaterial(s, vec3(0.5f, 1.0f, 2.0f), vec3(0));
        if (with) volume(s, cubeGrid(2, [](const vec3&) { return 0.5f; }), "/m", vec3(0, 0, 3));
        s.material("/white", whiteNodes());
        s.cube("/floor", vec3(0, 0, -1), vec3(2, 2, 2), "/white");
        s.distant(vec3(1), vec3(0, 0, -1));
        s.camera(vec3(0, 0, 1.5f), 0.1f); // between the volume and the floor
        return s.render(16, 256);
    };
    const auto without = lit(false), with = lit(true);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(with.mean[c] / without.mean[c], std::exp(-std::exp2(float(c) - 1.0f)),
                    5.0f * with.error[c] / without.mean[c] + 2e-2f);
}

TEST(Volumes, WhiteVolumesLoseNothing) {
    for (float density : {0.5f, 5.0f}) {
        MediaScene s;
        volumeMaterial(s, vec3(0), vec3(1.0f, 0.5f, 2.0f), 0.4f);
        volume(s, cubeGrid(2, [&](const vec3& p) { return density * (1.0f + p.x); }), "/m");
        s.whiteRoom(2.2f);
        SCOPED_TRACE(density);
        expectMean(s.render(16, 64), vec3(1), 2e-3f);
    }
}

TEST(Volumes, ConstantDensityIsAHomogeneousMedium) {
    const auto mean = [](bool fields) {
        MediaScene s;
        volumeMaterial(s, vec3(0.2f, 0.5f, 1.0f), vec3(1.5f, 1.0f, 0.5f), 0.3f);
        if (fields) {
            // Many voxels, for the density falls off over half a voxel at the faces.
            volume(s, cubeGrid(16, [](const vec3&) { return 1.0f; }), "/m");
        } else {
            s.cube("/cube", vec3(0), vec3(2), "/m");
        }
        s.distant(vec3(3), vec3(0, -1, -1));
        s.dome(0.3f);
        s.camera(vec3(0, 0, 5), 1.6f);
        return s.render(16, 256);
    };
    const auto a = mean(true), b = mean(false);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(a.mean[c], b.mean[c], 5.0f * (a.error[c] + b.error[c]) / 4.0f + 5e-3f);
}

TEST(Volumes, OneBrightVoxelIsOpaqueAndEndsSoon) {
    // Candidates of rays are bounded: without the bound each would make all it may, some 65,000,
    // and then pass.
    MediaScene s;
    volumeMaterial(s, vec3(1.0f), vec3(0.0f));
    volume(s, cubeGrid(1, [](const vec3& p) { return glm::length(p) < 0.3f ? 3e38f : 0.0f; }),
           "/m");
    s.whiteRoom(0.1f); // all rays meet it
    const auto image = s.render(16, 64);
    ASSERT_TRUE(image.finite);
    for (int c = 0; c < 3; ++c)
        EXPECT_LT(image.mean[c], 1e-4f);
}

TEST(Volumes, WhatIsDenserThanItsMajorantGainsNoLight) {
    // A medium that only scatters and differs from place to place, in a grid of one cell: dense in
    // a thin sheet that lies between the places where the majorant is looked for.
    MediaScene s;
    s.material(
        "/m",
        {makeNode("volume", "ND_volume", {}, {{"vdf", {"vdf", ""}}}),
         makeNode("vdf", "ND_anisotropic_vdf", {}, {{"scattering", {"vector", ""}}}),
         makeNode("vector", "ND_combine3_vector3", {},
                  {{"in1", {"dense", ""}}, {"in2", {"dense", ""}}, {"in3", {"dense", ""}}}),
         makeNode("dense", "ND_ifgreater_float",
                  {{"value2", number(0.03f)}, {"in1", number(0.01f)}, {"in2", number(1000.0f)}},
                  {{"value1", {"away", ""}}}),
         makeNode("away", "ND_absval_float", {}, {{"in", {"from", ""}}}),
         makeNode("from", "ND_subtract_float", {{"in2", number(0.3f)}}, {{"in1", {"x", ""}}}),
         makeNode("x", "ND_extract_vector3", {{"index", Value::makeInt(0)}},
                  {{"in", {"position", ""}}}),
         makeNode("position", "ND_position_vector3")},
        "volume");
    volume(s, cubeGrid(1, [](const vec3&) { return 1.0f; }), "/m");
    s.whiteRoom(2.2f);
    expectMean(s.render(16, 64), vec3(1), 2e-3f);
}

TEST(Volumes, WithoutAKnownMaterialAreAGreyWhosePathsEnd) {
    // Paths scatter until they have 0.25 of their light, which takes 7 times at 0.8 each; then each
    // time 0.8 of them go on, which makes 5 more in the mean. Each time takes a ray to go on and
    // one for the dome's light. The volume is so thick that white paths would scatter up to the
    // bound of all paths, hundreds of times.
    constexpr double most = 2.0 * (7 + 5) + 2.0;
    for (const std::string material : {"", "/none", "/surface"}) {
        MediaScene s;
        s.material("/surface", whiteNodes());
        volume(s, cubeGrid(2, [](const vec3&) { return 1000.0f; }), material);
        s.whiteRoom(1.0f); // inside of the outline
        const auto image = s.render(16, 16);
        ASSERT_TRUE(image.finite);
        for (int c = 0; c < 3; ++c) {
            EXPECT_GT(image.mean[c], 0.0f) << material;
            EXPECT_LT(image.mean[c], 0.8f) << material; // all light that is seen was scattered
        }
        EXPECT_LT(image.raysPerPath, most) << material;
        const std::string why = material.empty()
                                    ? "no material is bound"
                                    : "material " + material + " does not exist or is not a volume";
        EXPECT_EQ(onlyWarning(s.scene->diagnostics()),
                  "/volume material:binding " + why +
                      "; a grey one is shown that scatters 0.8 of the light");
    }
    MediaScene white;
    volumeMaterial(white, vec3(0), vec3(1));
    volume(white, cubeGrid(2, [](const vec3&) { return 1000.0f; }), "/m");
    white.dome(1.0f);
    white.camera(vec3(0, 0, 5), 1.0f);
    EXPECT_GT(white.render(8, 4).raysPerPath, most) << "the bound tells them apart";
}

TEST(Volumes, ThreadsChangeNothing) {
    expectThreadsChangeNothing(40, 4, [](MediaScene& s) {
        volumeMaterial(s, vec3(0.2f), vec3(1.5f, 1.0f, 0.5f));
        volume(s, cubeGrid(2, [](const vec3& p) { return 1.0f + p.x; }), "/m");
        s.whiteRoom(2.5f);
    });
}

TEST(Volumes, ExtremesStayFinite) {
    for (float density : {-1.0f, 1e30f, float(NAN), 1e-30f}) {
        MediaScene s;
        volumeMaterial(s, vec3(1), vec3(1));
        volume(s, cubeGrid(1, [&](const vec3&) { return density; }), "/m");
        s.whiteRoom(2.5f);
        expectSane(s.render(6, 4));
    }
    MediaScene s;
    auto prim = makePrim<Volume>("/volume");
    prim->fields.push_back({"density", "/does/not/exist.vdb", "density", nullptr});
    s.scene->edit().set(prim);
    s.whiteRoom(2.5f);
    EXPECT_TRUE(s.render(6, 4).finite);
}
