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

/// A view from a light, to be drawn into one shadow map.
struct ShadowView {
    /// Of half the angle of one map around a light. A light seen from nearer takes six.
    static constexpr float widestTangent = 2.0f;
    glm::mat4 worldToMap{1.0f};
    glm::vec4 towards{0.0f}; ///< position of the light; direction to it where w is 0
    int category = -1;       ///< of what casts; -1: everything
    bool clampsNear = false; ///< what is nearer casts from the near plane
    /// Surfaces that cast no shadow, as in shaders/raster/lightShape.glsl: those inside of a sphere
    /// light, and those in the plane of a flat emitter, which rounding would otherwise put before a
    /// sample.
    enum Own { Nothing, Sphere, Plane };
    Own own = Nothing;
    /// Sphere: to its coordinates, see AreaShape. Plane: what is near the sample and within
    /// rounding of its plane to -1..1 each way.
    glm::mat4 worldToLight{1.0f};

    bool operator==(const ShadowView& o) const {
        return worldToMap == o.worldToMap && towards == o.towards && category == o.category &&
               clampsNear == o.clampsNear && own == o.own && worldToLight == o.worldToLight;
    }
};

/// Boxes that shadows are fitted to.
struct ShadowBounds {
    glm::vec3 sceneMin{0.0f}, sceneMax{0.0f};       ///< all that casts
    glm::vec3 receiverMin{0.0f}, receiverMax{0.0f}; ///< all that the camera sees
    /// The fibres among it, where they lie much closer together; else low is above high.
    glm::vec3 fibresMin{1.0f}, fibresMax{0.0f};

    bool hasFibres() const { return fibresMin.x <= fibresMax.x; }
    /// Fitted to the fibres alone.
    ShadowBounds ofFibres() const {
        return {sceneMin, sceneMax, fibresMin, fibresMax, fibresMin, fibresMax};
    }
};

/// Of half the angle of a cone from a place around all receivers; infinite where there is none.
/// @param beside how far from the place it may begin
float shadowTangent(const glm::vec3& from, float beside, const ShadowBounds& bounds);
/// The view from infinitely far in a direction onto all receivers.
/// @param turn x: of the map about its axis, in turns; y, in [0,1): shifts it by parts of a texel
ShadowView distantShadow(const glm::vec3& toLight, glm::vec2 turn, const ShadowBounds& bounds,
                         int mapSize);

} // namespace patina
