// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/geometry/sharpNormals.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

namespace Far = OpenSubdiv::Far;

bool isSharpEdge(const Far::TopologyLevel& level, int edge) {
    return !level.IsEdgeBoundary(edge) &&
           (level.GetEdgeSharpness(edge) >= 1.0f || level.IsEdgeNonManifold(edge));
}

bool isSharpVertex(const Far::TopologyLevel& level, int vertex) {
    return level.GetVertexSharpness(vertex) >= 1.0f && !level.IsVertexCorner(vertex);
}

/// Normal of a face at one of its vertices, scaled by the angle there.
vec3 cornerNormal(const Far::TopologyLevel& level, int face, int vertex,
                  const std::vector<vec3>& positions, bool flip) {
    const auto corners = level.GetFaceVertices(face);
    const int n = corners.size();
    const int k = corners.FindIndex(vertex);
    const vec3 p = positions[vertex];
    const vec3 a = positions[corners[(k + 1) % n]] - p, b = positions[corners[(k + n - 1) % n]] - p;
    const vec3 c = flip ? glm::cross(b, a) : glm::cross(a, b);
    const float length = glm::length(c);
    return length > 0.0f ? c * (std::atan2(length, glm::dot(a, b)) / length) : vec3(0.0f);
}

/// Finds which faces around a vertex belong together: those not parted by a sharp edge.
/// @returns per face around the vertex, the local number of a face that stands for all of its part
std::vector<int> smoothParts(const Far::TopologyLevel& level, int vertex) {
    const auto faces = level.GetVertexFaces(vertex);
    std::vector<int> part(faces.size());
    for (int i = 0; i < faces.size(); ++i)
        part[i] = i;
    if (isSharpVertex(level, vertex)) return part;
    const auto edges = level.GetVertexEdges(vertex);
    for (int e = 0; e < edges.size(); ++e) {
        const auto beside = level.GetEdgeFaces(edges[e]);
        if (beside.size() != 2 || isSharpEdge(level, edges[e])) continue;
        const int from = part[faces.FindIndex(beside[0])], to = part[faces.FindIndex(beside[1])];
        std::replace(part.begin(), part.end(), from, to);
    }
    return part;
}

} // namespace

bool hasSharpFeatures(const Far::TopologyLevel& level) {
    for (int e = 0; e < level.GetNumEdges(); ++e)
        if (isSharpEdge(level, e)) return true;
    for (int v = 0; v < level.GetNumVertices(); ++v)
        if (isSharpVertex(level, v)) return true;
    return false;
}

std::vector<vec3> sharpNormals(const Far::TopologyLevel& level, const DrawnTriangles& drawn,
                               const std::vector<size_t>& firstCorner,
                               const std::vector<vec3>& positions,
                               const std::vector<vec3>& vertexNormals, bool flip) {
    // Normals of all corners of faces, then only those at sharp vertices replaced.
    std::vector<vec3> ofCorner(size_t(level.GetNumFaceVertices()));
    for (int f = 0; f < level.GetNumFaces(); ++f) {
        const auto corners = level.GetFaceVertices(f);
        for (int k = 0; k < corners.size(); ++k)
            ofCorner[firstCorner[f] + k] = vertexNormals[corners[k]];
    }
    for (int v = 0; v < level.GetNumVertices(); ++v) {
        const auto edges = level.GetVertexEdges(v);
        bool sharp = isSharpVertex(level, v);
        for (int e = 0; e < edges.size() && !sharp; ++e)
            sharp = isSharpEdge(level, edges[e]);
        if (!sharp) continue;
        const auto faces = level.GetVertexFaces(v);
        const std::vector<int> part = smoothParts(level, v);
        std::vector<vec3> sum(part.size(), vec3(0.0f));
        for (size_t i = 0; i < part.size(); ++i)
            sum[part[i]] += cornerNormal(level, faces[int(i)], v, positions, flip);
        for (size_t i = 0; i < part.size(); ++i) {
            const float length = glm::length(sum[part[i]]);
            if (!(length > 0.0f)) continue;
            const int face = faces[int(i)];
            ofCorner[firstCorner[face] + level.GetFaceVertices(face).FindIndex(v)] =
                sum[part[i]] / length;
        }
    }
    std::vector<vec3> out(drawn.corners.size());
    for (size_t i = 0; i < out.size(); ++i)
        out[i] = ofCorner[drawn.corners[i]];
    return out;
}

} // namespace patina
