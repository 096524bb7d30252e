// SPDX-License-Identifier: Apache-2.0
// NURBS patches and meshes of tetrahedra.

#include "hdDelegate/geometry/drawnFaces.h"
#include "hdDelegate/geometry/tests/patchFixtures.h"
#include "hdDelegate/geometry/tetSurface.h"
#include "hdDelegate/scene/primCompare.h"

#include <set>

namespace patina {
namespace {

/// A bicubic patch without weights over a grid of control points, z = f(x, y).
template <class Height> Mesh bicubic(int nu, int nv, Height height) {
    const auto direction = [](int n) {
        std::vector<double> knots = {0, 0, 0};
        for (int i = 0; i <= n - 3; ++i)
            knots.push_back(i);
        knots.insert(knots.end(), 3, double(n - 3));
        return NurbsDirection{n, 4, knots};
    };
    NurbsPatch patch;
    patch.u = direction(nu);
    patch.v = direction(nv);
    std::vector<vec3> points;
    for (int j = 0; j < nv; ++j)
        for (int i = 0; i < nu; ++i)
            points.push_back(vec3(i, j, height(i, j)));
    return patchMesh(patch, points);
}

TEST(Patch, rationalSphereIsASphere) {
    const TriangleMesh mesh = draw(spherePatch(), 0.1f);
    ASSERT_GT(mesh.triangles.size(), 500u);
    // Floats of size 1 are 6e-8 apart; positions round once, normals a few times. Poles look a
    // ten-thousandth of a span aside, where the normal has turned by as much.
    for (size_t i = 0; i < mesh.positions[0].size(); ++i) {
        const vec3 &p = mesh.positions[0][i], &n = mesh.normals[0][i];
        EXPECT_NEAR(glm::length(p), 1.0f, 2e-7f);
        const bool pole = std::abs(p.z) > 0.99999f;
        EXPECT_LT(glm::length(n - p), pole ? 4e-4f : 2e-6f) << p.x << " " << p.y << " " << p.z;
    }
    for (size_t t = 0; t < mesh.triangles.size(); ++t) {
        EXPECT_GT(glm::dot(triangleCross(mesh, t), mesh.positions[0][mesh.triangles[t].x]), 0.0f);
        for (int k = 0; k < 3; ++k)
            EXPECT_LE(glm::distance(mesh.positions[0][mesh.triangles[t][k]],
                                    mesh.positions[0][mesh.triangles[t][(k + 1) % 3]]),
                      0.1f * std::sqrt(2.0f));
    }
}

TEST(Patch, leftHandedTurnsInsideOut) {
    Mesh left = spherePatch();
    left.leftHanded = true;
    const TriangleMesh mesh = draw(left);
    EXPECT_LT(glm::dot(triangleCross(mesh, 5), mesh.positions[0][mesh.triangles[5].x]), 0.0f);
    EXPECT_LT(glm::dot(mesh.normals[0][40], mesh.positions[0][40]), 0.0f);
}

TEST(Patch, polynomialPatchIsItsBlossom) {
    // Control points x(i) = Greville abscissae would be linear; here the middle of a uniform cubic
    // span is (1, 23, 23, 1) / 48 of its control points in each direction.
    const auto height = [](int i, int j) { return 0.3f * float(i * i) - 0.2f * float(j * i * j); };
    NurbsPatch patch;
    patch.u = {8, 4, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}};
    patch.v = {9, 4, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}};
    patch.u.low = 4.5, patch.u.high = 6.0; // begins in the middle of the second span
    patch.v.low = 5.5, patch.v.high = 7.0;
    const TriangleMesh drawn = draw(patchMesh(patch, bicubic(8, 9, height).points.first()));
    const float w[] = {1 / 48.0f, 23 / 48.0f, 23 / 48.0f, 1 / 48.0f};
    float expected = 0.0f;
    for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 4; ++i)
            expected += w[i] * w[j] * height(1 + i, 2 + j);
    EXPECT_LT(glm::distance(drawn.positions[0][0], vec3(2.5f, 3.5f, expected)), 1e-5f);
    ASSERT_TRUE(drawn.attribute("st"));
    EXPECT_EQ(drawn.attribute("st")->data.front(), 0.0f);
    EXPECT_EQ(drawn.attribute("st")->data.back(), 1.0f);
}

TEST(Patch, normalsAreThoseOfTheSurface) {
    // x and y are linear in the parameters up to the ends' Greville points, so finite differences
    // of positions of a fine tessellation give the truth for the middle.
    const Mesh mesh = bicubic(6, 6, [](int i, int j) { return std::sin(float(i)) * float(j % 3); });
    const TriangleMesh drawn = draw(mesh, 0.02f);
    const std::vector<vec3> smooth = smoothNormals(drawn.positions[0], drawn.triangles);
    double worst = 0.0;
    for (size_t i = 0; i < smooth.size(); ++i) {
        const vec3& p = drawn.positions[0][i];
        if (p.x < 0.5f || p.x > 4.5f || p.y < 0.5f || p.y > 4.5f) continue;
        worst = std::max(worst, double(glm::distance(smooth[i], drawn.normals[0][i])));
    }
    // Curvature is below 4 here: facets of 0.02 turn by 0.08, and their mean is of second order.
    EXPECT_LT(worst, 0.01);
}

