// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/geometry/nurbs.h"
#include "hdDelegate/geometry/tests/meshFixtures.h"

namespace patina {

inline Mesh patchMesh(const NurbsPatch& patch, std::vector<vec3> points) {
    Mesh mesh;
    mesh.path = "/patch";
    mesh.points = std::move(points);
    mesh.patch = std::make_shared<NurbsPatch>(patch);
    setNurbsCage(mesh);
    return mesh;
}

/// The unit sphere: a half circle in v, from the south pole to the north, turned around z in u.
/// Each is made of rational quadratic arcs of a quarter turn.
inline Mesh spherePatch() {
    NurbsPatch patch;
    patch.u = {9, 3, {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4}};
    patch.v = {5, 3, {0, 0, 0, 1, 1, 2, 2, 2}};
    const double w = std::sqrt(0.5), x[] = {1, 1, 0, -1, -1, -1, 0, 1, 1};
    std::vector<vec3> points;
    for (int j = 0; j < 5; ++j)
        for (int i = 0; i < 9; ++i) {
            const double ring = x[(j + 6) % 8];
            points.push_back(vec3(x[i] * ring, x[(i + 6) % 8] * ring, -x[j]));
            patch.weights.push_back((i % 2 ? w : 1.0) * (j % 2 ? w : 1.0));
        }
    return patchMesh(patch, points);
}

} // namespace patina
