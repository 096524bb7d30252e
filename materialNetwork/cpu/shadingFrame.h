#pragma once

#include "materialNetwork/cpu/bsdf.h"
#include "materialNetwork/cpu/shadingPoint.h"

namespace patina {

/// Turns a normal as little as needed so that v sees its front and the mirror direction of v lies
/// above the surface, both within a small margin. Interpolated and mapped normals at grazing angles
/// would otherwise be black.
/// @param n normal, v direction to the viewer, g geometric normal on the viewer's side; all unit
glm::vec3 bendNormal(glm::vec3 n, const glm::vec3& v, const glm::vec3& g);

/// Builds the frame of a lobe.
/// @param normal,tangent as the material gives them (world space, any length), or null for those
/// of the point; unusable ones (zero, not finite, parallel) fall back to those of the point
/// @param flips turn the frame to the viewer instead of keeping z on the outside
BsdfFrame makeFrame(const ShadingPoint& point, const glm::vec3* normal, const glm::vec3* tangent,
                    bool flips);

/// Two unit vectors that form a right-handed basis with n (Duff et al. 2017).
inline void completeBasis(const glm::vec3& n, glm::vec3& x, glm::vec3& y) {
    const float side = n.z >= 0.0f ? 1.0f : -1.0f;
    const float a = -1.0f / (side + n.z), b = n.x * n.y * a;
    x = {1.0f + side * n.x * n.x * a, side * b, -side * n.x};
    y = {b, side + n.y * n.y * a, -n.y};
}

} // namespace patina
