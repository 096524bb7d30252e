// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/geometry/triangleMesh.h"

#include "base/maths.h"

#include <string>
#include <vector>

namespace patina {

/// Derivatives of position by texture coordinates.
struct TangentFrame {
    vec3 dpdu{1, 0, 0}, dpdv{0, 1, 0};
    bool fromTexture = false; ///< false: the coordinates do not span the triangle, and both vectors
                              ///< are arbitrary, orthonormal and in its plane
    bool mirrored = false;    ///< seen from the front, dpdv is to the right of dpdu
    float uvPerLength = 0.0f; ///< root of texture area per area

    /// As a material reads it, tangentPrimvar(); zero where it is not from the texture.
    vec4 value() const { return fromTexture ? vec4(dpdu, mirrored ? -1.0f : 1.0f) : vec4(0.0f); }
};

/// Derivatives over a triangle from positions and texture coordinates of its corners. Never NaN:
/// without usable coordinates an orthonormal pair that is continuous in the normal but for one pole
/// (Duff et al. 2017); for a degenerate triangle x and y.
TangentFrame tangentFrame(const vec3 positions[3], const vec2 st[3]);

/// The same for a triangle of a mesh. @param st attribute of two or more components, or null
TangentFrame tangentFrame(const TriangleMesh& mesh, const MeshAttribute* st, unsigned triangle,
                          size_t step = 0);

/// The place in a list of the uv set that tangents follow: the one that is wanted, else st, uv,
/// UVMap or map1, else the first by name. A uv set has two floats that vary over a face.
/// @returns -1 where there is none
int tangentSet(const std::vector<MeshAttribute>& attributes, const std::string& wanted);

/// The same of a mesh, or null.
const MeshAttribute* tangentSet(const TriangleMesh& mesh, const std::string& wanted);

/// Where a mesh has a primvar of a material. The tangents of a uv set are one, tangentPrimvar().
struct MeshPrimvar {
    const MeshAttribute* attribute = nullptr; ///< null: the mesh has none
    bool tangents = false;                    ///< those of the attribute

    MeshPrimvar(const TriangleMesh& mesh, const std::string& name);

    /// At a point of a triangle, as evalAttribute(). @returns false where there is no value
    bool read(const TriangleMesh& mesh, unsigned triangle, float u, float v, float out[4]) const;
};

} // namespace patina
