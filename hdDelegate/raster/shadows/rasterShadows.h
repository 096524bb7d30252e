// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/raster/lights/rasterLight.h"

#include <vector>

namespace patina {

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

/// The shadow maps that are drawn for the samples of a pass.
struct ShadowPlan {
    static constexpr int maxMaps = 32;       ///< in the full size
    static constexpr int maxSmallMaps = 128; ///< in half of it, where lights need more
    static constexpr int maxTinyMaps = 512;  ///< smaller still, for as few pixels a side
    static constexpr int maxManyMaps = 1280; ///< where pixels choose among lights
    static constexpr int leastManyMap = 128; ///< texels along their sides

    /// Small images gain nothing from finer maps, and drawing these is most of a pass there.
    /// @param pixels along the longer side of the image
    static int enoughFor(int pixels, int mapSize);
    /// Gives a sample of a light its maps.
    /// @param category of what casts; -1: everything
    /// @param turn as of distantShadow()
    /// @param maximum maps that there is room for; a light that needs more is not shadowed
    void cast(GpuLight& light, int category, glm::vec2 turn, const ShadowBounds& bounds,
              int maximum);

    std::vector<ShadowView> views; ///< in the order of the layers of the maps
    int mapSize = 0;
    bool fibres = false; ///< lights have maps for fibres, too

private:
    /// @returns how many maps show the receivers; 0 without room
    int castOnto(const GpuLight& light, int category, glm::vec2 turn, const ShadowBounds& bounds,
                 int maximum);
};

} // namespace patina
