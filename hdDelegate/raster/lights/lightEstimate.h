// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/lights/areaShape.h"
#include "hdDelegate/raster/lights/rasterLight.h"

namespace patina {

namespace shLights {
#define PATINA_FN inline
#include "shaders/lights/estimate.glsl"
#undef PATINA_FN
} // namespace shLights

#define PATINA_STRUCT LightEstimateRows
#define PATINA_FIELDS "shaders/lights/estimateFields.glsl"
#include "shaders/gpuStruct.inc"

/// What tells about how much a light sends to a place, as shaders/lights/estimate.glsl uses it.
struct LightEstimate : LightEstimateRows {
    LightEstimate() {
        start = -2.0f; // the same in all directions
        slope = least = 1.0f;
    }
    /// Of what leaves the light towards a ball; between the extremes over the ball.
    float towards(const vec3& center, float radius) const;
};

/// Of a light at a place.
/// @param shape of lights that have one, else null
/// @param brighter factor of images and profiles, at most
LightEstimate estimateOf(const GpuLight& light, const AreaShape* shape, float brighter);

} // namespace patina