TEST(Patch, primvarsOfEachInterpolation) {
    Mesh mesh = bicubic(5, 4, [](int, int) { return 0.0f; });
    // Segments: 2 by 1. Varying: 3 by 2.
    std::vector<float> x;
    for (const vec3& p : mesh.points.first())
        x.push_back(p.x);
    mesh.primvars = {makePrimvar("c", Interpolation::Constant, 1, {7}),
                     makePrimvar("f", Interpolation::Uniform, 1, {1, 2}),
                     makePrimvar("l", Interpolation::Varying, 1, {0, 1, 4, 10, 11, 14}),
                     makePrimvar("x", Interpolation::Vertex, 1, x)};
    const TriangleMesh drawn = draw(mesh);
    EXPECT_EQ(drawn.attribute("c")->rate, MeshAttribute::Rate::Constant);
    std::set<int> segments(drawn.triangleFace.begin(), drawn.triangleFace.end());
    EXPECT_EQ(segments, (std::set<int>{0, 1}));
    EXPECT_EQ(drawn.attribute("f")->data, (std::vector<float>{1, 2}));
    const MeshAttribute& linear = *drawn.attribute("l");
    const MeshAttribute& vertex = *drawn.attribute("x");
    const MeshAttribute& st = *drawn.attribute("st");
    for (size_t i = 0; i < drawn.positions[0].size(); ++i) {
        const float u = 2.0f * st.data[2 * i], v = st.data[2 * i + 1];
        const float along = u <= 1.0f ? u : 1.0f + 3.0f * (u - 1.0f);
        EXPECT_NEAR(linear.data[i], along + 10.0f * v, 1e-5f);
        EXPECT_NEAR(vertex.data[i], drawn.positions[0][i].x, 1e-6f);
    }
}

TEST(Patch, edgesWhereKnotsAreAsManyAsTheDegree) {
    // A roof: linear in u, bent at the middle.
    NurbsPatch patch;
    patch.u = {3, 2, {0, 0, 1, 2, 2}};
    patch.v = {2, 2, {0, 0, 1, 1}};
    const TriangleMesh drawn = draw(
        patchMesh(patch, {{-1, 0, 0}, {0, 0, 1}, {1, 0, 0}, {-1, 1, 0}, {0, 1, 1}, {1, 1, 0}}));
    for (size_t t = 0; t < drawn.triangles.size(); ++t) {
        const vec3 n = glm::normalize(triangleCross(drawn, t));
        for (int k = 0; k < 3; ++k)
            EXPECT_LT(glm::distance(drawn.normals[0][drawn.triangles[t][k]], n), 1e-6f);
    }
    EXPECT_EQ(drawn.triangles.size(), 4u);
}

TEST(Patch, staysWithinTheBudget) {
    TessellationOptions options;
    options.targetEdge = 1e-6f;
    options.triangleBudget = 5000;
    const Mesh mesh = bicubic(9, 9, [](int, int) { return 0.0f; });
    EXPECT_LE(draw(mesh, options).triangles.size(), 5000u);
}

TEST(Patch, badInputIsReportedAndNotDrawn) {
    const auto check = [](const char* input, const auto& change) {
        Mesh mesh = spherePatch();
        auto patch = std::make_shared<NurbsPatch>(*mesh.patch);
        change(mesh, *patch);
        mesh.patch = patch;
        Diagnostics diagnostics;
        setNurbsCage(mesh);
        EXPECT_TRUE(tessellate(mesh, {}, diagnostics).triangles.empty()) << input;
        EXPECT_TRUE(warned(diagnostics, "/patch", input)) << input;
        EXPECT_EQ(diagnostics.count(), 1) << input;
    };
    check("uOrder", [](Mesh&, NurbsPatch& p) { p.u.order = 1; });
    check("vOrder", [](Mesh&, NurbsPatch& p) { p.v.order = 1000000; });
    check("uVertexCount", [](Mesh&, NurbsPatch& p) { p.u.vertexCount = 2; });
    check("uVertexCount", [](Mesh&, NurbsPatch& p) { p.u.vertexCount = -9; });
    check("vKnots", [](Mesh&, NurbsPatch& p) { p.v.knots.pop_back(); });
    check("vKnots", [](Mesh&, NurbsPatch& p) { p.v.knots[3] = 5.0; });
    check("vKnots", [](Mesh&, NurbsPatch& p) { p.v.knots.assign(8, 1.0); });
    check("uKnots", [](Mesh&, NurbsPatch& p) { p.u.knots[4] = nan; });
    check("points", [](Mesh& m, NurbsPatch&) { m.points.values[0].pop_back(); });
    check("points", [](Mesh& m, NurbsPatch&) { m.points.values[0][3].x = INFINITY; });
    check("points", [](Mesh& m, NurbsPatch&) { m.points = {}; });
    check("points", [](Mesh&, NurbsPatch& p) {
        p.weights.assign(45, 5e-324); /* their sums underflow */
    });
}

