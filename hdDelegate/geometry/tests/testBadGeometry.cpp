// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/geometry/tests/meshFixtures.h"

#include <random>

namespace patina {
namespace {

/// Every number in range and finite.
void expectSane(const TriangleMesh& mesh) {
    ASSERT_FALSE(mesh.positions.empty());
    const size_t n = mesh.positions[0].size(), triangles = mesh.triangles.size();
    for (const auto& step : mesh.positions) {
        ASSERT_EQ(step.size(), n);
        for (const vec3& p : step)
            ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
    }
    ASSERT_EQ(mesh.triangleFace.size(), triangles);
    for (const uvec3& t : mesh.triangles)
        ASSERT_LT(std::max({t.x, t.y, t.z}), n);
    for (const auto& step : mesh.normals)
        for (const vec3& normal : step)
            ASSERT_NEAR(glm::length(normal), 1.0f, 1e-3f);
    for (const MeshAttribute& a : mesh.attributes)
        for (float value : a.data)
            ASSERT_TRUE(std::isfinite(value)) << a.name;
}

TriangleMesh drawBad(const Mesh& mesh, Diagnostics& diagnostics) {
    TriangleMesh result = tessellate(mesh, {}, diagnostics);
    expectSane(result);
    return result;
}

class BadMesh : public testing::TestWithParam<SubdivisionScheme> {
protected:
    Mesh cube() const {
        Mesh mesh = cubeMesh(GetParam());
        mesh.refineLevel = 2;
        return mesh;
    }
    /// Authored faces that are drawn.
    static size_t facesOf(const TriangleMesh& mesh) {
        std::vector<int> faces = mesh.triangleFace;
        std::sort(faces.begin(), faces.end());
        return size_t(std::unique(faces.begin(), faces.end()) - faces.begin());
    }
    Diagnostics diagnostics;
};

TEST_P(BadMesh, facesThatDoNotFitAreDropped) {
    const struct {
        const char* input;
        size_t left;
        void (*change)(Mesh&);
    } cases[] = {
        {"faceVertexIndices", 4,
         [](Mesh& m) { m.faceVertexIndices[1] = 8, m.faceVertexIndices[6] = -1; }},
        {"faceVertexIndices", 5, [](Mesh& m) { m.faceVertexIndices.resize(22); }},
        {"faceVertexIndices", 6, [](Mesh& m) { m.faceVertexIndices.push_back(0); }},
        {"faceVertexCounts", 5,
         [](Mesh& m) {
             m.faceVertexCounts = {2, 2, 4, 4, 4, 4, 4, 0, -5, 1};
             m.faceVertexIndices.push_back(3);
         }},
        {"points", 0, [](Mesh& m) { m.points = Sampled<std::vector<vec3>>(); }},
        {"points", 0, [](Mesh& m) { m.points = std::vector<vec3>(); }},
        {"faceVertexCounts", 0,
         [](Mesh& m) { m.faceVertexCounts.clear(), m.faceVertexIndices.clear(); }},
    };
    for (const auto& c : cases) {
        SCOPED_TRACE(std::string(c.input) + " leaves " + std::to_string(c.left));
        Mesh mesh = cube();
        c.change(mesh);
        diagnostics.clear();
        EXPECT_EQ(facesOf(drawBad(mesh, diagnostics)), c.left);
        EXPECT_TRUE(warned(diagnostics, "/cube", c.input));
        if (c.left == 4) {
            EXPECT_NE(diagnostics.all()[0].message.find("2 faces"), std::string::npos);
        }
    }
}

TEST_P(BadMesh, pointsThatAreNotFiniteDropTheirFaces) {
    for (float bad : {nan, inf, -inf, 1e16f, -1e30f}) { // rays cannot follow those beyond 1e15
        Mesh mesh = cube();
        mesh.points.values[0][7].y = bad;
        diagnostics.clear();
        EXPECT_EQ(facesOf(drawBad(mesh, diagnostics)), 3u);
        EXPECT_TRUE(warned(diagnostics, "/cube", "points"));
    }
}

TEST_P(BadMesh, primvarsThatDoNotFitAreIgnoredByName) {
    for (auto interpolation :
         {Interpolation::Constant, Interpolation::Uniform, Interpolation::Varying,
          Interpolation::Vertex, Interpolation::FaceVarying}) {
        Mesh mesh = cube();
        mesh.primvars = {makePrimvar("empty", interpolation, 2, {}),
                         makePrimvar("odd", interpolation, 17, std::vector<float>(17 * 24)),
                         makePrimvar("none", interpolation, 0, {1}),
                         makePrimvar("normals", interpolation, 3, {}),
                         makePrimvar("good", Interpolation::Constant, 1, {1})};
        if (interpolation != Interpolation::Constant)
            mesh.primvars.push_back(makePrimvar("long", interpolation, 1, std::vector<float>(25)));
        diagnostics.clear();
        const TriangleMesh result = drawBad(mesh, diagnostics);
        EXPECT_EQ(result.attributes.size(), 1u);
        EXPECT_TRUE(warned(diagnostics, "/cube", "primvars:empty"));
        EXPECT_TRUE(warned(diagnostics, "/cube", "primvars:odd"));
        EXPECT_TRUE(warned(diagnostics, "/cube", "primvars:none"));
        EXPECT_EQ(interpolation != Interpolation::Constant,
                  warned(diagnostics, "/cube", "primvars:long"));
    }
}

TEST_P(BadMesh, primvarIndicesAndValues) {
    Mesh mesh = cube();
    mesh.primvars = {makePrimvar("indexed", Interpolation::Uniform, 1, {4, 5}, {0, 1, 2, -1, 1, 0}),
                     makePrimvar("holes", Interpolation::Vertex, 1, {nan, 1, inf, 1, 1, 1, 1, 1})};
    const TriangleMesh result = drawBad(mesh, diagnostics);
    EXPECT_EQ(result.attribute("indexed")->data, (std::vector<float>{4, 5, 0, 0, 5, 4}));
    EXPECT_TRUE(warned(diagnostics, "/cube", "primvars:indexed"));
    EXPECT_TRUE(warned(diagnostics, "/cube", "primvars:holes"));
}

TEST_P(BadMesh, holesAndSubsetsOutOfRange) {
    Mesh mesh = cube();
    mesh.holeIndices = {-1, 6, 2};
    mesh.subsets = {{"/cube/s", "", {-1, 0, 6, 1000}}, {"/cube/t", "", {0, 1}}};
    EXPECT_EQ(facesOf(drawBad(mesh, diagnostics)), 5u);
    EXPECT_TRUE(warned(diagnostics, "/cube", "holeIndices"));
    EXPECT_TRUE(warned(diagnostics, "/cube/s", "indices"));
    EXPECT_TRUE(warned(diagnostics, "/cube/t", "indices")) << "face 0 is in both";
}

TEST_P(BadMesh, motionSamplesThatDoNotFit) {
    Mesh mesh = cube();
    mesh.points.times = {0, 1};
    mesh.points.values.push_back({vec3(0)});
    const TessellationOptions options = shutter(0, 1);
    const TriangleMesh result = tessellate(mesh, options, diagnostics);
    expectSane(result);
    EXPECT_EQ(facesOf(result), 6u);
    EXPECT_TRUE(warned(diagnostics, "/cube", "points"));
    mesh.points.times = {1, 1};
    mesh.points.values[1] = mesh.points.values[0];
    diagnostics.clear();
    expectSane(tessellate(mesh, options, diagnostics));
    EXPECT_TRUE(warned(diagnostics, "/cube", "points"));
}

TEST_P(BadMesh, zeroNormalsAreRepaired) {
    Mesh mesh = cube();
    mesh.scheme = SubdivisionScheme::None;
    for (const auto& [interpolation, n] : {std::pair{Interpolation::Vertex, 8},
                                           {Interpolation::Uniform, 6},
                                           {Interpolation::FaceVarying, 24}}) {
        mesh.primvars = {makePrimvar("normals", interpolation, 3, std::vector<float>(3 * n, 0.0f))};
        diagnostics.clear();
        const TriangleMesh result = drawBad(mesh, diagnostics);
        EXPECT_TRUE(warned(diagnostics, "/cube", "normals"));
        for (size_t t = 0; t < result.triangles.size(); ++t)
            EXPECT_GT(glm::dot(cornerNormal(result, t, 0), triangleCross(result, t)), 0.0f);
    }
}

TEST_P(BadMesh, randomGarbageNeverCrashes) {
    std::mt19937 random(20240607);
    const auto integer = [&](int low, int high) {
        return std::uniform_int_distribution<int>(low, high)(random);
    };
    for (int round = 0; round < 300; ++round) {
        Mesh mesh;
        mesh.path = "/garbage";
        mesh.scheme = GetParam();
        mesh.refineLevel = integer(0, 2);
        mesh.leftHanded = integer(0, 1);
        const int points = integer(0, 8);
        std::vector<vec3> p;
        for (int i = 0; i < points; ++i)
            p.push_back(vec3(integer(0, 2), integer(0, 2), integer(0, 2)));
        if (points > 0 && integer(0, 5) == 0) p[0].x = nan;
        mesh.points = p;
        const int faces = integer(0, 10);
        for (int f = 0; f < faces; ++f) {
            mesh.faceVertexCounts.push_back(integer(2, 6));
            for (int k = 0; k < mesh.faceVertexCounts.back(); ++k)
                mesh.faceVertexIndices.push_back(integer(integer(0, 9) == 0 ? -1 : 0, points));
        }
        for (int i = integer(0, 6); i > 0; --i) {
            mesh.creaseIndices.push_back(integer(-1, points));
            mesh.cornerIndices.push_back(integer(-1, points));
            mesh.cornerSharpnesses.push_back(integer(0, 3) ? float(integer(-2, 12)) : nan);
            mesh.holeIndices.push_back(integer(-1, faces));
        }
        if (!mesh.creaseIndices.empty()) {
            mesh.creaseLengths = {int(mesh.creaseIndices.size())};
            mesh.creaseSharpnesses = {float(integer(0, 11))};
        }
        mesh.primvars = {makePrimvar("st", Interpolation::FaceVarying, 2,
                                     std::vector<float>(2 * mesh.faceVertexIndices.size(), 1.0f)),
                         makePrimvar("v", Interpolation::Vertex, 1, std::vector<float>(points))};
        for (float& value : mesh.primvars[0].values)
            value = float(integer(0, 1));
        drawBad(mesh, diagnostics);
    }
}

INSTANTIATE_TEST_SUITE_P(Schemes, BadMesh,
                         testing::Values(SubdivisionScheme::None, SubdivisionScheme::CatmullClark,
                                         SubdivisionScheme::Bilinear, SubdivisionScheme::Loop));

TEST(BadSubdivision, creasesThatDoNotFit) {
    Mesh cube = cubeMesh(SubdivisionScheme::CatmullClark);
    cube.refineLevel = 2;
    const double plain = volume(draw(cube));
    const struct {
        const char* input;
        std::vector<int> indices, lengths;
        float sharpness;
        std::vector<int> corners;
    } cases[] = {{"creaseIndices", {0, 1, 3}, {2}, 10, {}},
                 {"creaseIndices", {0, 99, 3, 3}, {4}, 10, {}},
                 {"subdivisionScheme", {0, 7}, {2}, 10, {}}, // no edge joins these points
                 {"creaseSharpnesses", {0, 1}, {2}, nan, {}},
                 {"cornerIndices", {}, {}, 0, {0, 1}}};
    for (const auto& c : cases) {
        SCOPED_TRACE(c.input + std::to_string(c.indices.size()));
        Mesh mesh = cube;
        mesh.creaseIndices = c.indices;
        mesh.creaseLengths = c.lengths;
        mesh.creaseSharpnesses.assign(c.lengths.size(), c.sharpness);
        mesh.cornerIndices = c.corners;
        if (!c.corners.empty()) mesh.cornerSharpnesses = {10};
        Diagnostics diagnostics;
        EXPECT_NEAR(volume(drawBad(mesh, diagnostics)), plain, 1e-6);
        EXPECT_TRUE(warned(diagnostics, "/cube", c.input));
    }
}

TEST(BadSubdivision, nonManifoldMeshesAreDrawn) {
    // Five quads share one edge, some with the same direction; one face occurs twice.
    Mesh mesh;
    mesh.path = "/fan";
    mesh.scheme = SubdivisionScheme::CatmullClark;
    mesh.refineLevel = 2;
    std::vector<vec3> points = {{0, 0, 0}, {0, 0, 1}};
    mesh.faceVertexCounts.assign(6, 4);
    for (int i = 0; i < 5; ++i) {
        const vec3 side(std::cos(1.2f * i), std::sin(1.2f * i), 0);
        points.insert(points.end(), {side, side + vec3(0, 0, 1)});
        for (int index : {0, 1, 3 + 2 * i, 2 + 2 * i})
            mesh.faceVertexIndices.push_back(index);
    }
    mesh.faceVertexIndices.insert(mesh.faceVertexIndices.end(), {0, 1, 3, 2});
    mesh.points = points;
    Diagnostics diagnostics;
    const TriangleMesh result = drawBad(mesh, diagnostics);
    EXPECT_EQ(result.triangles.size(), 6u * 16 * 2);
}

TEST(BadSubdivision, facesThatUseAPointTwice) {
    Mesh mesh = cubeMesh(SubdivisionScheme::CatmullClark);
    mesh.refineLevel = 1;
    mesh.faceVertexIndices[1] = mesh.faceVertexIndices[0];
    Diagnostics diagnostics;
    drawBad(mesh, diagnostics);
    EXPECT_TRUE(warned(diagnostics, "/cube", "faceVertexIndices"));
}

} // namespace
} // namespace patina
