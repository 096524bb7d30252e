// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/geometry/tests/meshFixtures.h"

#include <algorithm>
#include <numeric>

namespace patina {
namespace {

TriangleMesh refine(Mesh mesh, int level, Diagnostics& diagnostics) {
    mesh.refineLevel = level;
    return tessellate(mesh, {}, diagnostics);
}

TriangleMesh refine(const Mesh& mesh, int level) {
    Diagnostics diagnostics;
    TriangleMesh result = refine(mesh, level, diagnostics);
    expectSilence(diagnostics);
    return result;
}

Mesh smoothCube() {
    return cubeMesh(SubdivisionScheme::CatmullClark);
}

/// Edges of full sharpness, each list along one line of points.
void crease(Mesh& mesh, std::vector<int> indices, std::vector<int> lengths) {
    mesh.creaseIndices = std::move(indices);
    mesh.creaseSharpnesses.assign(lengths.size(), 10.0f);
    mesh.creaseLengths = std::move(lengths);
}

bool hasPoint(const TriangleMesh& mesh, const vec3& point, float tolerance = 1e-5f) {
    for (const vec3& p : mesh.positions[0])
        if (glm::length(p - point) < tolerance) return true;
    return false;
}

TEST(Subdivision, catmullClarkCubeHasItsClosedLimitPoints) {
    // Halstead, Kass and DeRose 1993: the limit of a vertex of valence n is
    // (n^2 v + 4 sum of edge neighbours + sum of face diagonals) / (n (n + 5)).
    // For the cube: (9 + 4 - 1) / 24 = 1/2 in each coordinate.
    const TriangleMesh mesh = refine(smoothCube(), 3);
    EXPECT_EQ(mesh.triangles.size(), 6u * 64 * 2);
    for (int i = 0; i < 8; ++i)
        EXPECT_TRUE(hasPoint(mesh, 0.5f * vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1)));
    // A face point (1,0,0) after one step is regular: it is surrounded by edge points at 3/4 of
    // (1,1,0) and corner points at 5/9 of (1,1,1), so x = (16 + 4 * 4 * 3/4 + 4 * 5/9) / 36.
    EXPECT_TRUE(hasPoint(mesh, vec3((16.0f + 12.0f + 20.0f / 9.0f) / 36.0f, 0, 0)));
}

TEST(Subdivision, everyLevelLiesOnTheSameLimitSurface) {
    const TriangleMesh coarse = refine(smoothCube(), 1);
    const TriangleMesh fine = refine(smoothCube(), 3);
    for (const vec3& p : coarse.positions[0])
        EXPECT_TRUE(hasPoint(fine, p)) << p.x << " " << p.y << " " << p.z;
}

TEST(Subdivision, limitNormalsPointOutAndMatchTheGeometry) {
    for (auto scheme : {SubdivisionScheme::CatmullClark, SubdivisionScheme::Loop}) {
        const TriangleMesh mesh = refine(
            scheme == SubdivisionScheme::Loop ? tetrahedronMesh(scheme) : cubeMesh(scheme), 4);
        ASSERT_FALSE(mesh.normals.empty());
        EXPECT_GT(volume(mesh), 0.0);
        expectNormalsAlongTriangles(mesh, 0.97f);
    }
}

TEST(Subdivision, fullySharpCubeStaysACube) {
    Mesh cube = smoothCube();
    crease(cube, {0, 1, 3, 2, 0, 4, 5, 7, 6, 4, 0, 4, 1, 5, 3, 7, 2, 6}, {5, 5, 2, 2, 2, 2});
    const TriangleMesh mesh = refine(cube, 3);
    EXPECT_NEAR(surfaceArea(mesh), 24.0, 1e-4);
    EXPECT_NEAR(volume(mesh), 8.0, 1e-4);
    // Normals are those of the flat faces, on both sides of each crease.
    expectNormalsAlongTriangles(mesh, 0.9999f);
}

TEST(Subdivision, sharpCornersAreInterpolated) {
    Mesh cube = smoothCube();
    cube.cornerIndices = {7};
    cube.cornerSharpnesses = {10};
    const TriangleMesh mesh = refine(cube, 2);
    EXPECT_TRUE(hasPoint(mesh, vec3(1, 1, 1)));
    EXPECT_FALSE(hasPoint(mesh, vec3(-1, -1, -1), 0.3f));
}

TEST(Subdivision, holesShapeTheSurfaceButAreNotDrawn) {
    Mesh cube = smoothCube();
    const TriangleMesh whole = refine(cube, 2);
    cube.holeIndices = {4};
    const TriangleMesh mesh = refine(cube, 2);
    EXPECT_EQ(mesh.triangles.size(), whole.triangles.size() * 5 / 6);
    EXPECT_EQ(std::count(mesh.triangleFace.begin(), mesh.triangleFace.end(), 4), 0);
    for (const vec3& p : mesh.positions[0])
        EXPECT_TRUE(hasPoint(whole, p));
}

TEST(Subdivision, loopOnATetrahedronHasItsClosedLimitPoints) {
    // Loop 1987: beta(3) = 3/16; limit weight of a neighbour 1 / (3/(8 beta) + 3) = 1/5.
    // v * (1 - 3/5) + sum of the others / 5 = v * 2/5 - v / 5 = v / 5.
    const TriangleMesh mesh = refine(tetrahedronMesh(SubdivisionScheme::Loop), 2);
    EXPECT_EQ(mesh.triangles.size(), 4u * 16);
    EXPECT_TRUE(hasPoint(mesh, vec3(0.2f)));
    EXPECT_TRUE(hasPoint(mesh, 0.2f * vec3(-1, -1, 1)));
}

TEST(Subdivision, loopWithQuadsFallsBackToCatmullClark) {
    Diagnostics diagnostics;
    const TriangleMesh mesh = refine(cubeMesh(SubdivisionScheme::Loop), 2, diagnostics);
    EXPECT_TRUE(warned(diagnostics, "/cube", "subdivisionScheme"));
    EXPECT_TRUE(hasPoint(mesh, vec3(0.5f)));
}

TEST(Subdivision, bilinearKeepsTheShapeAndIsFlat) {
    const TriangleMesh mesh = refine(cubeMesh(SubdivisionScheme::Bilinear), 2);
    EXPECT_EQ(mesh.triangles.size(), 6u * 16 * 2);
    EXPECT_NEAR(surfaceArea(mesh), 24.0, 1e-4);
    EXPECT_TRUE(mesh.normals.empty());
}

TEST(Subdivision, levelZeroIsTheCageWithSmoothNormals) {
    const TriangleMesh mesh = refine(smoothCube(), 0);
    EXPECT_EQ(mesh.triangles.size(), 12u);
    EXPECT_NEAR(
        glm::dot(cornerNormal(mesh, 0, 0), glm::normalize(mesh.positions[0][mesh.triangles[0].x])),
        1.0f, 1e-5f);
}

TEST(Subdivision, boundaryRules) {
    Mesh grid = gridMesh(3, SubdivisionScheme::CatmullClark);
    EXPECT_NEAR(surfaceArea(refine(grid, 2)), 1.0, 1e-5) << "corners are kept";
    grid.interpolateBoundary = "edgeOnly";
    const double rounded = surfaceArea(refine(grid, 2));
    EXPECT_LT(rounded, 0.99);
    EXPECT_GT(rounded, 0.9);
    grid.interpolateBoundary = "none";
    EXPECT_NEAR(surfaceArea(refine(grid, 2)), 1.0 / 9.0, 1e-5) << "faces at the boundary vanish";
    Diagnostics diagnostics;
    grid.interpolateBoundary = "sideways";
    EXPECT_NEAR(surfaceArea(refine(grid, 2, diagnostics)), 1.0, 1e-5);
    EXPECT_TRUE(warned(diagnostics, "/grid", "interpolateBoundary"));
}

TEST(Subdivision, triangleRuleMatters) {
    Mesh mesh = tetrahedronMesh(SubdivisionScheme::CatmullClark);
    const double plain = volume(refine(mesh, 3));
    mesh.triangleSubdivisionRule = "smooth";
    EXPECT_GT(std::abs(volume(refine(mesh, 3)) - plain), 1e-3);
}

TEST(Subdivision, uniformPrimvarsAndSubsetsStayOnTheirFace) {
    Mesh cube = smoothCube();
    cube.primvars.push_back(makePrimvar("id", Interpolation::Uniform, 1, {0, 10, 20, 30, 40, 50}));
    cube.subsets = {{"/cube/top", "/m", {4}}, {"/cube/sides", "/n", {0, 1}}};
    const TriangleMesh mesh = refine(cube, 2);
    const MeshAttribute* id = mesh.attribute("id");
    ASSERT_NE(id, nullptr);
    EXPECT_EQ(id->rate, MeshAttribute::Rate::PerFace);
    std::vector<int> triangles(6);
    for (size_t t = 0; t < mesh.triangles.size(); ++t) {
        const int face = mesh.triangleFace[t];
        ++triangles[face];
        EXPECT_EQ(id->data[face], 10.0f * face);
        EXPECT_EQ(mesh.triangleSubset[t], face == 4 ? 1 : face < 2 ? 2 : 0);
        // The face that a triangle came from is the one that its normal points along.
        const vec3 n = triangleCross(mesh, t);
        const vec3 expected((face == 0) - (face == 1), (face == 2) - (face == 3),
                            (face == 4) - (face == 5));
        EXPECT_GT(glm::dot(n, expected), 0.0f);
    }
    EXPECT_EQ(triangles, std::vector<int>(6, 32));
}

TEST(Subdivision, vertexPrimvarsMoveLikePointsAndVaryingOnesLinearly) {
    Mesh cube = smoothCube();
    const std::vector<float> rest = numbersOf(cube.points.first());
    cube.primvars = {makePrimvar("rest", Interpolation::Vertex, 3, rest),
                     makePrimvar("linear", Interpolation::Varying, 3, rest)};
    const TriangleMesh mesh = refine(cube, 2);
    const MeshAttribute *vertex = mesh.attribute("rest"), *varying = mesh.attribute("linear");
    ASSERT_TRUE(vertex && varying);
    float largest = 0.0f;
    for (size_t i = 0; i < mesh.positions[0].size(); ++i) {
        const vec3 p = mesh.positions[0][i];
        const vec3 v(vertex->data[3 * i], vertex->data[3 * i + 1], vertex->data[3 * i + 2]);
        const vec3 l(varying->data[3 * i], varying->data[3 * i + 1], varying->data[3 * i + 2]);
        EXPECT_LT(glm::length(v - p), 1e-5f);
        largest = std::max(largest, glm::length(l));
        const vec3 a = glm::abs(l);
        EXPECT_NEAR(std::max({a.x, a.y, a.z}), 1.0f, 1e-6f) << "on the cube itself";
    }
    EXPECT_NEAR(largest, std::sqrt(3.0f), 1e-5f);
}

/// Two quads side by side, with st that is continuous or torn at the edge between them.
TriangleMesh stripWithSt(bool seam, const std::string& rule) {
    Mesh mesh = gridMesh(2, SubdivisionScheme::CatmullClark);
    mesh.faceVaryingLinearInterpolation = rule;
    std::vector<float> st;
    for (size_t c = 0; c < mesh.faceVertexIndices.size(); ++c) {
        const vec3 p = mesh.points.first()[mesh.faceVertexIndices[c]];
        const bool right = (c / 4) % 2 == 1;
        st.push_back(p.x + (seam && right ? 10.0f : 0.0f));
        st.push_back(p.y * p.y);
    }
    mesh.primvars.push_back(makePrimvar("st", Interpolation::FaceVarying, 2, st));
    return refine(mesh, 3);
}

TEST(Subdivision, faceVaryingSeamsStayWhereValuesDiffer) {
    const TriangleMesh torn = stripWithSt(true, "cornersPlus1");
    const MeshAttribute* st = torn.attribute("st");
    ASSERT_NE(st, nullptr);
    ASSERT_EQ(st->rate, MeshAttribute::Rate::PerCorner);
    ASSERT_EQ(st->data.size(), torn.triangles.size() * 6);
    bool left = false, right = false;
    for (size_t t = 0; t < torn.triangles.size(); ++t)
        for (int k = 0; k < 3; ++k) {
            const vec3 p = torn.positions[0][torn.triangles[t][k]];
            const float s = st->data[(3 * t + k) * 2];
            const bool rightFace = torn.triangleFace[t] % 2 == 1;
            EXPECT_NEAR(s, p.x + (rightFace ? 10.0f : 0.0f), 1e-4f)
                << "no value between the charts";
            if (std::abs(p.x - 0.5f) < 1e-5f) (rightFace ? right : left) = true;
        }
    EXPECT_TRUE(left && right) << "both values stand at the seam";
}

TEST(Subdivision, faceVaryingIsSmoothWithoutASeamUnlessTheRuleSaysLinear) {
    // t is the square of y at three heights 0, 0.25, 1. Linear in each face: 0.125 at y = 1/4.
    const auto valueAt = [](const TriangleMesh& mesh, float y) {
        const MeshAttribute* st = mesh.attribute("st");
        for (size_t t = 0; t < mesh.triangles.size(); ++t)
            for (int k = 0; k < 3; ++k) {
                const vec3 p = mesh.positions[0][mesh.triangles[t][k]];
                if (std::abs(p.y - y) < 1e-5f && std::abs(p.x - 0.25f) < 1e-5f)
                    return st->data[(3 * t + k) * 2 + 1];
            }
        return -1.0f;
    };
    EXPECT_NEAR(valueAt(stripWithSt(false, "all"), 0.25f), 0.125f, 1e-5f);
    const float smooth = valueAt(stripWithSt(false, "cornersPlus1"), 0.25f);
    EXPECT_GT(std::abs(smooth - 0.125f), 1e-3f);
    EXPECT_GT(smooth, 0.0f);
}

TEST(Subdivision, indexedFaceVaryingEqualsTheExpandedOne) {
    Mesh flat = smoothCube(), indexed = flat;
    const std::vector<float> corners = {0, 0, 1, 0, 1, 1, 0, 1};
    std::vector<float> expanded;
    std::vector<int> indices;
    for (int f = 0; f < 6; ++f)
        for (int k = 0; k < 4; ++k) {
            indices.push_back(k);
            expanded.insert(expanded.end(), {corners[2 * k], corners[2 * k + 1]});
        }
    flat.primvars.push_back(makePrimvar("st", Interpolation::FaceVarying, 2, expanded));
    indexed.primvars.push_back(makePrimvar("st", Interpolation::FaceVarying, 2, corners, indices));
    EXPECT_EQ(refine(flat, 2).attribute("st")->data, refine(indexed, 2).attribute("st")->data);
}

TEST(Subdivision, indicesMakeSeamsOfEqualValues) {
    // Values one index for each corner: seams everywhere, so that each face interpolates alone.
    Mesh welded = gridMesh(2, SubdivisionScheme::CatmullClark);
    welded.faceVaryingLinearInterpolation = "cornersPlus1";
    std::vector<float> squares;
    for (const int point : welded.faceVertexIndices) {
        const float y = welded.points.first()[size_t(point)].y;
        squares.push_back(y * y);
    }
    Mesh torn = welded;
    std::vector<int> own(squares.size());
    std::iota(own.begin(), own.end(), 0);
    torn.primvars = {makePrimvar("t", Interpolation::FaceVarying, 1, squares, own)};
    Mesh linear = welded;
    linear.faceVaryingLinearInterpolation = "all";
    welded.primvars = linear.primvars = {makePrimvar("t", Interpolation::FaceVarying, 1, squares)};
    const auto dataOf = [](const Mesh& mesh) { return refine(mesh, 2).attribute("t")->data; };
    const std::vector<float> seams = dataOf(torn), flat = dataOf(linear), smooth = dataOf(welded);
    float apart = 0.0f;
    for (size_t i = 0; i < seams.size(); ++i) {
        EXPECT_NEAR(seams[i], flat[i], 1e-6f);
        apart = std::max(apart, std::abs(smooth[i] - flat[i]));
    }
    EXPECT_GT(apart, 1e-2f);
}

TEST(Subdivision, leftHandedTurnsWindingAndNormals) {
    Mesh cube = smoothCube();
    const double right = volume(refine(cube, 2));
    cube.leftHanded = true;
    const TriangleMesh mesh = refine(cube, 2);
    EXPECT_NEAR(volume(mesh), -right, 1e-5);
    for (size_t t = 0; t < mesh.triangles.size(); ++t)
        EXPECT_GT(glm::dot(cornerNormal(mesh, t, 0), triangleCross(mesh, t)), 0.0f);
    crease(cube, {0, 1, 3, 2, 0}, {5});
    const TriangleMesh creased = refine(cube, 3);
    EXPECT_EQ(creased.normalRate, MeshAttribute::Rate::PerCorner);
    expectNormalsAlongTriangles(creased, 0.9f);
}

TEST(Subdivision, levelFollowsTheTargetEdge) {
    const Mesh cube = smoothCube();
    EXPECT_EQ(draw(cube, 2.0f).refineLevel, 0);
    EXPECT_EQ(draw(cube, 0.5f).refineLevel, 2);
    EXPECT_EQ(draw(cube, 1e-6f).refineLevel, 6);
    TessellationOptions options;
    options.targetEdge = 1e-6f;
    options.triangleBudget = 1000;
    const TriangleMesh cut = draw(cube, options);
    EXPECT_LE(cut.triangles.size(), 1000u);
    EXPECT_EQ(cut.refineLevel, 3);
    options.maxRefineLevel = 1;
    EXPECT_EQ(draw(cube, options).refineLevel, 1);
    EXPECT_EQ(draw(cubeMesh(SubdivisionScheme::Bilinear), 0.1f).refineLevel, 0) << "flat";
}

TEST(Subdivision, edgesRefineWithinTheirBudgetAndLevelsBeyondIt) {
    Mesh cube = smoothCube();
    TessellationOptions options;
    options.targetEdge = 1e-6f;
    options.edgeBudget = 1000; // 768 at level 3
    EXPECT_EQ(draw(cube, options).refineLevel, 3);
    cube.refineLevel = 4;
    EXPECT_EQ(draw(cube, options).refineLevel, 4);
}

TEST(Subdivision, hugeLevelIsCutAndReported) {
    Diagnostics diagnostics;
    const TriangleMesh mesh = refine(smoothCube(), 1000000, diagnostics);
    EXPECT_EQ(mesh.refineLevel, 6);
    EXPECT_TRUE(warned(diagnostics, "/cube", "refineLevel"));
}

TEST(Subdivision, motionStepsAreRefinedAlike) {
    Mesh cube = smoothCube();
    movePoints(cube, [](const vec3& p) { return p * 2.0f + vec3(3, 0, 0); });
    cube.refineLevel = 2;
    const TriangleMesh mesh = draw(cube, shutter(0, 0.5f));
    ASSERT_EQ(mesh.positions.size(), 2u);
    ASSERT_EQ(mesh.normals.size(), 2u);
    for (size_t i = 0; i < mesh.positions[0].size(); ++i) {
        EXPECT_LT(
            glm::length(mesh.positions[1][i] - (mesh.positions[0][i] * 1.5f + vec3(1.5f, 0, 0))),
            1e-5f);
        EXPECT_LT(glm::length(mesh.normals[1][i] - mesh.normals[0][i]), 1e-4f);
    }
}

} // namespace
} // namespace patina