TEST(Patch, badWeightsCountAsOne) {
    NurbsPatch patch = *spherePatch().patch;
    patch.weights[7] = -1.0;
    const Mesh mesh = patchMesh(patch, spherePatch().points.first());
    Diagnostics diagnostics;
    EXPECT_FALSE(tessellate(mesh, {}, diagnostics).triangles.empty());
    EXPECT_TRUE(warned(diagnostics, "/patch", "pointWeights"));
}

TEST(Patch, movesWithItsPoints) {
    Mesh mesh = spherePatch();
    movePoints(mesh, [](const vec3& p) { return p * 2.0f; });
    const TriangleMesh drawn = draw(mesh, shutter(0, 1));
    ASSERT_EQ(drawn.positions.size(), 2u);
    ASSERT_EQ(drawn.normals.size(), 2u);
    EXPECT_NEAR(glm::length(drawn.positions[1][50]), 2.0f, 1e-6f);
    EXPECT_NEAR(drawn.boundsMax.z, 2.0f, 1e-6f);
}

TEST(Patch, otherKnotsAreAnotherShape) {
    const Mesh mesh = spherePatch();
    NurbsPatch patch = *mesh.patch;
    EXPECT_TRUE(sameShape(mesh, patchMesh(patch, mesh.points.first())));
    patch.u.knots[3] = 0.5;
    EXPECT_FALSE(sameShape(mesh, patchMesh(patch, mesh.points.first())));
}

/// Two tetrahedra that share a triangle.
TetMesh twoTets() {
    TetMesh mesh;
    mesh.path = "/tets";
    mesh.points = std::vector<vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
    mesh.tets = {0, 1, 2, 3, 1, 4, 2, 3};
    return mesh;
}

TEST(Tets, surfaceFacesOutward) {
    Diagnostics diagnostics;
    const TriangleMesh mesh = draw(*surfaceOf(twoTets(), diagnostics));
    EXPECT_EQ(mesh.triangles.size(), 6u);
    EXPECT_NEAR(volume(mesh), 0.5f, 1e-6f); // 1/6 and 1/3
    EXPECT_TRUE(mesh.normals.empty());      // faceted
    TetMesh left = twoTets();
    left.leftHanded = true;
    for (size_t t = 0; t < left.tets.size(); t += 4)
        std::swap(left.tets[t], left.tets[t + 1]);
    EXPECT_NEAR(volume(draw(*surfaceOf(left, diagnostics))), 0.5f, 1e-6f);
    EXPECT_EQ(diagnostics.count(), 0);
}

TEST(Tets, authoredSurfaceIsUsed) {
    TetMesh mesh = twoTets();
    mesh.surface = {0, 2, 1, 0, 1, 3};
    Diagnostics diagnostics;
    EXPECT_EQ(draw(*surfaceOf(mesh, diagnostics)).triangles.size(), 2u);
}

TEST(Tets, uniformPrimvarsPerTetOrPerTriangle) {
    TetMesh mesh = twoTets();
    mesh.primvars = {makePrimvar("tet", Interpolation::Uniform, 1, {3, 4}),
                     makePrimvar("face", Interpolation::Uniform, 1, {0, 1, 2, 3, 4, 5}),
                     makePrimvar("indexed", Interpolation::Uniform, 1, {8, 9}, {1, 0})};
    Diagnostics diagnostics;
    const TriangleMesh drawn = draw(*surfaceOf(mesh, diagnostics));
    EXPECT_EQ(drawn.attribute("tet")->data, (std::vector<float>{3, 3, 3, 4, 4, 4}));
    EXPECT_EQ(drawn.attribute("indexed")->data, (std::vector<float>{9, 9, 9, 8, 8, 8}));
    EXPECT_EQ(drawn.attribute("face")->data.size(), 6u);
}

TEST(Tets, badIndicesAreReported) {
    TetMesh mesh = twoTets();
    mesh.tets[6] = 77;
    Diagnostics diagnostics;
    EXPECT_EQ(surfaceOf(mesh, diagnostics)->faceVertexCounts.size(), 4u);
    EXPECT_TRUE(warned(diagnostics, "/tets", "tetVertexIndices"));
}

} // namespace
} // namespace patina
