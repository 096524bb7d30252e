// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

namespace patina {

/// A light with the sample of it that a pass takes, as shaders/raster/pass.glsl has it.
struct GpuLight {
    glm::vec4 sampled, normal, radiance, origin, axis[3], inverse[3], shaping, focusTint, cone,
        shadow, shadowColor, fade, table, shapingX, shapingY;

    /// A light with nothing in it: no shape, no shaping, no shadow, seen by all.
    static GpuLight none() {
        GpuLight g;
        g.sampled = g.normal = g.radiance = g.origin = glm::vec4(0.0f);
        for (int i = 0; i < 3; ++i)
            g.axis[i] = g.inverse[i] = glm::vec4(0.0f, 0.0f, 0.0f, i < 2 ? 1.0f : 0.0f);
        g.axis[2].w = -1.0f;
        g.shaping = g.focusTint = g.cone = g.shadowColor = glm::vec4(0.0f);
        g.shadow = glm::vec4(-1.0f, 0.0f, 0.0f, 0.0f);
        g.fade = glm::vec4(-1.0f, -1.0f, 1.0f, 1.0f);
        g.table = glm::vec4(-1.0f, 0.0f, 0.0f, -1.0f);
        g.shapingX = g.shapingY = glm::vec4(0.0f);
        return g;
    }
};

/// A view from a light, to be drawn into one shadow map.
struct ShadowView {
    /// Of half the angle of one map around a light. What is seen from nearer takes six.
    static constexpr float widestTangent = 2.0f;
    glm::mat4 worldToMap{1.0f};
    glm::vec4 towards{0.0f}; ///< position of the light; direction to it where w is 0
    int category = -1;       ///< of what casts; -1: everything
    bool clampsNear = false; ///< what is nearer casts from the near plane
    /// What casts nothing, as shaders/raster/lightShape.glsl has it: what is inside of a sphere
    /// light, and what lies in the plane of the emitter, which rounding else puts before a sample.
    enum Own { Nothing, Sphere, Plane };
    Own own = Nothing;
    /// Sphere: to its coordinates, see AreaShape. Plane: what is near the sample and within
    /// rounding of its plane to -1..1 each way.
    glm::mat4 worldToLight{1.0f};
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
