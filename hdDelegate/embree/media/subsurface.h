// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/embree/lightSampling.h"

namespace patina {

/// Takes a path through subsurface scattering, light at its exit included.
/// @returns false when the path ends beneath the surface
bool scatterBeneath(const EmbreeScene& scene, const LightSampling& lights, Path& path,
                    const SurfacePoint& point, const Hit& hit, const SubsurfaceEntry& entry,
                    TraceCounters& counters);

} // namespace patina
