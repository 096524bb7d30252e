// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/scene/sceneLimits.h"

#include <algorithm>

namespace patina {

namespace {

constexpr uint64_t refined = 1000000; ///< TessellationOptions::triangleBudget
constexpr size_t shownPath = 200;     ///< bytes of a path that a message shows

uint64_t trianglesOf(const Mesh& mesh) {
    uint64_t triangles = 0, corners = 0;
    for (const int count : mesh.faceVertexCounts) {
        triangles += uint64_t(std::max(count - 2, 0));
        corners += uint64_t(std::max(count, 0));
    }
    // Counts may say anything: no more corners are drawn than there are.
    triangles = std::min<uint64_t>(triangles, mesh.faceVertexIndices.size());
    corners = std::min<uint64_t>(corners, mesh.faceVertexIndices.size());
    const int level = std::clamp(mesh.refineLevel, 0, 6);
    if (mesh.scheme == SubdivisionScheme::None || level == 0) return triangles;
    return std::max(triangles, std::min(refined, corners << (2 * level - 1)));
}

uint64_t sizeOf(const Sampled<std::vector<vec3>>& points) {
    return points.empty() ? 0 : points.first().size();
}

} // namespace

uint64_t trianglesOf(const Geometry& prim) {
    switch (prim.kind) {
    case GeometryKind::Mesh: return trianglesOf(static_cast<const Mesh&>(prim));
    case GeometryKind::Curves: return sizeOf(static_cast<const Curves&>(prim).points);
    case GeometryKind::Points: return sizeOf(static_cast<const Points&>(prim).points);
    case GeometryKind::Splats: return static_cast<const Splats&>(prim).cloud->positions.size();
    default: return 0;
    }
}

bool SceneLimits::takes(const std::string& path, size_t& count, uint64_t triangles) {
    const uint64_t most = limitOf(Limit::triangles);
    Refused* refused = nullptr;
    if (path.size() > limitOf(Limit::textLength))
        refused = &_refused[0];
    else if (count >= limitOf(Limit::prims))
        refused = &_refused[1];
    else if (triangles > 0 && triangles > most - std::min(_triangles, most))
        refused = &_refused[2];
    if (refused) {
        if (++refused->count == 1) refused->first = path.substr(0, shownPath);
        return false;
    }
    ++count;
    _triangles += triangles;
    return true;
}

void SceneLimits::report() {
    for (const Refused& refused : _refused)
        if (refused.count > 0)
            _diagnostics.warn(refused.first, "",
                              messages::scenePrimsTooMany(refused.what, limitText(refused.limit),
                                                          refused.count - 1));
}

} // namespace patina
