// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <glm/glm.hpp>

namespace patina {

#define PATINA_STRUCT InstanceRows
#define PATINA_FIELDS "shaders/raster/instanceFields.glsl"
#include "shaders/gpuStruct.inc"

/// An instance as instance.glsl reads it.
struct GpuInstance : InstanceRows {
    GpuInstance() { instanceIds.x = -1; }
    void place(const glm::mat4& toWorld);
};

} // namespace patina
