// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/geometry/tetSurface.h"

#include <algorithm>
#include <array>
#include <unordered_map>

namespace patina {

namespace {

using Triangle = std::array<int, 3>;

struct Hash {
    size_t operator()(const Triangle& t) const {
        uint64_t hash = 1469598103934665603ull;
        for (const int i : t)
            hash = (hash ^ uint64_t(uint32_t(i))) * 1099511628211ull;
        return size_t(hash ^ (hash >> 32));
    }
};

Triangle sorted(Triangle t) {
    std::sort(t.begin(), t.end());
    return t;
}

/// Triangles of a tetrahedron, counterclockwise from outside where it is right-handed.
constexpr int sides[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};

/// Triangles, by their points in order -> tetrahedron that has them, -1 where two do.
std::unordered_map<Triangle, int, Hash> ownersOf(const std::vector<int>& tets) {
    std::unordered_map<Triangle, int, Hash> owners;
    for (size_t t = 0; 4 * t + 3 < tets.size(); ++t)
        for (const auto& side : sides) {
            const Triangle key =
                sorted({tets[4 * t + size_t(side[0])], tets[4 * t + size_t(side[1])],
                        tets[4 * t + size_t(side[2])]});
            const auto inserted = owners.emplace(key, int(t));
            if (!inserted.second) inserted.first->second = -1;
        }
    return owners;
}

/// Leaves out tetrahedra with points that are not there.
std::vector<int> wholeTets(const TetMesh& mesh, size_t points, Diagnostics& diagnostics) {
    std::vector<int> whole;
    size_t bad = 0;
    for (size_t t = 0; 4 * t + 3 < mesh.tets.size(); ++t) {
        bool fits = true;
        for (size_t k = 0; k < 4; ++k) {
            const int i = mesh.tets[4 * t + k];
            fits = fits && i >= 0 && size_t(i) < points;
        }
        if (fits)
            whole.insert(whole.end(), mesh.tets.begin() + long(4 * t),
                         mesh.tets.begin() + long(4 * t + 4));
        else
            ++bad;
    }
    if (bad > 0) diagnostics.warn(mesh.path, "tetVertexIndices", messages::tetsOutOfRange(bad));
    return whole;
}

} // namespace

std::shared_ptr<const Mesh> surfaceOf(const TetMesh& mesh, Diagnostics& diagnostics) {
    auto out = std::make_shared<Mesh>(mesh);
    out->scheme = SubdivisionScheme::None;
    out->patch = nullptr;
    out->faceVertexIndices = mesh.surface;
    const bool computed = mesh.surface.empty();
    if (computed) {
        const std::vector<int> tets =
            wholeTets(mesh, mesh.points.empty() ? 0 : mesh.points.first().size(), diagnostics);
        const auto owners = ownersOf(tets);
        for (size_t t = 0; 4 * t < tets.size(); ++t)
            for (const auto& side : sides) {
                const Triangle triangle = {tets[4 * t + size_t(side[0])],
                                           tets[4 * t + size_t(side[1])],
                                           tets[4 * t + size_t(side[2])]};
                if (owners.at(sorted(triangle)) == int(t))
                    out->faceVertexIndices.insert(out->faceVertexIndices.end(), triangle.begin(),
                                                  triangle.end());
            }
    }
    const size_t triangles = out->faceVertexIndices.size() / 3;
    out->faceVertexIndices.resize(3 * triangles);
    out->faceVertexCounts.assign(triangles, 3);
    const size_t tetCount = mesh.tets.size() / 4;
    if (tetCount == triangles) return out;
    std::unordered_map<Triangle, int, Hash> owners;
    for (Primvar& primvar : out->primvars) {
        const size_t elements =
            primvar.indices.empty()
                ? primvar.values.size() / size_t(std::max(primvar.components, 1))
                : primvar.indices.size();
        if (primvar.interpolation != Interpolation::Uniform || elements != tetCount) continue;
        if (owners.empty()) owners = ownersOf(mesh.tets);
        std::vector<int> indices;
        for (size_t t = 0; t < triangles; ++t) {
            const int* v = &out->faceVertexIndices[3 * t];
            const auto owner = owners.find(sorted({v[0], v[1], v[2]}));
            const int tet = owner == owners.end() ? -1 : owner->second;
            indices.push_back(tet < 0 || primvar.indices.empty() ? tet
                                                                 : primvar.indices[size_t(tet)]);
        }
        primvar.indices = std::move(indices);
    }
    return out;
}

} // namespace patina
