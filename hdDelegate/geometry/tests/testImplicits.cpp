// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/geometry/tangentFrames.h"
#include "hdDelegate/geometry/tests/meshFixtures.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>

namespace patina {
namespace {

/// Volume and area within the error that the segments allow, normals along the triangles; closed.
void expectSolid(const TriangleMesh& mesh, double wantedVolume, double wantedArea) {
    EXPECT_NEAR(volume(mesh), wantedVolume, 2e-3 * wantedVolume);
    EXPECT_NEAR(surfaceArea(mesh), wantedArea, 2e-3 * wantedArea);
    EXPECT_LE(surfaceArea(mesh), wantedArea * (1 + 1e-5)) << "vertices lie on the surface";
    expectClosed(mesh);
    expectNormalsAlongTriangles(mesh, 0.99f);
}

const double pi = glm::pi<double>();

TEST(Implicits, sphere) {
    Implicit prim = makeImplicit(ImplicitShape::Sphere);
    prim.radius = 2.0f;
    const TriangleMesh mesh = draw(prim);
    expectSolid(mesh, 4.0 / 3.0 * pi * 8, 4 * pi * 4);
    for (size_t i = 0; i < mesh.positions[0].size(); ++i) {
        EXPECT_NEAR(glm::length(mesh.positions[0][i]), 2.0f, 1e-5f);
        EXPECT_LT(glm::length(mesh.normals[0][i] - 0.5f * mesh.positions[0][i]), 1e-5f);
    }
    EXPECT_NEAR(mesh.boundsMax.z, 2.0f, 1e-6f);
}

TEST(Implicits, cubeHasItsSize) {
    Implicit prim = makeImplicit(ImplicitShape::Cube);
    prim.size = 3.0f;
    const TriangleMesh mesh = draw(prim);
    expectSolid(mesh, 27, 54);
    EXPECT_EQ(mesh.triangles.size(), 12u);
    EXPECT_EQ(mesh.triangleFace.back(), 5);
}

TEST(Implicits, roundShapesAlongEveryAxis) {
    for (int axis = 0; axis < 3; ++axis) {
        Implicit prim = makeImplicit(ImplicitShape::Cylinder, axis);
        prim.height = 5.0f;
        const TriangleMesh cylinder = draw(prim);
        expectSolid(cylinder, 5 * pi, 2 * pi + 10 * pi);
        vec3 extent(1.0f), unit(0.0f);
        extent[axis] = 2.5f;
        unit[axis] = 1.0f;
        EXPECT_LT(glm::length(cylinder.boundsMax - extent), 2e-3f);

        prim.shape = ImplicitShape::Cone;
        const TriangleMesh cone = draw(prim);
        expectSolid(cone, 5 * pi / 3, pi + pi * std::sqrt(26.0));
        for (const vec3& p : cone.positions[0])
            EXPECT_LE(glm::length(p - p[axis] * unit), (2.5f - p[axis]) / 5.0f + 1e-5f)
                << "the tip is at +axis";

        prim.shape = ImplicitShape::Capsule;
        const TriangleMesh capsule = draw(prim);
        expectSolid(capsule, 5 * pi + 4 * pi / 3, 10 * pi + 4 * pi);
        EXPECT_NEAR(capsule.boundsMax[axis], 3.5f, 1e-5f);
    }
}

TEST(Implicits, topRadius) {
    Implicit prim = makeImplicit(ImplicitShape::Cylinder);
    prim.radius = 2.0f;
    prim.radiusTop = 1.0f;
    const TriangleMesh frustum = draw(prim);
    expectSolid(frustum, pi * 2 / 3 * (4 + 2 + 1), pi * 4 + pi + pi * 3 * std::sqrt(5.0));
    prim.radiusTop = 0.0f;
    expectClosed(draw(prim));
    prim.shape = ImplicitShape::Capsule;
    prim.radiusTop = 1.0f;
    const TriangleMesh capsule = draw(prim);
    expectClosed(capsule);
    EXPECT_NEAR(capsule.boundsMin.z, -3.0f, 1e-5f);
    EXPECT_NEAR(capsule.boundsMax.z, 2.0f, 1e-5f);
}

TEST(Implicits, planeLiesAsUsdSays) {
    const vec3 extents[3] = {{0, 3, 2}, {2, 0, 3}, {2, 3, 0}}; // width 2, length 3
    for (int axis = 0; axis < 3; ++axis) {
        Implicit prim = makeImplicit(ImplicitShape::Plane, axis);
        prim.width = 2.0f;
        prim.length = 3.0f;
        const TriangleMesh mesh = draw(prim);
        EXPECT_EQ(mesh.boundsMax - mesh.boundsMin, extents[axis]);
        vec3 normal(0.0f);
        normal[axis] = 1.0f;
        EXPECT_EQ(mesh.normals[0][0], normal);
        EXPECT_GT(glm::dot(normal, triangleCross(mesh, 0)), 0.0f);
    }
}

TEST(Implicits, stCoversTheUnitSquareAndTurnsTheRightWay) {
    for (const ImplicitShape shape : implicitShapes) {
        const TriangleMesh mesh = draw(makeImplicit(shape));
        const MeshAttribute* st = mesh.attribute("st");
        ASSERT_NE(st, nullptr);
        ASSERT_EQ(st->data.size(), 2 * mesh.positions[0].size());
        for (float x : st->data)
            EXPECT_TRUE(x >= 0.0f && x <= 1.0f);
        for (unsigned t = 0; t < mesh.triangles.size(); ++t) {
            const TangentFrame frame = tangentFrame(mesh, st, t);
            ASSERT_TRUE(frame.fromTexture);
            EXPECT_GT(glm::dot(glm::cross(frame.dpdu, frame.dpdv), triangleCross(mesh, t)), 0.0f)
                << "texture is not mirrored seen from outside";
        }
    }
}

TEST(Implicits, leftHandedFacesIn) {
    Implicit prim = makeImplicit(ImplicitShape::Sphere);
    prim.leftHanded = true;
    const TriangleMesh mesh = draw(prim);
    EXPECT_LT(volume(mesh), -4.0);
    EXPECT_GT(glm::dot(cornerNormal(mesh, 300, 0), triangleCross(mesh, 300)), 0.0f);
}

TEST(Implicits, constantPrimvars) {
    Implicit prim = makeImplicit(ImplicitShape::Cube);
    prim.primvars = {makePrimvar("displayColor", Interpolation::Constant, 3, {1, 2, 3})};
    EXPECT_EQ(valueOf(draw(prim), "displayColor", 3u, 0.2f, 0.3f), vec4(1, 2, 3, 0));
}

TEST(BadImplicits, sizesAndAxes) {
    for (const ImplicitShape shape : implicitShapes)
        for (float bad : {-1.0f, 0.0f, nan, inf}) {
            Implicit prim = makeImplicit(shape, 7);
            prim.radius = prim.size = prim.width = bad;
            Diagnostics diagnostics;
            TriangleMesh mesh = tessellate(prim, {}, diagnostics);
            EXPECT_TRUE(mesh.triangles.empty());
            EXPECT_TRUE(warned(diagnostics, "/prim", "axis"));
            EXPECT_EQ(diagnostics.count() > 1, bad != 0.0f);
            prim = makeImplicit(shape);
            prim.height = bad;
            prim.radiusTop = shape == ImplicitShape::Capsule ? 0.0f : 0.5f;
            mesh = tessellate(prim, {}, diagnostics);
            for (const vec3& n : mesh.normals[0])
                EXPECT_NEAR(glm::length(n), 1.0f, 1e-5f);
        }
}

TEST(Attributes, areInterpolatedByTheirRate) {
    TriangleMesh mesh;
    mesh.positions = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}};
    mesh.triangles = {{0, 1, 2}, {1, 3, 2}};
    mesh.triangleFace = {1, 0};
    const auto value = [&](MeshAttribute::Rate rate, std::vector<float> data, unsigned t) {
        mesh.attributes = {{"a", 1, rate, std::move(data)}};
        return valueOf(mesh, "a", t, 0.25f, 0.5f).x;
    };
    using Rate = MeshAttribute::Rate;
    EXPECT_EQ(value(Rate::Constant, {3}, 1), 3.0f);
    EXPECT_EQ(value(Rate::PerFace, {3, 4}, 1), 3.0f);
    EXPECT_EQ(value(Rate::PerVertex, {0, 4, 8, 12}, 0), 0.25f * 4 + 0.5f * 8);
    EXPECT_EQ(value(Rate::PerVertex, {0, 4, 8, 12}, 1), 0.25f * 4 + 0.25f * 12 + 0.5f * 8);
    EXPECT_EQ(value(Rate::PerCorner, {0, 0, 0, 4, 8, 12}, 1), 0.25f * 4 + 0.25f * 8 + 0.5f * 12);
    float out[4] = {1, 1, 1, 1};
    EXPECT_FALSE(evalAttribute(mesh, {"short", 2, Rate::PerVertex, {1, 2}}, 0, 0.5f, 0.5f, out));
    EXPECT_EQ(out[0], 0.0f);
}

