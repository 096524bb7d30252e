// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/geometry/subdivCage.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace patina {

namespace {

constexpr int maxFaceCorners = 65535; // OpenSubdiv keeps valences in 16 bits
constexpr float infinitelySharp = 10.0f;

bool usesPointTwice(const int* face, int count, std::vector<int>& scratch) {
    if (count == 3) return face[0] == face[1] || face[1] == face[2] || face[2] == face[0];
    scratch.assign(face, face + count);
    std::sort(scratch.begin(), scratch.end());
    return std::adjacent_find(scratch.begin(), scratch.end()) != scratch.end();
}

/// Sharpness in OpenSubdiv's range; negative and NaN ones are 0 and counted.
float clampSharpness(float s, size_t& bad) {
    bad += !(s >= 0.0f);
    return s > 0.0f ? std::min(s, infinitelySharp) : 0.0f;
}

void reportBad(const Mesh& mesh, const char* input, size_t bad, Diagnostics& diagnostics) {
    if (bad > 0) diagnostics.warn(mesh.path, input, messages::sharpnessUnusable(bad));
}

void addCreases(const Mesh& mesh, const std::vector<int>& vertexOf, SubdivCage& cage,
                Diagnostics& diagnostics) {
    if (mesh.creaseIndices.empty() && mesh.creaseLengths.empty()) return;
    size_t points = 0, edges = 0;
    bool fits = true;
    for (int length : mesh.creaseLengths) {
        fits = fits && length >= 2;
        points += size_t(std::max(length, 0));
        edges += size_t(std::max(length - 1, 0));
    }
    const bool perEdge = mesh.creaseSharpnesses.size() == edges;
    if (!fits || points != mesh.creaseIndices.size() ||
        (!perEdge && mesh.creaseSharpnesses.size() != mesh.creaseLengths.size())) {
        diagnostics.warn(mesh.path, "creaseIndices", messages::creasesUnusable);
        return;
    }
    size_t missing = 0, bad = 0, index = 0, edge = 0;
    for (size_t c = 0; c < mesh.creaseLengths.size(); ++c) {
        for (int k = 0; k + 1 < mesh.creaseLengths[c]; ++k, ++edge) {
            const int a = mesh.creaseIndices[index + k], b = mesh.creaseIndices[index + k + 1];
            const auto known = [&](int i) {
                return i >= 0 && size_t(i) < vertexOf.size() && vertexOf[i] >= 0;
            };
            if (!known(a) || !known(b) || a == b) {
                ++missing;
                continue;
            }
            cage.creaseEdges.push_back(vertexOf[a]);
            cage.creaseEdges.push_back(vertexOf[b]);
            cage.creaseWeights.push_back(
                clampSharpness(mesh.creaseSharpnesses[perEdge ? edge : c], bad));
        }
        index += mesh.creaseLengths[c];
    }
    if (missing > 0)
        diagnostics.warn(mesh.path, "creaseIndices", messages::creasesOffFaces(missing));
    reportBad(mesh, "creaseSharpnesses", bad, diagnostics);
}

void addCorners(const Mesh& mesh, const std::vector<int>& vertexOf, SubdivCage& cage,
                Diagnostics& diagnostics) {
    if (mesh.cornerIndices.size() != mesh.cornerSharpnesses.size()) {
        diagnostics.warn(mesh.path, "cornerIndices", messages::cornersUnusable);
        return;
    }
    size_t missing = 0, bad = 0;
    for (size_t i = 0; i < mesh.cornerIndices.size(); ++i) {
        const int point = mesh.cornerIndices[i];
        if (point < 0 || size_t(point) >= vertexOf.size() || vertexOf[point] < 0) {
            ++missing;
            continue;
        }
        cage.cornerVertices.push_back(vertexOf[point]);
        cage.cornerWeights.push_back(clampSharpness(mesh.cornerSharpnesses[i], bad));
    }
    if (missing > 0)
        diagnostics.warn(mesh.path, "cornerIndices", messages::cornersOffFaces(missing));
    reportBad(mesh, "cornerSharpnesses", bad, diagnostics);
}

} // namespace

SubdivCage makeSubdivCage(const Mesh& mesh, const CageFaces& faces, size_t pointCount,
                          Diagnostics& diagnostics) {
    SubdivCage cage;
    std::vector<int> vertexOf(pointCount, -1), scratch;
    size_t unusable = 0;
    for (size_t f = 0; f < faces.size(); ++f) {
        const int count = faces.counts[f];
        const int* face = &mesh.faceVertexIndices[faces.firstCorner[f]];
        if (count > maxFaceCorners || usesPointTwice(face, count, scratch)) {
            ++unusable;
            continue;
        }
        if (faces.isHole(f)) cage.holes.push_back(int(cage.counts.size()));
        cage.counts.push_back(count);
        cage.authoredFace.push_back(faces.authored[f]);
        cage.allTriangles = cage.allTriangles && count == 3;
        for (int k = 0; k < count; ++k) {
            vertexOf[face[k]] = 0;
            cage.vertices.push_back(face[k]);
            cage.corners.push_back(faces.firstCorner[f] + k);
        }
    }
    if (unusable > 0)
        diagnostics.warn(mesh.path, "faceVertexIndices", messages::facesRepeatPoints(unusable));
    for (size_t p = 0; p < pointCount; ++p)
        if (vertexOf[p] == 0) {
            vertexOf[p] = int(cage.points.size());
            cage.points.push_back(int(p));
        }
    for (int& vertex : cage.vertices)
        vertex = vertexOf[vertex];
    addCreases(mesh, vertexOf, cage, diagnostics);
    addCorners(mesh, vertexOf, cage, diagnostics);
    return cage;
}

FaceVaryingChannel mergeCornerValues(const SubdivCage& cage, const std::vector<float>& values,
                                     int components, const std::vector<int>& indices) {
    FaceVaryingChannel channel;
    channel.components = components;
    channel.indices.resize(cage.vertices.size());
    const bool indexed = !indices.empty();
    std::vector<int> sources; // the authored index of each value
    // Per vertex, a chain of the different values that its corners have. Where one has more than
    // anybody would share, the last ones are looked at.
    constexpr int longestSearch = 256;
    std::vector<int> first(cage.points.size(), -1), next;
    for (size_t c = 0; c < cage.vertices.size(); ++c) {
        const float* value = &values[cage.corners[c] * components];
        int* link = &first[cage.vertices[c]];
        int index = *link, steps = 0;
        const int source = indexed ? indices[size_t(cage.corners[c])] : -1;
        const auto isSame = [&](int other) {
            return indexed ? sources[size_t(other)] == source
                           : std::equal(value, value + components,
                                        &channel.values[size_t(other) * components]);
        };
        while (index >= 0 && ++steps <= longestSearch && !isSame(index))
            index = next[index];
        if (index < 0 || steps > longestSearch) {
            index = int(next.size());
            next.push_back(*link);
            *link = index;
            channel.values.insert(channel.values.end(), value, value + components);
            if (indexed) sources.push_back(source);
        }
        channel.indices[c] = index;
    }
    return channel;
}

} // namespace patina
