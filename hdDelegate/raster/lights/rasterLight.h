// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/lights/lightFields.h"

#include <cstddef>
#include <glm/glm.hpp>

namespace patina {

#define PATINA_STRUCT LightSampleRows
#define PATINA_FIELDS "shaders/raster/lightFields.glsl"
#include "shaders/gpuStruct.inc"

/// A light with the sample of it that a pass takes.
struct GpuLight : LightFields, LightSampleRows {
    /// @param first of its filters in the tables; -1: it has none
    void setFilters(int first) { flags |= (first + 1) << shLights::LIGHT_FILTERS_SHIFT; }
    void samplePlace(const glm::vec3& place) {
        sampled = place;
        set(shLights::LIGHT_AT_PLACE);
    }
    void sampleDirection(const glm::vec3& direction, float pdf) {
        sampled = direction;
        normal = glm::vec3(0.0f);
        density = pdf;
    }
    /// It has no map of its own, but the shadows of the sky.
    void castBySky() { firstMap = maps = fibreMaps = 0; }
};
static_assert(sizeof(GpuLight) == sizeof(LightRows) + sizeof(LightSampleRows));

} // namespace patina
