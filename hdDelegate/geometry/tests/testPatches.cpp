// SPDX-License-Identifier: Apache-2.0
// NURBS patches and meshes of tetrahedra.

#include "hdDelegate/geometry/drawnFaces.h"
#include "hdDelegate/geometry/nurbs.h"
#include "hdDelegate/geometry/tests/meshFixtures.h"
#include "hdDelegate/geometry/tetSurface.h"
#include "hdDelegate/scene/primCompare.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>

namespace patina {
namespace {

/// Rational quadratic arcs of a quarter turn each, n of them, in the plane: x, y, weight.
std::vector<vec3> circle(int quarters) {
    const float w = std::sqrt(0.5f);
    const vec3 corners[] = {{1, 0, 1},  {1, 1, w},   {0, 1, 1},  {-1, 1, w},
                            {-1, 0, 1}, {-1, -1, w}, {0, -1, 1}, {1, -1, w}};
    std::vector<vec3> points;
    for (int i = 0; i <= 2 * quarters; ++i)
        points.push_back(corners[i % 8]);
    return points;
}

std::vector<double> arcKnots(int quarters) {
    std::vector<double> knots = {0, 0, 0};
    for (int i = 1; i < quarters; ++i)
        knots.insert(knots.end(), {double(i), double(i)});
    knots.insert(knots.end(), {double(quarters), double(quarters), double(quarters)});
    return knots;
}

/// The unit sphere: a half circle in v, from the south pole to the north, turned around z in u.
Mesh sphere() {
    Mesh mesh;
    mesh.path = "/patch";
    auto patch = std::make_shared<NurbsPatch>();
    patch->u = {9, 3, arcKnots(4)};
    patch->v = {5, 3, arcKnots(2)};
    const std::vector<vec3> around = circle(4), half = circle(2);
    std::vector<vec3> points;
    for (const vec3& h : half)
        for (const vec3& a : around) {
            // The half circle's y is the radius, its x goes from one pole to the other.
            points.push_back(vec3(a.x * h.y, a.y * h.y, -h.x));
            patch->weights.push_back(double(a.z) * double(h.z));
        }
    mesh.points = points;
    mesh.patch = std::move(patch);
    setNurbsCage(mesh);
    return mesh;
}

/// A bicubic patch without weights over a grid of control points, z = f(x, y).
template <class Height> Mesh bicubic(int nu, int nv, Height height) {
    Mesh mesh;
    mesh.path = "/patch";
    auto patch = std::make_shared<NurbsPatch>();
    const auto direction = [](int n) {
        std::vector<double> knots = {0, 0, 0};
        for (int i = 0; i <= n - 3; ++i)
            knots.push_back(i);
        knots.insert(knots.end(), 3, double(n - 3));
        return NurbsDirection{n, 4, knots};
    };
    patch->u = direction(nu);
    patch->v = direction(nv);
    std::vector<vec3> points;
    for (int j = 0; j < nv; ++j)
        for (int i = 0; i < nu; ++i)
            points.push_back(vec3(i, j, height(i, j)));
    mesh.points = points;
    mesh.patch = std::move(patch);
    setNurbsCage(mesh);
    return mesh;
}

TEST(Patch, rationalSphereIsASphere) {
    const TriangleMesh mesh = draw(sphere(), 0.1f);
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
    Mesh left = sphere();
    left.leftHanded = true;
    const TriangleMesh mesh = draw(left);
    EXPECT_LT(glm::dot(triangleCross(mesh, 5), mesh.positions[0][mesh.triangles[5].x]), 0.0f);
    EXPECT_LT(glm::dot(mesh.normals[0][40], mesh.positions[0][40]), 0.0f);
}

TEST(Patch, polynomialPatchIsItsBlossom) {
    // Control points x(i) = Greville abscissae would be linear; here the middle of a uniform cubic
    // span is (1, 23, 23, 1) / 48 of its control points in each direction.
    const auto height = [](int i, int j) { return 0.3f * float(i * i) - 0.2f * float(j * i * j); };
    Mesh mesh = bicubic(8, 9, height);
    auto patch = std::make_shared<NurbsPatch>(*mesh.patch);
    patch->u.knots = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};
    patch->v.knots = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
    patch->u.low = 4.5, patch->u.high = 6.0; // begins in the middle of the second span
    patch->v.low = 5.5, patch->v.high = 7.0;
    mesh.patch = patch;
    const TriangleMesh drawn = draw(mesh);
    const float w[] = {1 / 48.0f, 23 / 48.0f, 23 / 48.0f, 1 / 48.0f};
    float expected = 0.0f;
    for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 4; ++i)
            expected += w[i] * w[j] * height(1 + i, 2 + j);
    EXPECT_LT(glm::distance(drawn.positions[0][0], vec3(2.5f, 3.5f, expected)), 1e-5f);
    const MeshAttribute* st = drawn.attribute("st");
    ASSERT_TRUE(st);
    EXPECT_EQ(st->data[0], 0.0f);
    EXPECT_EQ(st->data.back(), 1.0f);
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
    mesh.primvars.push_back(makePrimvar("c", Interpolation::Constant, 1, {7}));
    mesh.primvars.push_back(makePrimvar("f", Interpolation::Uniform, 1, {1, 2}));
    mesh.primvars.push_back(makePrimvar("l", Interpolation::Varying, 1, {0, 1, 4, 10, 11, 14}));
    std::vector<float> x;
    for (const vec3& p : mesh.points.first())
        x.push_back(p.x);
    mesh.primvars.push_back(makePrimvar("x", Interpolation::Vertex, 1, x));
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
    Mesh mesh;
    mesh.path = "/patch";
    auto patch = std::make_shared<NurbsPatch>();
    patch->u = {3, 2, {0, 0, 1, 2, 2}};
    patch->v = {2, 2, {0, 0, 1, 1}};
    mesh.points =
        std::vector<vec3>{{-1, 0, 0}, {0, 0, 1}, {1, 0, 0}, {-1, 1, 0}, {0, 1, 1}, {1, 1, 0}};
    mesh.patch = patch;
    setNurbsCage(mesh);
    const TriangleMesh drawn = draw(mesh);
    for (size_t t = 0; t < drawn.triangles.size(); ++t) {
        const vec3 n = glm::normalize(triangleCross(drawn, t));
        for (int k = 0; k < 3; ++k)
            EXPECT_LT(glm::distance(drawn.normals[0][drawn.triangles[t][k]], n), 1e-6f);
    }
    EXPECT_EQ(drawn.triangles.size(), 4u);
}

