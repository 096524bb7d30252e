// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/geometry/curveSegments.h"
#include "hdDelegate/geometry/tessellate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace patina {

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

/// The same with edges of that length. @param edge 0: as it is
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

/// Segments of curves of which there is nothing to say.
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

inline Primvar makePrimvar(const std::string& name, Interpolation interpolation, int components,
                           std::vector<float> values, std::vector<int> indices = {}) {
    Primvar primvar;
    primvar.name = name;
    primvar.interpolation = interpolation;
    primvar.components = components;
    primvar.values = std::move(values);
    primvar.indices = std::move(indices);
    return primvar;
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

} // namespace patina
