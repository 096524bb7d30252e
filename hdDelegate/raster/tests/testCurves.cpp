// SPDX-License-Identifier: Apache-2.0
// Curves as triangles: how many, how wide, and along what.

#include "hdDelegate/raster/scene/rasterShapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

using namespace patina;

namespace {

/// Quarters of a circle of radius 1, one after the other, and a straight one beside it.
CurveSet bent(float radius, int quarters = 3) {
    CurveSet set;
    set.basis = CurveBasis::Bezier;
    constexpr float k = 0.5522848f; // of a quarter circle's control points
    const vec2 corners[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 0}};
    set.controlPoints.resize(1);
    for (int i = 0; i < quarters; ++i) {
        const vec2 a = corners[i], b = corners[i + 1];
        for (const vec2& p : {a, a + k * b, b + k * a, b})
            set.controlPoints[0].emplace_back(p, 0.0f, radius);
    }
    for (int i = 0; i < 4; ++i)
        set.controlPoints[0].emplace_back(2.0f, float(i), 0.0f, radius);
    for (int i = 0; i <= quarters; ++i) {
        set.segments.push_back(uint32_t(4 * i));
        set.segmentCurve.push_back(i == quarters);
    }
    return set;
}

RasterFineness fineness(float pixel) {
    return {0.03f * pixel, pixel};
}

/// The width of a straight tube as seen from a direction across it, by its vertices.
float widthOf(const TriangleMesh& mesh, float angle) {
    float low = INFINITY, high = -INFINITY;
    for (const vec3& p : mesh.positions[0]) {
        if (p.x < 1.5f) continue;
        const float at = (p.x - 2.0f) * std::cos(angle) + p.z * std::sin(angle);
        low = std::min(low, at);
        high = std::max(high, at);
    }
    return high - low;
}

} // namespace

TEST(RasterCurves, StripsFollowTheCurveAsFarAsIsSeen) {
    size_t last = 0;
    for (const float pixel : {0.5f, 0.05f, 0.005f}) {
        const RasterTriangles strips = curveTriangles(bent(0.01f), fineness(pixel), true);
        const TriangleMesh& mesh = strips.mesh;
        ASSERT_EQ(strips.halfWidth.size(), mesh.positions[0].size());
        ASSERT_EQ(strips.along.size(), mesh.triangles.size());
        EXPECT_GT(mesh.triangles.size(), last);
        last = mesh.triangles.size();
        for (size_t t = 0; t < mesh.triangles.size(); ++t) {
            vec3 middle(0.0f);
            for (int k = 0; k < 3; ++k)
                middle += mesh.positions[0][mesh.triangles[t][k]] / 3.0f;
            EXPECT_NEAR(glm::length(strips.along[t]), 0.01f, 1e-5f);
            if (middle.x < 1.5f) {
                EXPECT_GT(glm::length(middle), 1.0f - 0.045f * pixel);
            }
        }
        size_t straight = 0;
        for (const int curve : mesh.triangleFace)
            straight += curve == 1;
        EXPECT_EQ(straight, 2u);
    }
}

TEST(RasterCurves, ValuesOfControlPointsFollowTheCurve) {
    CurveSet set;
    set.basis = CurveBasis::Bezier;
    set.controlPoints = {{{0, 0, 0, 1e-3f}, {3, 0, 0, 1e-3f}, {0, 0, 0, 1e-3f}, {1, 0, 0, 1e-3f}}};
    set.segments = {0};
    set.segmentCurve = {0};
    set.attributes.push_back({"p", 1, MeshAttribute::Rate::PerControl, {0, 3, 0, 1}});
    for (const bool strips : {false, true}) {
        const TriangleMesh mesh = curveTriangles(set, fineness(0.5f), strips).mesh;
        ASSERT_EQ(mesh.attributes[0].rate, MeshAttribute::Rate::PerCorner);
        ASSERT_EQ(mesh.attributes[0].data.size(), 3 * mesh.triangles.size());
        ASSERT_GE(mesh.triangles.size(), 8u); // the line itself would do with two
        for (size_t t = 0; t < mesh.triangles.size(); ++t)
            for (int k = 0; k < 3; ++k)
                EXPECT_NEAR(mesh.attributes[0].data[3 * t + size_t(k)],
                            mesh.positions[0][mesh.triangles[t][k]].x, 3e-3f); // ends are round
    }
}

