// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/geometry/triangleMesh.h"

#include "base/maths.h"

namespace patina {

/// Derivatives of position by texture coordinates.
struct TangentFrame {
    vec3 dpdu{1, 0, 0}, dpdv{0, 1, 0};
    bool fromTexture = false; ///< false: the coordinates do not span the triangle, and both vectors
                              ///< are arbitrary, orthonormal and in its plane
};

/// Derivatives over a triangle from positions and texture coordinates of its corners. Never NaN:
/// without usable coordinates an orthonormal pair that is continuous in the normal but for one pole
/// (Duff et al. 2017); for a degenerate triangle x and y.
TangentFrame tangentFrame(const vec3 positions[3], const vec2 st[3]);

/// The same for a triangle of a mesh. @param st attribute of two or more components, or null
TangentFrame tangentFrame(const TriangleMesh& mesh, const MeshAttribute* st, unsigned triangle,
                          size_t step = 0);

} // namespace patina
