// SPDX-License-Identifier: Apache-2.0
// Primvars of implicit prims by the faces, points and corners of OpenUSD's meshes of them.
#include "hdDelegate/geometry/implicitFaces.h"
#include "hdDelegate/geometry/tests/meshFixtures.h"

#include <glm/gtc/constants.hpp>

namespace patina {
namespace {

const float pi = glm::pi<float>();

Implicit longImplicit(ImplicitShape shape, int axis) {
    Implicit prim = makeImplicit(shape, axis);
    prim.height = 3.0f;
    prim.width = 2.0f;
    prim.length = 5.0f;
    return prim;
}

void ring(std::vector<vec3>& points, float radius, float z) {
    for (int i = 0; i < 10; ++i) {
        const float phi = 0.2f * pi * float(i);
        points.push_back(vec3(radius * std::cos(phi), radius * std::sin(phi), z));
    }
}

/// The points of OpenUSD's mesh of a prim, in the order of its geomUtil and of UsdImaging's planes.
std::vector<vec3> pointsOf(const Implicit& prim) {
    std::vector<vec3> points;
    const float half = 0.5f * prim.height;
    int axis = prim.axis;
    switch (prim.shape) {
    case ImplicitShape::Sphere:
        points.push_back(vec3(0, 0, -1));
        for (int j = 1; j < 10; ++j)
            ring(points, std::sin(0.1f * pi * float(j)), -std::cos(0.1f * pi * float(j)));
        points.push_back(vec3(0, 0, 1));
        axis = 2;
        break;
    case ImplicitShape::Cube:
        points = {{1, 1, 1},    {-1, 1, 1},  {-1, -1, 1}, {1, -1, 1},
                  {-1, -1, -1}, {-1, 1, -1}, {1, 1, -1},  {1, -1, -1}};
        axis = 2;
        break;
    case ImplicitShape::Cone:
    case ImplicitShape::Cylinder: {
        const float top = prim.shape == ImplicitShape::Cone ? 0.0f : 1.0f;
        points.push_back(vec3(0, 0, -half));
        ring(points, 1.0f, -half);
        ring(points, 1.0f, -half);
        ring(points, top, half);
        if (top == 0.0f) break;
        ring(points, top, half);
        points.push_back(vec3(0, 0, half));
        break;
    }
    case ImplicitShape::Capsule:
        points.push_back(vec3(0, 0, -1 - half));
        for (int j = 1; j <= 4; ++j)
            ring(points, std::sin(0.125f * pi * float(j)),
                 -half - std::cos(0.125f * pi * float(j)));
        for (int j = 0; j < 4; ++j)
            ring(points, std::cos(0.125f * pi * float(j)), half + std::sin(0.125f * pi * float(j)));
        points.push_back(vec3(0, 0, 1 + half));
        break;
    case ImplicitShape::Plane: {
        const float w = 0.5f * prim.width, l = 0.5f * prim.length;
        if (axis == 0) return {{0, l, w}, {0, -l, w}, {0, -l, -w}, {0, l, -w}};
        if (axis == 1) return {{-w, 0, l}, {w, 0, l}, {w, 0, -l}, {-w, 0, -l}};
        return {{w, l, 0}, {-w, l, 0}, {-w, -l, 0}, {w, -l, 0}};
    }
    }
    for (vec3& p : points)
        p = axis == 0 ? vec3(p.z, p.x, p.y) : axis == 1 ? vec3(p.y, p.z, p.x) : p;
    return points;
}

/// Values that are the points' places stay at their places: a face of OpenUSD's lies inside of the
/// round shape by no more than the height of an arc of 36 degrees, along both of its directions.
void expectInPlace(const TriangleMesh& mesh, bool round) {
    const float arc = round ? 1.0f - std::cos(pi / 10.0f) : 0.0f;
    for (unsigned t = 0; t < mesh.triangles.size(); ++t)
        for (const vec2 uv : {vec2(0), vec2(1, 0), vec2(0, 1)}) {
            const int corner = uv.x > 0 ? 1 : uv.y > 0 ? 2 : 0;
            const vec3 place = mesh.positions[0][mesh.triangles[t][corner]];
            ASSERT_LT(glm::length(vec3(valueOf(mesh, "where", t, uv.x, uv.y)) - place),
                      2.0f * arc + 1e-5f)
                << t;
        }
}

TEST(ImplicitFaces, pointsAreWhereOpenUsdHasThem) {
    for (ImplicitShape shape : implicitShapes)
        for (int axis = 0; axis < 3; ++axis)
            for (bool left : {false, true}) {
                SCOPED_TRACE(std::to_string(int(shape)) + " " + std::to_string(axis));
                Implicit prim = longImplicit(shape, axis);
                prim.leftHanded = left;
                const std::vector<vec3> points = pointsOf(prim);
                const bool flat = shape == ImplicitShape::Cube || shape == ImplicitShape::Plane;
                for (Interpolation kind : {Interpolation::Vertex, Interpolation::Varying}) {
                    prim.primvars = {makePrimvar("where", kind, 3, numbersOf(points))};
                    expectInPlace(draw(prim), !flat);
                    expectInPlace(draw(prim, 10.0f), !flat);
                }
                // The same at the corners of faces.
                const ShapeFaces faces = facesOf(prim);
                std::vector<vec3> corners(faces.counts.faceVarying, vec3(1e9f));
                for (const ShapeFace& face : faces.faces)
                    for (int k = 0; k < 4; ++k)
                        corners[size_t(face.corners[k])] = points[size_t(face.points[k])];
                prim.primvars = {
                    makePrimvar("where", Interpolation::FaceVarying, 3, numbersOf(corners))};
                expectInPlace(draw(prim), !flat);
                expectInPlace(draw(prim, 10.0f), !flat);
            }
}

TEST(ImplicitFaces, facesAreWhereTheirCornersAre) {
    for (ImplicitShape shape : implicitShapes) {
        Implicit prim = longImplicit(shape, 2);
        const std::vector<vec3> points = pointsOf(prim);
        const ShapeFaces faces = facesOf(prim);
        std::vector<vec3> middles;
        for (const ShapeFace& face : faces.faces) {
            vec3 sum(0.0f);
            for (int point : face.points)
                sum += points[size_t(point)];
            middles.push_back(0.25f * sum);
        }
        prim.primvars = {makePrimvar("where", Interpolation::Uniform, 3, numbersOf(middles))};
        EXPECT_GE(draw(prim).triangles.size(), draw(prim, 10.0f).triangles.size());
        const TriangleMesh mesh = draw(prim, shape == ImplicitShape::Capsule ? 10.0f : 0.0f);
        std::vector<double> areas(middles.size(), 0.0);
        for (unsigned t = 0; t < mesh.triangles.size(); ++t) {
            const size_t face = size_t(mesh.triangleFace[t]);
            EXPECT_EQ(vec3(valueOf(mesh, "where", t, 0.3f, 0.3f)), middles[face]);
            // No face of these shapes has a diagonal above that of the plane, 2 by 5.
            for (int k = 0; k < 3; ++k)
                ASSERT_LT(glm::length(mesh.positions[0][mesh.triangles[t][k]] - middles[face]),
                          0.5f * std::sqrt(29.0f) + 1e-5f);
            areas[face] += 0.5 * glm::length(triangleCross(mesh, t));
        }
        for (size_t f = 1; f < areas.size(); ++f) { // as large as its mirror image
            const size_t opposite =
                shape == ImplicitShape::Cone ? f / 10 * 10 : areas.size() - 1 - f;
            EXPECT_GT(areas[f], 0.0);
            EXPECT_NEAR(areas[f], areas[opposite], 1e-4 * areas[f]) << f;
        }
    }
}

TEST(ImplicitFaces, wrongNumbersAreToldWithWhatIsNeeded) {
    const size_t points[] = {92, 8, 31, 42, 82, 4}, faces[] = {100, 6, 20, 30, 90, 1},
                 corners[] = {380, 24, 70, 100, 340, 4};
    for (size_t i = 0; i < std::size(implicitShapes); ++i)
        for (const auto& [kind, needed] : {std::pair{Interpolation::Vertex, points[i]},
                                           {Interpolation::Varying, points[i]},
                                           {Interpolation::Uniform, faces[i]},
                                           {Interpolation::FaceVarying, corners[i]}}) {
            Implicit prim = longImplicit(implicitShapes[i], 2);
            prim.primvars = {makePrimvar("displayOpacity", kind, 1, std::vector<float>(7, 0.5f))};
            Diagnostics diagnostics;
            const TriangleMesh mesh = tessellate(prim, {}, diagnostics);
            EXPECT_EQ(mesh.attribute("displayOpacity"), nullptr);
            ASSERT_EQ(diagnostics.count(), 1u);
            const Diagnostic told = diagnostics.all()[0];
            EXPECT_EQ(told.prim + " " + told.input, "/prim primvars:displayOpacity");
            EXPECT_NE(told.message.find("needs " + std::to_string(needed)), std::string::npos)
                << told.message;
        }
}

TEST(ImplicitFaces, subsetsCountThem) {
    Implicit prim = longImplicit(ImplicitShape::Cube, 2);
    prim.subsets.push_back({"/prim/top", "", {0}}); // +z
    const TriangleMesh mesh = draw(prim);
    for (size_t t = 0; t < mesh.triangles.size(); ++t)
        EXPECT_EQ(mesh.triangleSubset[t] == 1, cornerNormal(mesh, t, 0).z == 1.0f);
}

} // namespace
} // namespace patina
