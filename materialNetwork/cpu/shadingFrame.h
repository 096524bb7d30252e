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

} // namespace patina