TEST(RasterCurves, ControlPointsThatOverflowMakeFiniteNumbersOfTriangles) {
    CurveSet set = bent(0.01f);
    set.controlPoints[0][1].x = set.controlPoints[0][14].y = INFINITY; // as a basis of 3e38 makes
    for (const bool strips : {false, true}) {
        const RasterTriangles found = curveTriangles(set, fineness(0.5f), strips);
        EXPECT_GE(found.mesh.triangles.size(), 4u);
        for (const uvec3& t : found.mesh.triangles)
            EXPECT_LT(std::max({t.x, t.y, t.z}), found.mesh.positions[0].size());
    }
}

/// A straight curve whose radius falls from 0.8 to 0.2 over a length of 3: linear, or cubic with
/// control points at equal distances, along which the radius is linear, too.
CurveSet tapering(CurveBasis basis) {
    CurveSet set;
    set.basis = basis;
    const int points = basis == CurveBasis::Linear ? 2 : 4;
    set.controlPoints.resize(1);
    for (int i = 0; i < points; ++i) {
        const float u = float(i) / float(points - 1);
        set.controlPoints[0].emplace_back(0.0f, 0.0f, 3.0f * u, 0.8f - 0.6f * u);
    }
    set.segments = {0};
    set.segmentCurve = {0};
    return set;
}

TEST(RasterCurves, NormalsOfTaperingTubesLeanForward) {
    for (const CurveBasis basis : {CurveBasis::Linear, CurveBasis::Bezier}) {
        // Swept circles make a cone of this slope. One that touches two spheres leans by the sine.
        const float slope = 0.2f;
        const float lean = basis == CurveBasis::Linear ? slope : slope / std::hypot(1.0f, slope);
        const RasterTriangles tube = curveTriangles(tapering(basis), fineness(0.01f), false);
        size_t cone = 0;
        for (size_t i = 0; i < tube.mesh.positions[0].size(); ++i) {
            const vec3 &p = tube.mesh.positions[0][i], &n = tube.mesh.normals[0][i];
            EXPECT_NEAR(glm::length(n), 1.0f, 1e-5f);
            // Where a cap begins, its sphere has the normal of the cone.
            if (p.z < 0.8f * lean - 1e-4f || p.z > 3.0f + 0.2f * lean + 1e-4f) continue;
            ++cone;
            EXPECT_NEAR(n.z, lean, 1e-5f);
            const float wide = glm::length(vec2(p)) / std::sqrt(1.0f - n.z * n.z);
            const float axis = p.z - wide * n.z; // of the sphere that touches here
            if (basis == CurveBasis::Linear) {
                EXPECT_NEAR(wide, 0.8f - slope * axis, 2e-3f) << "as fine as its polygon";
            }
        }
        EXPECT_GT(cone, 10u);
        const RasterTriangles strip = curveTriangles(tapering(basis), fineness(100.0f), true);
        ASSERT_EQ(strip.slope.size(), strip.mesh.triangles.size());
        for (const float s : strip.slope)
            EXPECT_NEAR(s, -lean / std::sqrt(1.0f - lean * lean), 1e-5f);
    }
}

TEST(RasterCurves, DomedStripsHaveMoreColumns) {
    const CurveSet set = bent(0.01f);
    const RasterFineness fine = fineness(0.05f);
    const RasterTriangles flat = curveTriangles(set, fine, true);
    const RasterTriangles domed = curveTriangles(set, fine, true, true);
    EXPECT_EQ(domed.mesh.triangles.size(), 3 * flat.mesh.triangles.size());
    EXPECT_EQ(domed.halfWidth.size(), 2 * flat.halfWidth.size());
    ASSERT_EQ(domed.halfWidth.size() % 4, 0u);
    for (size_t i = 0; i < domed.halfWidth.size(); i += 4) {
        EXPECT_GT(domed.halfWidth[i], 0.0f);
        EXPECT_EQ(domed.halfWidth[i], domed.halfWidth[i + 1]);
        EXPECT_EQ(domed.halfWidth[i], -domed.halfWidth[i + 2]);
        EXPECT_EQ(domed.halfWidth[i], -domed.halfWidth[i + 3]);
        EXPECT_EQ(domed.ends[i] + StripDome, domed.ends[i + 1]);
        EXPECT_EQ(domed.ends[i + 1], domed.ends[i + 2]);
        EXPECT_EQ(domed.ends[i], domed.ends[i + 3]);
    }
    for (const uvec3& t : domed.mesh.triangles)
        for (int k = 0; k < 3; ++k)
            ASSERT_LT(t[k], domed.mesh.positions[0].size());
    const size_t needs = domed.mesh.triangles.size();
    EXPECT_TRUE(domedStripsFit(set, fine, needs));
    EXPECT_FALSE(domedStripsFit(set, fine, needs - 1));
}

