// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/geometry/curveSegments.h"
#include "hdDelegate/geometry/primvarEval.h"
#include "hdDelegate/geometry/tessellate.h"
#include "hdDelegate/scene/tests/prims.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string>

namespace patina {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float inf = std::numeric_limits<float>::infinity();

/// Whether some warning concerns this prim and input.
inline bool warned(const Diagnostics& diagnostics, const std::string& prim,
                   const std::string& input) {
    for (const Diagnostic& d : diagnostics.all())
        if (d.prim == prim && d.input == input && !d.message.empty()) return true;
    return false;
}

/// Fails the test for each warning.
inline void expectSilence(const Diagnostics& diagnostics) {
    for (const Diagnostic& d : diagnostics.all())
        ADD_FAILURE() << d.prim << " " << d.input << ": " << d.message;
}

/// Triangles of a mesh or an implicit prim, of which there is nothing to say.
template <class Prim> TriangleMesh draw(const Prim& prim, const TessellationOptions& options = {}) {
    Diagnostics diagnostics;
    TriangleMesh mesh = tessellate(prim, options, diagnostics);
    expectSilence(diagnostics);
    return mesh;
}

/// @param edge of that length; 0: as it is
inline TriangleMesh draw(const Mesh& mesh, float edge) {
    TessellationOptions options;
    options.targetEdge = edge;
    return draw(mesh, options);
}

/// @param roundEdge as of TessellationOptions: 10 draws as few segments as there may be
inline TriangleMesh draw(const Implicit& prim, float roundEdge) {
    TessellationOptions options;
    options.roundEdge = roundEdge;
    return draw(prim, options);
}

/// Options of a shutter from open to close.
inline TessellationOptions shutter(float open, float close) {
    TessellationOptions options;
    options.shutterOpen = open;
    options.shutterClose = close;
    return options;
}

/// Gives a prim a second place for its points, at time 1.
template <class Prim, class Move> void movePoints(Prim& prim, Move move) {
    std::vector<vec3> moved = prim.points.first();
    for (vec3& p : moved)
        p = move(p);
    prim.points.times = {0.0f, 1.0f};
    prim.points.values.push_back(moved);
}

/// Segments of curves of which
inline CurveSet build(const Curves& curves) {
    Diagnostics diagnostics;
    CurveSet set = buildCurves(curves, {}, diagnostics);
    expectSilence(diagnostics);
    return set;
}

/// The cube from -1 to 1, faces counterclockwise seen from outside: +x -x +y -y +z -z.
inline Mesh cubeMesh(SubdivisionScheme scheme = SubdivisionScheme::None) {
    Mesh mesh;
    mesh.path = "/cube";
    mesh.scheme = scheme;
    std::vector<vec3> points;
    for (int i = 0; i < 8; ++i)
        points.push_back(vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
    mesh.points = points;
    mesh.faceVertexCounts.assign(6, 4);
    mesh.faceVertexIndices = {1, 3, 7, 5, 0, 4, 6, 2, 2, 6, 7, 3,
                              0, 1, 5, 4, 4, 5, 7, 6, 0, 2, 3, 1};
    return mesh;
}

/// A regular tetrahedron inside that cube.
inline Mesh tetrahedronMesh(SubdivisionScheme scheme) {
    Mesh mesh;
    mesh.path = "/tetrahedron";
    mesh.scheme = scheme;
    mesh.points = std::vector<vec3>{{1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}};
    mesh.faceVertexCounts.assign(4, 3);
    mesh.faceVertexIndices = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
    return mesh;
}

/// n by n quads over the unit square, facing +z.
inline Mesh gridMesh(int n, SubdivisionScheme scheme = SubdivisionScheme::None) {
    Mesh mesh;
    mesh.path = "/grid";
    mesh.scheme = scheme;
    std::vector<vec3> points;
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i)
            points.push_back(vec3(float(i) / n, float(j) / n, 0));
    mesh.points = points;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            const int a = j * (n + 1) + i;
            mesh.faceVertexCounts.push_back(4);
            for (int index : {a, a + 1, a + n + 2, a + n + 1})
                mesh.faceVertexIndices.push_back(index);
        }
    return mesh;
}

