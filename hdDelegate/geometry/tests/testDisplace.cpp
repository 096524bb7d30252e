// SPDX-License-Identifier: Apache-2.0
// Displacement against closed forms, and what must not tear or lose its edges.

#include "hdDelegate/geometry/displace.h"
#include "hdDelegate/geometry/splitTriangles.h"
#include "hdDelegate/geometry/tests/meshFixtures.h"
#include "materialNetwork/tests/materialFixture.h"

#include <cmath>
#include <cstdint>
#include <cstring>

using namespace patina;

namespace {

/// A material that moves surfaces by one node.
std::shared_ptr<const MaterialProgram> moving(const std::string& id, Inputs inputs) {
    Network network =
        makeNetwork({makeNode("d", id, std::move(inputs)), makeNode("surface", "ND_surface")});
    network.terminals["displacement"] = {"/m/d", ""};
    return Compiled(network).program;
}

std::shared_ptr<const MaterialProgram> along(float amount, float scale) {
    return moving("ND_displacement_float",
                  {{"displacement", number(amount)}, {"scale", number(scale)}});
}

TriangleMesh made(ImplicitShape shape) {
    return draw(makeImplicit(shape));
}

} // namespace

TEST(Displace, ASphereGrowsAlongItsNormals) {
    for (const mat4& place : {mat4(1.0f), mat4(mat3(3.0f))}) {
        TriangleMesh mesh = made(ImplicitShape::Sphere);
        displace(mesh, {along(0.25f, 2.0f)}, place);
        ASSERT_EQ(mesh.normals[0].size(), mesh.triangles.size() * 3);
        for (size_t c = 0; c < mesh.normals[0].size(); ++c) {
            const vec3 p = mesh.positions[0][mesh.triangles[c / 3][c % 3]];
            EXPECT_NEAR(glm::length(p), 1.5f, 2e-3f);
            EXPECT_GT(glm::dot(mesh.normals[0][c], glm::normalize(p)), 0.99f);
        }
        EXPECT_NEAR(mesh.boundsMax.x, 1.5f, 2e-2f);
    }
}

TEST(Displace, ACubeStaysClosedAndKeepsItsEdges) {
    TriangleMesh mesh = made(ImplicitShape::Cube);
    splitTriangles(mesh, 0.3f, 100000);
    displace(mesh, {along(0.1f, 1.0f)}, mat4(1.0f));
    expectClosed(mesh);
    // In the middle of a face
    // edge.
    for (size_t c = 0; c < mesh.normals[0].size(); ++c) {
        const vec3 p = glm::abs(mesh.positions[0][mesh.triangles[c / 3][c % 3]]);
        const vec3 n = glm::abs(mesh.normals[0][c]);
        const float inner = p.x + p.y + p.z - std::max({p.x, p.y, p.z});
        if (inner < 0.8f) {
            EXPECT_GT(std::max({n.x, n.y, n.z}), 0.999f);
        }
    }
}

TEST(Displace, VectorsFollowTheTangentFrame) {
    TriangleMesh mesh = made(ImplicitShape::Plane);
    const std::vector<vec3> before = mesh.positions[0];
    const vec3 n = glm::normalize(triangleCross(mesh, 0));
    displace(
        mesh,
        {moving("ND_displacement_vector3", {{"displacement", Value::makeVec3(0.1f, 0.2f, 0.3f)}})},
        mat4(1.0f));
    for (size_t i = 0; i < before.size(); ++i) {
        const vec3 moved = mesh.positions[0][i] - before[i];
        EXPECT_NEAR(glm::length(moved), std::sqrt(0.14f), 1e-5f);
        EXPECT_NEAR(glm::dot(moved, n), 0.3f, 1e-5f);
        ASSERT_NE(mesh.attribute("st"), nullptr);
    }
}

TEST(Displace, ValuesThatAreNotFiniteMoveNothing) {
    for (float bad : {NAN, INFINITY}) {
        TriangleMesh mesh = made(ImplicitShape::Sphere);
        const std::vector<vec3> before = mesh.positions[0];
        displace(mesh, {along(bad, 1.0f)}, mat4(1.0f));
        EXPECT_EQ(before, mesh.positions[0]);
    }
}

TEST(Displace, PointsAreToldApartInFewSteps) {
    // Bits that an exclusive or of the coordinates' odd multiples maps to one number: a hash that
    // is no more than that compares all of them with each other.
    constexpr uint32_t inverse = 2910444383u; // of 19349663 modulo 2^32
    static_assert(19349663u * inverse == 1u);
    TriangleMesh mesh;
    std::vector<vec3> positions;
    for (uint32_t i = 0; positions.size() < 300000; ++i) {
        vec3 p(1.0f + float(i) * 1e-3f, 0.0f, 0.0f);
        uint32_t x;
        std::memcpy(&x, &p.x, sizeof x);
        const uint32_t y = inverse * ((x * 73856093u) ^ 12345u);
        std::memcpy(&p.y, &y, sizeof y);
        if (std::isfinite(p.y) && std::abs(p.y) < 1e10f) positions.push_back(p);
    }
    for (uint32_t i = 0; i + 2 < positions.size(); i += 3) {
        mesh.triangles.emplace_back(i, i + 1, i + 2);
        mesh.triangleFace.push_back(int(i / 3));
    }
    mesh.positions = {std::move(positions)};
    displace(mesh, {along(1.0f, 1.0f)}, mat4(1.0f));
    EXPECT_EQ(mesh.triangles.size(), 100000u);
}

TEST(SplitTriangles, KeepsSurfaceAndBudget) {
    TriangleMesh mesh = made(ImplicitShape::Cube);
    const size_t before = mesh.triangles.size();
    splitTriangles(mesh, 0.5f, 10000000);
    float longest = 0.0f;
    for (const uvec3& t : mesh.triangles)
        for (int k = 0; k < 3; ++k)
            longest = std::max(
                longest, glm::distance(mesh.positions[0][t[k]], mesh.positions[0][t[(k + 1) % 3]]));
    EXPECT_LE(longest, 0.5f);
    EXPECT_NEAR(surfaceArea(mesh), 24.0, 1e-3);
    EXPECT_EQ(mesh.triangleFace.size(), mesh.triangles.size());
    TriangleMesh small = made(ImplicitShape::Cube);
    splitTriangles(small, 1e-6f, before * 20);
    EXPECT_EQ(small.triangles.size(), before * 16);
}
