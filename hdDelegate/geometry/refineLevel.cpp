// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/geometry/refineLevel.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

constexpr int highestLevel = 6;

float longestEdge(const Mesh& mesh, const std::vector<vec3>& points, const CageFaces& faces) {
    float longest = 0.0f;
    for (size_t f = 0; f < faces.size(); ++f) {
        const int* face = &mesh.faceVertexIndices[faces.firstCorner[f]];
        for (int k = 0; k < faces.counts[f]; ++k) {
            const vec3 edge = points[face[(k + 1) % faces.counts[f]]] - points[face[k]];
            longest = std::max(longest, glm::dot(edge, edge));
        }
    }
    return std::sqrt(longest);
}

/// Whether every face is flat to a thousandth of its size.
bool planarFaces(const Mesh& mesh, const std::vector<vec3>& points, const CageFaces& faces) {
    for (size_t f = 0; f < faces.size(); ++f) {
        const int* face = &mesh.faceVertexIndices[faces.firstCorner[f]];
        for (int k = 3; k < faces.counts[f]; ++k) {
            const vec3 a = points[face[1]] - points[face[0]], b = points[face[2]] - points[face[0]];
            const vec3 c = points[face[k]] - points[face[0]];
            const vec3 n = glm::cross(a, b);
            if (std::abs(glm::dot(n, c)) > 1e-3f * glm::length(n) * glm::length(c)) return false;
        }
    }
    return true;
}

double trianglesAt(const Mesh& mesh, const CageFaces& faces, int level) {
    double corners = 0.0, triangles = 0.0;
    for (int count : faces.counts) {
        corners += count;
        triangles += count - 2;
    }
    if (level == 0) return triangles;
    const bool loop = mesh.scheme == SubdivisionScheme::Loop && corners == 3.0 * faces.size();
    return loop ? std::ldexp(triangles, 2 * level) : std::ldexp(corners, 2 * level - 1);
}

} // namespace

int chooseRefineLevel(const Mesh& mesh, const PointSteps& points, const CageFaces& faces,
                      const TessellationOptions& options, Diagnostics& diagnostics) {
    const int maximum = std::clamp(options.maxRefineLevel, 0, highestLevel);
    const int floor = std::max(mesh.refineLevel, 0);
    int level = floor;
    const std::vector<vec3>& first = points.steps.front();
    const bool stays =
        mesh.scheme == SubdivisionScheme::Bilinear && planarFaces(mesh, first, faces);
    if (options.targetEdge > 0.0f && !stays) {
        const float ratio = longestEdge(mesh, first, faces) / options.targetEdge;
        if (ratio > 1.0f) level = std::max(level, int(std::ceil(std::log2(std::min(ratio, 1e9f)))));
    }
    level = std::min(level, maximum);
    while (level > floor && trianglesAt(mesh, faces, level) > double(options.edgeBudget))
        --level;
    while (level > 0 && trianglesAt(mesh, faces, level) > double(options.triangleBudget))
        --level;
    if (level < floor)
        diagnostics.warn(mesh.path, "refineLevel", messages::refineLevelTooHigh(floor, level));
    return level;
}

} // namespace patina