/// Coordinates one after the other, as a primvar holds them.
inline std::vector<float> numbersOf(const std::vector<vec3>& vectors) {
    std::vector<float> numbers;
    for (const vec3& v : vectors)
        numbers.insert(numbers.end(), {v.x, v.y, v.z});
    return numbers;
}

inline Implicit makeImplicit(ImplicitShape shape, int axis = 2) {
    Implicit prim;
    prim.path = "/prim";
    prim.shape = shape;
    prim.axis = axis;
    return prim;
}

constexpr ImplicitShape implicitShapes[] = {ImplicitShape::Sphere,  ImplicitShape::Cube,
                                            ImplicitShape::Cone,    ImplicitShape::Cylinder,
                                            ImplicitShape::Capsule, ImplicitShape::Plane};

/// Position and radius on a segment, by the basis that the set says.
inline vec4 evaluate(const CurveSet& set, size_t segment, float u, size_t step = 0) {
    const vec4 w = basisWeights(set.basis, u);
    vec4 sum(0.0f);
    for (int k = 0; k < (set.basis == CurveBasis::Linear ? 2 : 4); ++k)
        sum += w[k] * set.controlPoints[step][set.segments[segment] + uint32_t(k)];
    return sum;
}

/// Value of an attribute that has to be there. @param where as of evalAttribute()
template <class Set, class... Where>
vec4 valueOf(const Set& set, const std::string& name, Where... where) {
    vec4 out(NAN);
    const MeshAttribute* attribute = set.attribute(name);
    EXPECT_TRUE(attribute && evalAttribute(set, *attribute, where..., &out.x)) << name;
    return out;
}

inline vec3 triangleCross(const TriangleMesh& mesh, size_t t, size_t step = 0) {
    const auto& p = mesh.positions[step];
    const uvec3 v = mesh.triangles[t];
    return glm::cross(p[v.y] - p[v.x], p[v.z] - p[v.x]);
}

inline double surfaceArea(const TriangleMesh& mesh) {
    double area = 0.0;
    for (size_t t = 0; t < mesh.triangles.size(); ++t)
        area += 0.5 * glm::length(triangleCross(mesh, t));
    return area;
}

/// Signed volume: positive when the triangles of a closed mesh face out.
inline double volume(const TriangleMesh& mesh) {
    double sum = 0.0;
    for (size_t t = 0; t < mesh.triangles.size(); ++t)
        sum += glm::dot(mesh.positions[0][mesh.triangles[t].x], triangleCross(mesh, t)) / 6.0;
    return sum;
}

/// Normal of a triangle's corner as a back end reads it.
inline vec3 cornerNormal(const TriangleMesh& mesh, size_t t, int corner, size_t step = 0) {
    switch (mesh.normalRate) {
    case MeshAttribute::Rate::PerFace: return mesh.normals[step][mesh.triangleFace[t]];
    case MeshAttribute::Rate::PerCorner: return mesh.normals[step][3 * t + corner];
    default: return mesh.normals[step][mesh.triangles[t][corner]];
    }
}

/// Normals of corners are about those of their triangles. @param cosine of the largest angle
inline void expectNormalsAlongTriangles(const TriangleMesh& mesh, float cosine) {
    for (size_t t = 0; t < mesh.triangles.size(); ++t)
        for (int k = 0; k < 3; ++k) {
            const vec3 n = cornerNormal(mesh, t, k);
            EXPECT_NEAR(glm::length(n), 1.0f, 1e-5f);
            EXPECT_GT(glm::dot(n, glm::normalize(triangleCross(mesh, t))), cosine);
        }
}

/// Every edge is shared by exactly two triangles, once in each direction (by position).
inline void expectClosed(const TriangleMesh& mesh) {
    std::map<std::array<float, 6>, int> edges;
    for (const uvec3& t : mesh.triangles)
        for (int k = 0; k < 3; ++k) {
            // -0 and 0 are one point
            const vec3 a = mesh.positions[0][t[k]] + vec3(0),
                       b = mesh.positions[0][t[(k + 1) % 3]] + vec3(0);
            ++edges[{a.x, a.y, a.z, b.x, b.y, b.z}];
        }
    for (const auto& [e, count] : edges) {
        EXPECT_EQ(count, 1);
        EXPECT_EQ(edges.count({e[3], e[4], e[5], e[0], e[1], e[2]}), 1u);
    }
}

} // namespace patina
