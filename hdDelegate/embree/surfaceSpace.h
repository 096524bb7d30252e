#pragma once

#include "hdDelegate/embree/surface.h"

namespace patina {

/// Positions and normals in object space, for prims that may be moved often; those of triangles
/// are in Surface::rest.
struct RestShape {
    std::vector<std::vector<vec4>> controlPoints;
    std::vector<std::vector<vec3>> curveNormals;
    std::vector<std::vector<vec4>> points;
    std::vector<std::vector<vec3>> pointNormals;
};

RestShape restOf(const Surface& surface);              ///< before bake()
void restore(const RestShape& rest, Surface& surface); ///< undoes bake()

/// A motion transform at uniform steps over the shutter; a single step where it stands still.
/// @param origin of the space that it is wanted in, see seenFrom()
std::vector<mat4> resample(const MotionTransform& transform, float open, float close,
                           const dvec3& origin = dvec3(0.0));

/// Step `step` of `count` of transforms that resample() made.
mat4 transformAtStep(const std::vector<mat4>& transforms, int step, int count);

/// Moves positions and normals into the group's space, at every time step.
void bake(Surface& surface, const std::vector<mat4>& transforms);

} // namespace patina
