// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/embree/aovWriter.h"
#include "hdDelegate/embree/worldRays.h"
#include "hdDelegate/film/sampler.h"

#include <vector>

namespace patina {

/// The value of one camera ray without lights and materials: 0..1, the share of the cosine-weighted
/// hemisphere over the surface (on the ray's side) that sees no geometry at any distance.
/// A grey preview, and a workload of plain rays to compare with other renderers.
struct AmbientOcclusion {
    const WorldRays& scene;
    int rays; ///< per hit, cosine distributed, stratified

    /// @param target where AOVs are written; @param rayCount is counted up by the rays traced
    /// @param depth of what is hit, as of the AOV
    /// @returns visibility, or a negative number when the ray meets nothing
    float sample(const CameraRay& ray, Sampler& sampler, const std::vector<AovSpec>& aovs,
                 const AovTarget& target, const CameraRays& camera, uint64_t& rayCount,
                 float& depth) const;
};

} // namespace patina
