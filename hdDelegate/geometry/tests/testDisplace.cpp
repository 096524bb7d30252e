// SPDX-License-Identifier: Apache-2.0
// Displacement against closed forms, and what must not tear or lose its edges.

#include "hdDelegate/geometry/displace.h"
#include "hdDelegate/geometry/splitTriangles.h"
#include "hdDelegate/geometry/tessellate.h"
#include "hdDelegate/geometry/tests/noTextures.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>

using namespace patina;

namespace {

NetworkNode node(const std::string& path, const std::string& id,
                 std::map<std::string, Value> inputs,
                 std::map<std::string, Connection> connections = {}) {
    NetworkNode result;
    result.path = path;
    result.id = id;
    result.inputs = std::move(inputs);
    result.connections = std::move(connections);
    return result;
}

std::shared_ptr<const MaterialProgram> program(std::vector<NetworkNode> nodes) {
    Network network;
    network.path = "/m";
    network.terminals["displacement"] = {nodes.at(0).path, ""};
    network.terminals["surface"] = {"/m/surface", ""};
    network.nodes = std::move(nodes);
    network.nodes.push_back(node("/m/surface", "ND_surface", {}));
    static NoTextures textures;
    Diagnostics diagnostics;
    const auto result = compileMaterial(network, textures, diagnostics);
    return result;
}

std::shared_ptr<const MaterialProgram> along(float amount, float scale) {
    return program(
        {node("/m/d", "ND_displacement_float",
              {{"displacement", Value::makeFloat(amount)}, {"scale", Value::makeFloat(scale)}})});
}

std::shared_ptr<const MaterialProgram> vector(const vec3& v) {
    return program({node("/m/d", "ND_displacement_vector3",
                         {{"displacement", Value::makeVec3(v.x, v.y, v.z)}})});
}

TriangleMesh made(ImplicitShape shape) {
    Implicit prim;
    prim.path = "/shape";
    prim.shape = shape;
    Diagnostics diagnostics;
    return tessellate(prim, {}, diagnostics);
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
    // Every edge is shared by two triangles that run along it in opposite directions.
    std::map<std::array<float, 6>, int> edges;
    for (const uvec3& t : mesh.triangles)
        for (int k = 0; k < 3; ++k) {
            const vec3 a = mesh.positions[0][t[k]], b = mesh.positions[0][t[(k + 1) % 3]];
            ++edges[{a.x, a.y, a.z, b.x, b.y, b.z}];
        }
    for (const auto& [e, count] : edges) {
        EXPECT_EQ(count, 1);
        EXPECT_EQ(edges.count({e[3], e[4], e[5], e[0], e[1], e[2]}), 1u);
    }
    // In the middle of a face the normal is that of the face, right up to the rows next to its
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
    const vec3 n =
        glm::normalize(glm::cross(before[mesh.triangles[0].y] - before[mesh.triangles[0].x],
                                  before[mesh.triangles[0].z] - before[mesh.triangles[0].x]));
    displace(mesh, {vector(vec3(0.1f, 0.2f, 0.3f))}, mat4(1.0f));
    for (size_t i = 0; i < before.size(); ++i) {
        const vec3 moved = mesh.positions[0][i] - before[i];
        EXPECT_NEAR(glm::length(moved), std::sqrt(0.14f), 1e-5f);
        EXPECT_NEAR(glm::dot(moved, n), 0.3f, 1e-5f);
        const MeshAttribute* st = mesh.attribute("st");
        ASSERT_NE(st, nullptr);
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
    float longest = 0.0f, area = 0.0f;
    for (const uvec3& t : mesh.triangles) {
        const vec3 a = mesh.positions[0][t.x], b = mesh.positions[0][t.y],
                   c = mesh.positions[0][t.z];
        longest = std::max({longest, glm::length(b - a), glm::length(c - b), glm::length(a - c)});
        area += 0.5f * glm::length(glm::cross(b - a, c - a));
    }
    EXPECT_LE(longest, 0.5f);
    EXPECT_NEAR(area, 24.0f, 1e-3f);
    EXPECT_EQ(mesh.triangleFace.size(), mesh.triangles.size());
    TriangleMesh small = made(ImplicitShape::Cube);
    splitTriangles(small, 1e-6f, before * 20);
    EXPECT_EQ(small.triangles.size(), before * 16);
}
