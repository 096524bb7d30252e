// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include <vector>

namespace patina::measure {

/// A latlong image as a texture of the rasterizer: smaller versions by boxes of two by two, linear
/// within and between them, around in longitude and stopped at the poles.
class SkyTexture {
public:
    /// @param texels rows from the pole down, width and height powers of two
    SkyTexture(int width, int height, std::vector<glm::vec3> texels);

    int levels() const { return int(_levels.size()); }
    /// As textureLod(), of a direction of the dome. @param lod clamped to what there is
    glm::vec3 at(const glm::vec3& direction, float lod) const;
    /// Value at u, v within [0, 1] of one level.
    glm::vec3 at(glm::vec2 uv, int level) const;

    /// As domeTexel() of shaders/lights/dome.glsl.
    static glm::vec2 place(const glm::vec3& direction);
    /// The direction of a texel's middle.
    static glm::vec3 direction(int x, int y, int width, int height);

private:
    struct Level {
        int width, height;
        std::vector<glm::vec3> texels;
    };
    std::vector<Level> _levels;
};

} // namespace patina::measure