TEST(RasterCurves, StripsEndWhereTheCurveDoes) {
    const auto endsOf = [](const CurveSet& curves) {
        const RasterTriangles strips = curveTriangles(curves, fineness(0.5f), true);
        std::map<float, int> count;
        for (const float end : strips.ends)
            ++count[end];
        EXPECT_EQ(strips.ends.size(), strips.halfWidth.size());
        return count;
    };
    // Two curves, each with a beginning and an end of two vertices.
    std::map<float, int> count = endsOf(bent(0.01f));
    EXPECT_EQ(count[StripBegins], 4);
    EXPECT_EQ(count[StripEnds], 4);
    EXPECT_GT(count[StripGoesOn], 4);
    count = endsOf(bent(0.01f, 4)); // the circle closes
    EXPECT_EQ(count[StripBegins], 2);
    EXPECT_EQ(count[StripEnds], 2);
    // Linear curves are round at their ends.
    CurveSet line;
    line.basis = CurveBasis::Linear;
    line.segments = {0, 1};
    line.segmentCurve = {0, 0};
    line.controlPoints = {{vec4(0, 0, 0, 0.01f), vec4(1, 0, 0, 0.01f), vec4(2, 1, 0, 0.01f)}};
    count = endsOf(line);
    EXPECT_EQ(count[StripBeginsRound], 2);
    EXPECT_EQ(count[StripEndsRound], 2);
    EXPECT_EQ(count[StripBegins] + count[StripEnds], 0);
    // Where they are large enough to have caps, those end the strip.
    for (vec4& p : line.controlPoints[0])
        p.w = 0.2f;
    count = endsOf(line);
    EXPECT_EQ(count.size(), 1u);
    EXPECT_GT(count[StripGoesOn], 8);
}

TEST(RasterCurves, TubesAreAsWideAsTheCurveInTheMean) {
    for (const float pixel : {0.2f, 0.02f}) {
        const RasterTriangles tube = curveTriangles(bent(0.1f), fineness(pixel), false);
        float sum = 0.0f;
        constexpr int angles = 720;
        for (int i = 0; i < angles; ++i) {
            const float width = widthOf(tube.mesh, 3.14159265f * float(i) / float(angles));
            EXPECT_NEAR(width, 0.2f, 0.06f * pixel + 1e-5f);
            sum += width;
        }
        EXPECT_NEAR(sum / float(angles), 0.2f, 2e-4f);
    }
}

TEST(RasterCurves, TubesAreNotTwisted) {
    // Corners of neighbouring rings stay beside each other all around the circle.
    const RasterTriangles tube = curveTriangles(bent(0.1f), fineness(0.01f), false);
    const TriangleMesh& mesh = tube.mesh;
    for (const uvec3& t : mesh.triangles)
        for (int k = 0; k < 3; ++k)
            EXPECT_GT(glm::dot(mesh.normals[0][t[k]], mesh.normals[0][t[(k + 1) % 3]]), 0.5f);
}

TEST(RasterCurves, ThoseAroundTheCameraAreMadeCoarser) {
    RasterFineness close = fineness(1e-6f);
    EXPECT_TRUE(fitCurves(bent(0.01f), close, 200));
    EXPECT_LE(curveTriangles(bent(0.01f), close, true).mesh.triangles.size(), 200u);
    RasterFineness far = fineness(0.05f);
    EXPECT_TRUE(fitCurves(bent(0.01f), far, 200));
    EXPECT_EQ(far.gap, fineness(0.05f).gap);
    EXPECT_FALSE(fitCurves(bent(0.1f), far, 100000));
    RasterFineness none = fineness(1e-6f);
    fitCurves(bent(0.01f), none, 0); // cannot be met, and ends
}

TEST(RasterCurves, LinearOnesHaveRoundEnds) {
    CurveSet set;
    set.controlPoints = {{vec4(0, 0, 0, 0.1f), vec4(1, 0, 0, 0.1f)}};
    set.segments = {0};
    set.segmentCurve = {0};
    const RasterTriangles fine = curveTriangles(set, fineness(0.01f), false);
    EXPECT_NEAR(fine.mesh.boundsMax.x, 1.1f, 1e-3f);
    EXPECT_NEAR(fine.mesh.boundsMin.x, -0.1f, 1e-3f);
    // Where they are too small to be seen there are none.
    EXPECT_EQ(curveTriangles(set, fineness(10.0f), true).mesh.triangles.size(), 2u);
}
