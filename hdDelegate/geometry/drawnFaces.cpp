// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/geometry/drawnFaces.h"

#include "hdDelegate/geometry/triangulate.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

float angleBetween(const vec3& a, const vec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

} // namespace

DrawnTriangles drawFaces(const CageFaces& faces, const std::vector<int>& vertices,
                         const std::vector<vec3>& positions, bool flip, bool withCorners) {
    DrawnTriangles drawn;
    size_t expected = 0;
    for (int count : faces.counts)
        expected += size_t(count - 2);
    drawn.triangles.reserve(expected);
    if (withCorners) drawn.corners.reserve(3 * expected);
    drawn.faces.reserve(expected);

    std::vector<vec3> polygon;
    std::vector<uvec3> cut;
    for (size_t f = 0; f < faces.size(); ++f) {
        if (faces.isHole(f)) continue;
        const int count = faces.counts[f];
        const int* face = &vertices[faces.firstCorner[f]];
        polygon.resize(count);
        for (int k = 0; k < count; ++k)
            polygon[k] = positions[face[k]];
        cut.clear();
        triangulatePolygon(polygon.data(), count, cut);
        for (uvec3 t : cut) {
            if (flip) std::swap(t.y, t.z);
            const uvec3 triangle(face[t.x], face[t.y], face[t.z]);
            if (triangle.x == triangle.y || triangle.y == triangle.z || triangle.z == triangle.x)
                continue;
            drawn.triangles.push_back(triangle);
            drawn.faces.push_back(faces.authored[f]);
            if (!withCorners) continue;
            for (int k = 0; k < 3; ++k)
                drawn.corners.push_back(faces.firstCorner[f] + t[k]);
        }
    }
    return drawn;
}

std::vector<vec3> smoothNormals(const std::vector<vec3>& positions,
                                const std::vector<uvec3>& triangles) {
    std::vector<vec3> normals(positions.size(), vec3(0.0f));
    for (const uvec3& t : triangles) {
        const vec3 p[3] = {positions[t.x], positions[t.y], positions[t.z]};
        const vec3 n = glm::cross(p[1] - p[0], p[2] - p[0]);
        const float length = glm::length(n);
        if (!(length > 0.0f)) continue;
        for (int k = 0; k < 3; ++k)
            normals[t[k]] +=
                n * (angleBetween(p[(k + 1) % 3] - p[k], p[(k + 2) % 3] - p[k]) / length);
    }
    for (vec3& n : normals) {
        const float length = glm::length(n);
        n = length > 0.0f ? n / length : vec3(0, 0, 1);
    }
    return normals;
}

std::vector<float> gatherCorners(const DrawnTriangles& drawn, const std::vector<float>& values,
                                 const std::vector<int>& valueIndices, int components) {
    std::vector<float> out(drawn.corners.size() * components);
    for (size_t i = 0; i < drawn.corners.size(); ++i) {
        const size_t corner = drawn.corners[i];
        const size_t value = valueIndices.empty() ? corner : size_t(valueIndices[corner]);
        std::copy_n(&values[value * components], components, &out[i * components]);
    }
    return out;
}

std::vector<uint16_t> subsetOfElements(const Geometry& prim, size_t elements,
                                       Diagnostics& diagnostics) {
    std::vector<uint16_t> subsetOf;
    if (prim.subsets.empty()) return subsetOf;
    subsetOf.resize(elements);
    constexpr size_t maximum = 65534;
    if (prim.subsets.size() > maximum)
        diagnostics.warn(prim.path, "subsets", messages::subsetsTooMany);
    for (size_t s = 0; s < std::min(prim.subsets.size(), maximum); ++s) {
        const GeomSubset& subset = prim.subsets[s];
        size_t outside = 0, taken = 0;
        for (int element : subset.faces) {
            if (element < 0 || size_t(element) >= elements)
                ++outside;
            else if (subsetOf[element] != 0)
                taken += subsetOf[element] != s + 1;
            else
                subsetOf[element] = uint16_t(s + 1);
        }
        if (outside > 0)
            diagnostics.warn(subset.path, "indices", messages::subsetOutOfRange(outside));
        if (taken > 0) diagnostics.warn(subset.path, "indices", messages::elementsTaken(taken));
    }
    return subsetOf;
}

void finishMesh(const Mesh& mesh, Diagnostics& diagnostics, TriangleMesh& out) {
    const std::vector<uint16_t> subsetOf =
        subsetOfElements(mesh, mesh.faceVertexCounts.size(), diagnostics);
    if (!subsetOf.empty()) {
        out.triangleSubset.resize(out.triangles.size());
        for (size_t t = 0; t < out.triangles.size(); ++t)
            out.triangleSubset[t] = subsetOf[out.triangleFace[t]];
    }
    growBounds(out);
}

void growBounds(TriangleMesh& out) {
    if (out.triangles.empty()) return;
    out.boundsMin = vec3(INFINITY);
    out.boundsMax = vec3(-INFINITY);
    for (const auto& step : out.positions)
        for (const uvec3& t : out.triangles)
            for (int k = 0; k < 3; ++k) {
                out.boundsMin = glm::min(out.boundsMin, step[t[k]]);
                out.boundsMax = glm::max(out.boundsMax, step[t[k]]);
            }
}

} // namespace patina
