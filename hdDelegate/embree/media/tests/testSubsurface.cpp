// SPDX-License-Identifier: Apache-2.0
// Subsurface scattering: the albedo that was asked for, energy, and what open meshes show.

#include "hdDelegate/embree/media/randomWalk.h"
#include "hdDelegate/embree/media/tests/mediaScene.h"
#include "hdDelegate/geometry/tests/meshFixtures.h"

using namespace patina;
using namespace patina::test;

namespace {

std::vector<NetworkNode> skin(const vec3& color, const vec3& radius, float anisotropy) {
    return surfaceOf(
        "ND_subsurface_bsdf",
        {{"color", rgb(color)}, {"radius", rgb(radius)}, {"anisotropy", number(anisotropy)}});
}

} // namespace

TEST(Subsurface, WhiteIsWhiteAndBlackIsBlack) {
    for (float g : {-0.5f, 0.0f, 0.9f}) {
        const WalkMedium m = walkMedium({vec3(1, 0, 0.5f), vec3(2.0f), g});
        EXPECT_EQ(m.scattering.x, m.extinction.x);
        EXPECT_NEAR(m.scattering.y, 0.0f, 1e-5f);
        EXPECT_GT(m.scattering.z, 0.0f);
        EXPECT_LT(m.scattering.z, m.extinction.z);
        EXPECT_FLOAT_EQ(m.extinction.x, 0.5f);
    }
}

// Tolerance: five standard errors, and 0.015 that the approximation of van de Hulst is off by.
TEST(Subsurface, ThickObjectsHaveTheColourAskedFor) {
    const vec3 color(0.2f, 0.5f, 0.8f);
    for (float g : {0.0f, 0.5f}) {
        MediaScene s = block(skin(color, vec3(0.01f, 0.02f, 0.04f), g));
        s.whiteRoom(0.1f);
        SCOPED_TRACE(g);
        expectMean(s.render(32, 64), color, 0.015f);
    }
}

// Significance as in testMedia.cpp: five standard errors.
TEST(Subsurface, WhiteObjectsLoseNothing) {
    for (float radius : {1e-4f, 0.1f, 1.0f, 100.0f}) {
        MediaScene s = ball(skin(vec3(1), vec3(radius, 0.5f * radius, 0.0f), 0.3f));
        s.whiteRoom(1.5f);
        SCOPED_TRACE(radius);
        expectMean(s.render(16, 32), vec3(1), 2e-3f);
    }
}

TEST(Subsurface, OpenMeshesAreDiffuse) {
    const vec3 color(0.2f, 0.5f, 0.8f);
    MediaScene s;
    s.material("/m", skin(color, vec3(1e5f), 0.0f));
    s.plane("/sheet", vec3(0), 100.0f, "/m");
    s.whiteRoom(1.0f);
    expectMean(s.render(32, 64), color, 1e-3f);
}

TEST(Subsurface, OpenBowlsGainNothing) {
    for (float radius : {0.1f, 1.0f}) {
        MediaScene s;
        s.material("/m", skin(vec3(1), vec3(radius, 0.3f * radius, 0.1f * radius), 0.0f));
        auto mesh = std::make_shared<Mesh>(cubeMesh());
        mesh->path = "/box";
        mesh->material = "/m";
        // Without the side that the camera does not see, the last.
        mesh->faceVertexCounts.pop_back();
        mesh->faceVertexIndices.resize(20);
        s.scene->edit().set(mesh);
        s.whiteRoom(1.9f);
        const auto image = s.render(16, 64);
        ASSERT_TRUE(image.finite);
        for (int c = 0; c < 3; ++c) {
            EXPECT_LT(image.mean[c], 1.0f + 5.0f * image.error[c] + 2e-3f) << radius;
            EXPECT_GT(image.mean[c], 0.9f) << radius;
        }
    }
}

TEST(Subsurface, ThreadsChangeNothing) {
    expectThreadsChangeNothing(40, 4, [](MediaScene& s) {
        s.material("/m", skin(vec3(0.8f, 0.5f, 0.3f), vec3(0.5f, 0.2f, 0.1f), 0.2f));
        s.sphere("/ball", vec3(0), 1.0f, "/m");
        s.dome(1.0f);
        s.distant(vec3(2), vec3(0, -1, -1));
        s.camera(vec3(0, 0, 5), 2.5f);
    });
}

TEST(Subsurface, ObjectsInsideAreNotMet) {
    std::vector<float> first;
    for (bool inside : {false, true}) {
        MediaScene s;
        s.material("/m", skin(vec3(0.8f), vec3(0.3f), 0.0f));
        s.material("/black", {makeNode("surface", "ND_surface")});
        s.sphere("/ball", vec3(0), 1.0f, "/m");
        if (inside) s.sphere("/core", vec3(0), 0.9f, "/black");
        s.whiteRoom(1.5f);
        const auto image = s.render(16, 16);
        if (!inside)
            first = image.color;
        else
            for (size_t i = 0; i < first.size(); ++i)
                ASSERT_NEAR(first[i], image.color[i], 0.02f);
    }
}

