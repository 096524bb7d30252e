// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/geometry/tests/meshFixtures.h"
#include "hdDelegate/geometry/triangulate.h"

#include <algorithm>
#include <numeric>

namespace patina {
namespace {

/// All triangles of a polygon, with its vertices.
std::vector<uvec3> trianglesOf(const std::vector<vec3>& polygon) {
    std::vector<uvec3> triangles;
    triangulatePolygon(polygon.data(), int(polygon.size()), triangles);
    EXPECT_EQ(triangles.size(), polygon.size() - 2);
    for (const uvec3& t : triangles)
        EXPECT_LT(std::max({t.x, t.y, t.z}), polygon.size());
    return triangles;
}

/// Areas of a triangulation: sum, and the smallest along the polygon's normal.
void expectFillsPolygon(const std::vector<vec3>& polygon) {
    const std::vector<uvec3> triangles = trianglesOf(polygon);
    const vec3 normal = newellNormal(polygon.data(), int(polygon.size()));
    float sum = 0.0f;
    for (const uvec3& t : triangles) {
        const float area =
            glm::dot(glm::cross(polygon[t.y] - polygon[t.x], polygon[t.z] - polygon[t.x]),
                     glm::normalize(normal));
        EXPECT_GE(area, -1e-5f) << "a triangle outside the polygon";
        sum += area;
    }
    EXPECT_NEAR(sum, glm::length(normal), 1e-4f * glm::length(normal));
}

TEST(Triangulation, concavePolygonsAreFilledWithoutOverlap) {
    expectFillsPolygon({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, 1, 0}, {0, 4, 0}});
    expectFillsPolygon(
        {{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {2, 3, 0}, {2, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}});
    // The same L upside down and in another plane.
    expectFillsPolygon({{0, 0, 0}, {0, 2, 0}, {0, 2, 1}, {0, 1, 1}, {0, 1, 2}, {0, 0, 2}});
    expectFillsPolygon({{0, 0, 2}, {0, 1, 2}, {0, 1, 1}, {0, 2, 1}, {0, 2, 0}, {0, 0, 0}});
}

TEST(Triangulation, starsAndCombsOfManyCorners) {
    std::vector<vec3> star, comb;
    for (int i = 0; i < 200; ++i) {
        const float phi = 6.2831853f * float(i) / 200, r = i % 2 ? 1.0f : 3.0f;
        star.push_back(vec3(r * std::cos(phi), r * std::sin(phi), 0.5f * r * std::cos(phi)));
    }
    expectFillsPolygon(star);
    for (int i = 0; i < 50; ++i) {
        comb.push_back(vec3(2 * i, 0, 0));
        comb.push_back(vec3(2 * i + 1, i % 2 ? 5 : 1, 0));
    }
    comb.push_back(vec3(100, -1, 0));
    comb.push_back(vec3(-1, -1, 0));
    std::reverse(comb.begin(), comb.end());
    expectFillsPolygon(comb);
}

TEST(Triangulation, concaveQuadsAreCutFromTheirReflexCorner) {
    for (int shift = 0; shift < 4; ++shift) {
        std::vector<vec3> dart = {{0, 0, 0}, {4, 0, 0}, {1, 1, 0}, {0, 4, 0}};
        std::rotate(dart.begin(), dart.begin() + shift, dart.end());
        expectFillsPolygon(dart);
    }
}

TEST(Triangulation, degeneratePolygonsStillGiveAllTriangles) {
    const std::vector<vec3> point(7, vec3(1, 2, 3));
    std::vector<vec3> line, bowtie = {{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0.5f, 0}};
    for (int i = 0; i < 9; ++i)
        line.push_back(vec3(i % 5, 0, 0));
    for (const auto& polygon : {point, line, bowtie})
        trianglesOf(polygon);
}

TEST(Triangulation, hugePolygonsEnd) {
    std::vector<vec3> zigzag;
    const int n = 40000;
    for (int i = 0; i < n; ++i) {
        const float phi = 6.2831853f * float(i) / n, r = i % 2 ? 1.0f : 1.01f;
        zigzag.push_back(vec3(r * std::cos(phi), r * std::sin(phi), 0));
    }
    trianglesOf(zigzag);
}

TEST(Triangulation, polygonsThatCrossThemselvesEnd) {
    // Found by review: an ear was looked for at each corner for each triangle.
    const vec3 places[5] = {{-3, -1, 0}, {2, -1, 0}, {-1, 3, 0}, {0, 3, 0}, {-3, -1, 0}};
    std::vector<vec3> star;
    for (int i = 0; i + 1 < maxEarClipping; ++i)
        star.push_back(places[i % 5]);
    star.push_back({1.5f, -1, 0});
    trianglesOf(star);
}

TEST(Polygons, cubeFacesOut) {
    const TriangleMesh mesh = draw(cubeMesh());
    EXPECT_EQ(mesh.triangles.size(), 12u);
    EXPECT_NEAR(volume(mesh), 8.0, 1e-5);
    EXPECT_TRUE(mesh.normals.empty()) << "polygons without normals are flat";
    EXPECT_EQ(mesh.boundsMin, vec3(-1));
    EXPECT_EQ(mesh.boundsMax, vec3(1));
    EXPECT_EQ(mesh.triangleFace[2], 1);
    EXPECT_TRUE(mesh.triangleSubset.empty());
}

TEST(Polygons, leftHandedTurnsTheWindingOnly) {
    Mesh cube = cubeMesh();
    cube.leftHanded = true;
    std::vector<float> corner(24);
    std::iota(corner.begin(), corner.end(), 0.0f);
    cube.primvars = {makePrimvar("normals", Interpolation::FaceVarying, 3,
                                 numbersOf(std::vector<vec3>(24, vec3(0, 0, 1)))),
                     makePrimvar("corner", Interpolation::FaceVarying, 1, corner)};
    const TriangleMesh mesh = draw(cube);
    EXPECT_NEAR(volume(mesh), -8.0, 1e-5);
    EXPECT_EQ(cornerNormal(mesh, 0, 0), vec3(0, 0, 1)) << "authored normals are taken as they are";
    const MeshAttribute* attribute = mesh.attribute("corner");
    for (size_t t = 0; t < mesh.triangles.size(); ++t)
        for (int k = 0; k < 3; ++k)
            EXPECT_EQ(cube.faceVertexIndices[int(attribute->data[3 * t + k])],
                      int(mesh.triangles[t][k]))
                << "values turn with the corners";
}

TEST(Polygons, normalsOfEveryInterpolation) {
    const std::vector<vec3> points = cubeMesh().points.first();
    const std::vector<float> vertex = numbersOf(points), // of any length
        face = {1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1};
    for (auto interpolation : {Interpolation::Vertex, Interpolation::Varying}) {
        Mesh cube = cubeMesh();
        cube.primvars = {makePrimvar("normals", interpolation, 3, vertex)};
        const TriangleMesh mesh = draw(cube);
        ASSERT_EQ(mesh.normalRate, MeshAttribute::Rate::PerVertex);
        for (int i = 0; i < 8; ++i)
            EXPECT_LT(glm::length(mesh.normals[0][i] - glm::normalize(points[i])), 1e-6f);
        EXPECT_EQ(mesh.attribute("normals"), nullptr);
    }
    Mesh cube = cubeMesh();
    cube.primvars = {makePrimvar("normals", Interpolation::Uniform, 3, face)};
    const TriangleMesh uniform = draw(cube);
    std::vector<int> indices;
    for (int c = 0; c < 24; ++c)
        indices.push_back(c / 4);
    cube.primvars = {makePrimvar("normals", Interpolation::FaceVarying, 3, face, indices)};
    const TriangleMesh corners = draw(cube);
    for (size_t t = 0; t < 12; ++t)
        for (int k = 0; k < 3; ++k) {
            const vec3 n = glm::normalize(triangleCross(uniform, t));
            EXPECT_LT(glm::length(cornerNormal(uniform, t, k) - n), 1e-6f);
            EXPECT_LT(glm::length(cornerNormal(corners, t, k) - n), 1e-6f);
        }
    cube.primvars = {makePrimvar("normals", Interpolation::Constant, 3, {0, 3, 0})};
    EXPECT_EQ(cornerNormal(draw(cube), 5, 1), vec3(0, 1, 0));
}

TEST(Polygons, holesAndSubsets) {
    Mesh cube = cubeMesh();
    cube.holeIndices = {5};
    cube.subsets = {{"/cube/a", "", {0, 2}}, {"/cube/b", "", {4}}};
    const TriangleMesh mesh = draw(cube);
    EXPECT_EQ(mesh.triangles.size(), 10u);
    EXPECT_EQ(mesh.triangleSubset, (std::vector<uint16_t>{1, 1, 0, 0, 1, 1, 0, 0, 2, 2}));
}

TEST(Polygons, primvarsOfEveryInterpolation) {
    Mesh grid = gridMesh(2);
    std::vector<float> ramp9(9), ramp16(16);
    std::iota(ramp9.begin(), ramp9.end(), 0.0f);
    std::iota(ramp16.begin(), ramp16.end(), 0.0f);
    grid.primvars = {makePrimvar("c", Interpolation::Constant, 2, {5, 6}),
                     makePrimvar("u", Interpolation::Uniform, 1, {7, 8}, {0, 1, 1, 0}),
                     makePrimvar("v", Interpolation::Vertex, 1, ramp9),
                     makePrimvar("y", Interpolation::Varying, 1, ramp9),
                     makePrimvar("f", Interpolation::FaceVarying, 1, ramp16)};
    const TriangleMesh mesh = draw(grid);
    ASSERT_EQ(mesh.attributes.size(), 5u);
    EXPECT_EQ(mesh.attribute("c")->rate, MeshAttribute::Rate::Constant);
    EXPECT_EQ(mesh.attribute("c")->data, (std::vector<float>{5, 6}));
    EXPECT_EQ(mesh.attribute("u")->data, (std::vector<float>{7, 8, 8, 7}));
    EXPECT_EQ(mesh.attribute("v")->data, ramp9);
    EXPECT_EQ(mesh.attribute("y")->rate, MeshAttribute::Rate::PerVertex);
    const MeshAttribute* f = mesh.attribute("f");
    for (size_t t = 0; t < mesh.triangles.size(); ++t)
        for (int k = 0; k < 3; ++k)
            EXPECT_EQ(grid.faceVertexIndices[int(f->data[3 * t + k])], int(mesh.triangles[t][k]));
}

TEST(Polygons, motionIsResampledOverTheShutter) {
    Mesh grid = gridMesh(1);
    grid.points.times = {-1, 0, 1};
    const std::vector<vec3> rest = grid.points.first();
    grid.points.values.clear();
    for (float height : {4.0f, 0.0f, 2.0f}) {
        grid.points.values.push_back(rest);
        for (vec3& p : grid.points.values.back())
            p.z = height;
    }
    EXPECT_EQ(draw(grid).positions.size(), 1u);
    EXPECT_EQ(draw(grid).positions[0][0].z, 0.0f);
    const TriangleMesh centred = draw(grid, shutter(-0.5f, 0.5f));
    ASSERT_EQ(centred.positions.size(), 3u) << "the sample at 0 falls on a step";
    EXPECT_FLOAT_EQ(centred.positions[0][0].z, 2.0f);
    EXPECT_FLOAT_EQ(centred.positions[1][0].z, 0.0f);
    EXPECT_FLOAT_EQ(centred.positions[2][0].z, 1.0f);
    EXPECT_EQ(centred.boundsMax.z, 2.0f);
    EXPECT_EQ(draw(grid, shutter(0.25f, 0.75f)).positions.size(), 2u);
    const TriangleMesh after = draw(grid, shutter(2, 3));
    EXPECT_EQ(after.positions.size(), 1u);
    EXPECT_EQ(after.positions[0][0].z, 2.0f);
}

} // namespace
} // namespace patina
