// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/geometry/splitTriangles.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace patina {

namespace {

using Rate = MeshAttribute::Rate;

float longestEdge(const TriangleMesh& mesh) {
    float squared = 0.0f;
    const std::vector<vec3>& p = mesh.positions[0];
    for (const uvec3& t : mesh.triangles)
        for (int k = 0; k < 3; ++k) {
            const vec3 edge = p[t[(k + 1) % 3]] - p[t[k]];
            squared = std::max(squared, glm::dot(edge, edge));
        }
    return std::sqrt(squared);
}

/// Which corners or middles the four children are made of: 0..2 corners, 3 + k the middle of the
/// edge from k to k + 1.
constexpr int children[4][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}};

/// @param width values per element
template <class T> std::vector<T> splitCorners(const std::vector<T>& values, size_t width) {
    std::vector<T> result;
    result.reserve(values.size() * 4);
    for (size_t first = 0; first + 3 * width <= values.size(); first += 3 * width)
        for (const auto& child : children)
            for (int place : child)
                for (size_t i = 0; i < width; ++i) {
                    const T* corner = &values[first + i];
                    result.push_back(place < 3 ? corner[place * width]
                                               : (corner[(place - 3) * width] +
                                                  corner[(place - 2) % 3 * width]) *
                                                     0.5f);
                }
    return result;
}

template <class T>
void appendMiddles(std::vector<T>& values, const std::vector<uvec2>& edges, size_t width) {
    values.reserve(values.size() + edges.size() * width + 1); // Embree reads 16 bytes of the last
    for (const uvec2& e : edges)
        for (size_t i = 0; i < width; ++i)
            values.push_back((values[e.x * width + i] + values[e.y * width + i]) * 0.5f);
}

template <class T> std::vector<T> fourfold(const std::vector<T>& values) {
    std::vector<T> result;
    result.reserve(values.size() * 4);
    for (const T& value : values)
        result.insert(result.end(), 4, value);
    return result;
}

void normalizeAll(std::vector<vec3>& normals) {
    for (vec3& n : normals) {
        const float length = glm::length(n);
        if (length > 0.0f) n /= length;
    }
}

void splitOnce(TriangleMesh& mesh) {
    std::vector<uvec2> edges;
    std::unordered_map<uint64_t, uint32_t> middles;
    const uint32_t first = uint32_t(mesh.positions[0].size());
    const auto middle = [&](uint32_t a, uint32_t b) {
        const uint64_t key = uint64_t(std::min(a, b)) << 32 | std::max(a, b);
        const auto [at, isNew] = middles.emplace(key, first + uint32_t(edges.size()));
        if (isNew) edges.push_back({a, b});
        return at->second;
    };
    std::vector<uvec3> triangles;
    triangles.reserve(mesh.triangles.size() * 4);
    for (const uvec3& t : mesh.triangles) {
        const uint32_t places[6] = {
            t.x, t.y, t.z, middle(t.x, t.y), middle(t.y, t.z), middle(t.z, t.x)};
        for (const auto& child : children)
            triangles.push_back({places[child[0]], places[child[1]], places[child[2]]});
    }
    mesh.triangles = std::move(triangles);
    for (auto& step : mesh.positions)
        appendMiddles(step, edges, 1);
    for (auto& step : mesh.normals) {
        if (mesh.normalRate == Rate::PerVertex) appendMiddles(step, edges, 1);
        if (mesh.normalRate == Rate::PerCorner) step = splitCorners(step, 1);
        normalizeAll(step);
    }
    for (MeshAttribute& a : mesh.attributes) {
        if (a.rate == Rate::PerVertex) appendMiddles(a.data, edges, size_t(a.components));
        if (a.rate == Rate::PerCorner) a.data = splitCorners(a.data, size_t(a.components));
    }
    mesh.triangleFace = fourfold(mesh.triangleFace);
    mesh.triangleSubset = fourfold(mesh.triangleSubset);
}

} // namespace

void splitTriangles(TriangleMesh& mesh, float targetEdge, size_t budget) {
    if (mesh.triangles.empty() || !(targetEdge > 0.0f)) return;
    for (float edge = longestEdge(mesh); edge > targetEdge && mesh.triangles.size() * 4 <= budget;
         edge *= 0.5f)
        splitOnce(mesh);
}

} // namespace patina
