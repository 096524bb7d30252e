// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/embree/media/splatScene.h"
#include "hdDelegate/embree/media/volumeScene.h"

namespace patina {

/// What fills space without surfaces: volumes and splats.
struct FilledSpace {
    VolumeScene volumes;
    SplatScene splats;

    bool empty() const { return volumes.empty() && splats.empty(); }
    /// What they let through; of volumes an estimate.
    vec3 transmittance(const SplatScene::Ray& ray, Sampler& sampler) const {
        vec3 left(1.0f);
        if (!volumes.empty())
            left = volumes.transmittance(ray.origin, ray.direction, ray.far, ray.rays, sampler);
        if (!splats.empty() && left != vec3(0.0f)) left *= splats.transmittance(ray);
        return left;
    }
};

} // namespace patina
