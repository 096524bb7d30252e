// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/embree/surface.h"

namespace patina {

/// The parts of a shape that are placed, in the prim's own space.
PlacedShape atRest(const PrimShape& shape);
/// The same, which the shape then lacks.
PlacedShape takeAtRest(PrimShape& shape);

/// Takes the moments of TessellationOptions::withMoments out of what is at rest.
PlacedShape takeMoments(PlacedShape& shape);

/// Value of a sampled quantity at a time, linear between samples and constant outside.
/// @param origin of the space that it is wanted in, see seenFrom()
mat4 interpolate(const MotionTransform& transform, float time, const dvec3& origin = dvec3(0.0));

/// A motion transform at uniform steps over the shutter; a single step where it stands still.
/// @param origin of the space that it is wanted in, see seenFrom()
std::vector<mat4> resample(const MotionTransform& transform, float open, float close,
                           const dvec3& origin = dvec3(0.0));

/// Step `step` of `count` of transforms that resample() made.
mat4 transformAtStep(const std::vector<mat4>& transforms, int step, int count);

/// Moves what is at rest into the group's space, at every time step.
void bake(Surface& surface, const std::vector<mat4>& transforms);

} // namespace patina