TEST(Attributes, normalsFallBackToTheTriangle) {
    TriangleMesh mesh;
    mesh.positions = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}};
    mesh.triangles = {{0, 1, 2}};
    mesh.triangleFace = {0};
    EXPECT_EQ(evalNormal(mesh, 0, 0.3f, 0.3f), vec3(0, 0, 1));
    EXPECT_EQ(evalNormal(mesh, 0, 0.3f, 0.3f, 1.0f), vec3(0, -1, 0));
    mesh.normals = {{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}}};
    EXPECT_EQ(evalNormal(mesh, 0, 0.5f, 0.0f), vec3(0, 0, 1)) << "opposite normals cancel";
    EXPECT_EQ(evalNormal(mesh, 0, 0.0f, 1.0f), vec3(0, 1, 0));
}

TEST(TangentFrames, followTheTexture) {
    const vec3 p[3] = {{0, 0, 0}, {2, 0, 0}, {0, 3, 0}};
    const vec2 st[3] = {{0, 0}, {1, 0}, {0, 1}};
    const TangentFrame frame = tangentFrame(p, st);
    EXPECT_TRUE(frame.fromTexture);
    EXPECT_LT(glm::length(frame.dpdu - vec3(2, 0, 0)), 1e-6f);
    EXPECT_LT(glm::length(frame.dpdv - vec3(0, 3, 0)), 1e-6f);
}

