// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/lights/resolvedLight.h"
#include "shaders/lights.h"

#include <cstddef>
#include <glm/glm.hpp>

namespace patina {

#define PATINA_STRUCT LightRows
#define PATINA_FIELDS "shaders/lights/fields.glsl"
#include "shaders/gpuStruct.inc"

/// A light as shaders/lights/light.glsl reads it on a GPU; shaders/lights/fields.glsl says what
/// each field is.
struct LightFields : LightRows {
    bool is(int flag) const { return (flags & flag) != 0; }
    void set(int flag, bool on = true) { flags = on ? flags | flag : flags & ~flag; }
    void setAxes(const mat3& m) { axis0 = m[0], axis1 = m[1], axis2 = m[2]; }
    void setInverse(const mat3& m) { inverse0 = m[0], inverse1 = m[1], inverse2 = m[2]; }
    /// All but radiance, tables and, where they are not even over a line, samples.
    void setLight(const Light& light, const ResolvedLight& resolved, const LightPose& pose);
    void setShaping(const LightShaping& shaping);
};

} // namespace patina