TEST(Subsurface, PartsThatOverlapAreOneObject) {
    // Two boxes of one mesh, one within the other: the walk must not end at the inner one.
    const auto meanOf = [](bool inner) {
        MediaScene s;
        s.material("/m", skin(vec3(0.9f), vec3(0.5f), 0.0f));
        auto mesh = std::make_shared<Mesh>(cubeMesh());
        mesh->path = "/boxes";
        mesh->material = "/m";
        if (inner) {
            const Mesh box = *mesh;
            for (const vec3& p : box.points.first())
                mesh->points.values[0].push_back(0.7f * p);
            for (int corner : box.faceVertexIndices)
                mesh->faceVertexIndices.push_back(8 + corner);
            mesh->faceVertexCounts.assign(12, 4);
        }
        s.scene->edit().set(mesh);
        s.whiteRoom(1.9f);
        return s.render(32, 64);
    };
    const auto one = meanOf(false), two = meanOf(true);
    EXPECT_NEAR(one.mean.x, two.mean.x, 5.0f * (one.error.x + two.error.x));
}

TEST(Subsurface, ExtremesStayFinite) {
    for (const vec3& radius :
         {vec3(0.0f), vec3(INFINITY), vec3(NAN), vec3(-1.0f), vec3(1e-30f, 1, 0)})
        for (const vec3& color : {vec3(0.0f), vec3(2.0f), vec3(NAN, -1, 0.5f)})
            for (float g : {-1.0f, 1.0f, NAN}) {
                MediaScene s = ball(skin(color, radius, g));
                s.whiteRoom(2.5f);
                expectSane(s.render(6, 4));
            }
}

namespace {

constexpr int varianceSide = 32, varianceSamples = 64;

/// Of one sample; every pixel has the same mean.
double varianceOf(const MediaScene::Image& image) {
    return double(image.error.x) * image.error.x * varianceSide * varianceSide * varianceSamples;
}
double relativeVariance(const MediaScene::Image& image) {
    return varianceOf(image) / (double(image.mean.x) * image.mean.x);
}

} // namespace

// Of a half space under light from everywhere, (2/3)(1 - ln 2) of what scatters for the first time
// leaves next. A walk by physical chances has a weight of 0 or the albedo then, so the relative
// variance of one is 3.89 at least, however its colour is found. Half of it at most is asked for; a
// variance of 65536 samples is within a tenth of the truth.
TEST(Subsurface, DarkColoursAreLessNoisyThanPhysicalChances) {
    const double physical = 1.0 / (2.0 / 3.0 * (1.0 - std::log(2.0))) - 1.0;
    for (float color : {0.002f, 0.02f}) {
        MediaScene s = block(skin(vec3(color), vec3(0.01f), 0.0f));
        s.whiteRoom(0.1f);
        const auto image = s.render(varianceSide, varianceSamples);
        EXPECT_NEAR(image.mean.x, color, 5.0f * image.error.x + 0.05f * color);
        EXPECT_LT(relativeVariance(image), 0.5 * physical) << color;
    }
}

// Transmittance of a black ball along chords of 2 R cos: the mean of exp(-x cos) over the cosine,
// 2 (1 - (1 + x) exp(-x)) / x^2 with x = 2 R / l. Chances to leave or not have the relative
// variance 1 / mean - 1; a quarter of it at most is asked for where that is far above 1.
// Significance as above; 1 % for the ball's facets.
TEST(Subsurface, BlackBallsLetThroughWhatTheirChordsDo) {
    for (float radius : {2.0f, 1.0f, 0.2f}) {
        MediaScene s = ball(skin(vec3(0), vec3(radius), 0.0f));
        s.whiteRoom(0.8f);
        const auto image = s.render(varianceSide, varianceSamples);
        const double x = 2.0 / radius;
        const double mean = 2.0 * (1.0 - (1.0 + x) * std::exp(-x)) / (x * x);
        EXPECT_NEAR(image.mean.x, mean, 5.0 * image.error.x + 0.01 * mean) << radius;
        if (mean < 0.05) {
            EXPECT_LT(relativeVariance(image), 0.25 * (1.0 / mean - 1.0)) << radius;
        }
    }
}

// Under a coat that reflects more than it gives back, walks are drawn often enough.
TEST(Subsurface, DarkColoursUnderACoatAreFoundOften) {
    const auto variance = [](float specular) {
        MediaScene s = block({makeNode("surface", "ND_standard_surface_surfaceshader",
                                       {{"base", number(0.0f)},
                                        {"subsurface", number(1.0f)},
                                        {"subsurface_color", grey(0.01f)},
                                        {"subsurface_radius", grey(0.01f)},
                                        {"specular", number(specular)},
                                        {"specular_roughness", number(0.5f)}})});
        s.distant(vec3(1.0f), glm::normalize(vec3(1, 0, -0.3f)));
        s.camera(vec3(0, 0, 5), 0.1f);
        // The highlight has no noise: what varies is the walks' part.
        return varianceOf(s.render(varianceSide, varianceSamples));
    };
    // Drawn half of the time, a sample varies by twice what it would alone, and that it is drawn or
    // not adds its mean square once more: 4 covers both.
    EXPECT_LT(variance(1.0f), 4.0 * variance(0.0f));
}