TEST(TangentFrames, areFiniteForEveryInput) {
    const vec3 good[3] = {{0, 0, 0}, {2, 0, 0}, {0, 3, 0}},
               tiny[3] = {{0, 0, 0}, {1e-30f, 0, 0}, {0, 1e-30f, 0}},
               point[3] = {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}},
               lost[3] = {{nan, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const vec2 unit[3] = {{0, 0}, {1, 0}, {0, 1}}, same[3] = {{1, 1}, {1, 1}, {1, 1}},
               collinear[3] = {{0, 0}, {1, 1}, {2, 2}},
               small[3] = {{0, 0}, {1e-30f, 0}, {0, 1e-30f}}, bad[3] = {{0, 0}, {nan, 0}, {0, 1}};
    for (auto* p : {good, tiny, point, lost})
        for (auto* st : {unit, same, collinear, small, bad}) {
            const TangentFrame frame = tangentFrame(p, st);
            for (const vec3& v : {frame.dpdu, frame.dpdv}) {
                EXPECT_TRUE(std::isfinite(v.x + v.y + v.z));
                EXPECT_GT(glm::length(v), 0.0f);
            }
            if (p == good && st != unit && !frame.fromTexture) {
                EXPECT_NEAR(glm::dot(frame.dpdu, frame.dpdv), 0.0f, 1e-6f);
                EXPECT_NEAR(frame.dpdu.z, 0.0f, 1e-6f) << "in the plane of the triangle";
            }
        }
}

TEST(TangentFrames, basisIsOrthonormalAroundTheSphere) {
    for (float z : {-1.0f, -0.999999f, -0.5f, 0.0f, 0.7f, 1.0f})
        for (int i = 0; i < 16; ++i) {
            const float r = std::sqrt(1 - z * z), phi = 0.4f * i;
            const vec3 n(r * std::cos(phi), r * std::sin(phi), z);
            vec3 t, b;
            orthonormalBasis(n, t, b);
            EXPECT_NEAR(glm::length(t), 1.0f, 2e-6f);
            EXPECT_LT(glm::length(glm::cross(t, b) - n), 2e-6f);
        }
}

vec3 centre(const TriangleMesh& mesh, size_t t) {
    vec3 sum(0.0f);
    for (int k = 0; k < 3; ++k)
        sum += mesh.positions[0][mesh.triangles[t][k]];
    return sum / 3.0f;
}

/// From a point to the nearest centre of the triangles of a face.
float distanceToFace(const TriangleMesh& mesh, int face, const vec3& p) {
    float nearest = 1e30f;
    const auto& faces = mesh.triangleFace; // in order
    for (auto it = std::lower_bound(faces.begin(), faces.end(), face);
         it != faces.end() && *it == face; ++it)
        nearest = std::min(nearest, glm::length(p - centre(mesh, size_t(it - faces.begin()))));
    return nearest;
}

TEST(Implicits, FewerSegmentsKeepShapeAndFaceNumbers) {
    for (const ImplicitShape shape : implicitShapes) {
        if (shape == ImplicitShape::Plane) continue;
        const Implicit prim = makeImplicit(shape);
        const TriangleMesh fine = draw(prim);
        size_t before = fine.triangles.size();
        for (const float edge : {0.099f, 0.2f, 0.4f, 10.0f}) {
            const TriangleMesh coarse = draw(prim, edge);
            expectClosed(coarse);
            EXPECT_NEAR(volume(coarse), volume(fine), 0.03 * volume(fine));
            // A convex outline covers a quarter of the surface in the mean over all directions
            // (Cauchy 1832).
            EXPECT_NEAR(surfaceArea(coarse), surfaceArea(fine),
                        (shape == ImplicitShape::Sphere ? 1e-3 : 1.2e-2) * surfaceArea(fine));
            EXPECT_NEAR(coarse.boundsMax.z, fine.boundsMax.z, 2e-2f * fine.boundsMax.z);
            const auto last = [](const TriangleMesh& m) {
                return *std::max_element(m.triangleFace.begin(), m.triangleFace.end());
            };
            EXPECT_LE(last(coarse), last(fine));
            EXPECT_LE(coarse.triangles.size(), before);
            EXPECT_EQ(coarse.triangles.capacity(), coarse.triangles.size()); // no room to grow
            EXPECT_EQ(coarse.normals[0].capacity(), coarse.normals[0].size());
            before = coarse.triangles.size();
            // A face of a coarse shape is a face of the fine one at the same place.
            for (size_t t = 0; t < coarse.triangles.size(); ++t)
                EXPECT_LT(distanceToFace(fine, coarse.triangleFace[t], centre(coarse, t)), 0.8f);
        }
        if (shape != ImplicitShape::Cube) {
            EXPECT_LT(before, fine.triangles.size() / 7);
        }
    }
}

} // namespace
} // namespace patina
