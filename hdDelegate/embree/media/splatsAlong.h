// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/embree/embreeScene.h"
#include "hdDelegate/embree/path.h"

namespace patina {

// Splats along the ray of a path: they shine and absorb, and scatter nothing.

/// Adds what splats along a path's ray shine, up to `end`.
/// @returns what they let through up to `way`
float passSplats(const EmbreeScene& scene, Path& path, float end, float way);

/// Light of splats at a vertex, from one sample: up to the first surface, on the side that the
/// vertex is seen from. Samples of the BSDF have all else to themselves.
vec3 sampleSplats(const EmbreeScene& scene, Path& path, const SurfacePoint& point,
                  const VertexBsdf& bsdf, TraceCounters& counters);

} // namespace patina
