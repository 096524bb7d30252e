// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/embree/embreeScene.h"
#include "hdDelegate/embree/media/mediumStack.h"

namespace patina {

/// The media that a point stands in, found by looking out: an object whose surface is left more
/// often than entered, in most of a handful of directions, is one that the point is inside of. So
/// a single open sheet fills nothing.
/// @param time of the rays, 0..1 over the shutter
MediumStack mediaAround(const EmbreeScene& scene, const vec3& point, float time);

} // namespace patina