TEST(Patch, staysWithinTheBudget) {
    Diagnostics diagnostics;
    TessellationOptions options;
    options.targetEdge = 1e-6f;
    options.triangleBudget = 5000;
    const Mesh mesh = bicubic(9, 9, [](int, int) { return 0.0f; });
    EXPECT_LE(tessellate(mesh, options, diagnostics).triangles.size(), 5000u);
    EXPECT_EQ(diagnostics.count(), 0);
}

TEST(Patch, badInputIsReportedAndNotDrawn) {
    const auto check = [](const char* input, const auto& change) {
        Mesh mesh = sphere();
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
    check("uKnots",
          [](Mesh&, NurbsPatch& p) { p.u.knots[4] = std::numeric_limits<double>::quiet_NaN(); });
    check("points", [](Mesh& m, NurbsPatch&) { m.points.values[0].pop_back(); });
    check("points", [](Mesh& m, NurbsPatch&) { m.points.values[0][3].x = INFINITY; });
    check("points", [](Mesh& m, NurbsPatch&) { m.points = {}; });
    check("points", [](Mesh&, NurbsPatch& p) {
        p.weights.assign(45, 5e-324); /* their sums underflow */
    });
}

TEST(Patch, badWeightsCountAsOne) {
    Mesh mesh = sphere();
    auto patch = std::make_shared<NurbsPatch>(*mesh.patch);
    patch->weights[7] = -1.0;
    mesh.patch = patch;
    Diagnostics diagnostics;
    EXPECT_FALSE(tessellate(mesh, {}, diagnostics).triangles.empty());
    EXPECT_TRUE(warned(diagnostics, "/patch", "pointWeights"));
}

TEST(Patch, movesWithItsPoints) {
    Mesh mesh = sphere();
    std::vector<vec3> larger = mesh.points.first();
    for (vec3& p : larger)
        p *= 2.0f;
    mesh.points.times = {0.0f, 1.0f};
    mesh.points.values.push_back(larger);
    TessellationOptions options;
    options.shutterClose = 1.0f;
    Diagnostics diagnostics;
    const TriangleMesh drawn = tessellate(mesh, options, diagnostics);
    ASSERT_EQ(drawn.positions.size(), 2u);
    ASSERT_EQ(drawn.normals.size(), 2u);
    EXPECT_NEAR(glm::length(drawn.positions[1][50]), 2.0f, 1e-6f);
    EXPECT_NEAR(drawn.boundsMax.z, 2.0f, 1e-6f);
}

TEST(Patch, otherKnotsAreAnotherShape) {
    const Mesh mesh = sphere();
    Mesh other = mesh;
    EXPECT_TRUE(sameShape(mesh, other));
    auto patch = std::make_shared<NurbsPatch>(*mesh.patch);
    other.patch = patch;
    EXPECT_TRUE(sameShape(mesh, other));
    patch->u.knots[3] = 0.5;
    EXPECT_FALSE(sameShape(mesh, other));
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
    mesh.primvars.push_back(makePrimvar("tet", Interpolation::Uniform, 1, {3, 4}));
    mesh.primvars.push_back(makePrimvar("face", Interpolation::Uniform, 1, {0, 1, 2, 3, 4, 5}));
    mesh.primvars.push_back(makePrimvar("indexed", Interpolation::Uniform, 1, {8, 9}, {1, 0}));
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
