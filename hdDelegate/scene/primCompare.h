// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/scene/camera.h"
#include "hdDelegate/scene/geometry.h"

namespace patina {

/// Whether two prims have the same shape in their own space: points, topology, primvars, subsets'
/// faces and group. Transforms, materials, visibility, categories, tags and ids may differ.
bool sameShape(const Geometry& a, const Geometry& b);

bool sameTransform(const MotionTransform& a, const MotionTransform& b);

/// Whether two cameras see the same, whatever their paths.
bool sameCamera(const Camera& a, const Camera& b);

} // namespace patina
