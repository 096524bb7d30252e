// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <string>

namespace patina {

/// The linear colour space in which light is added and multiplied: UsdRenderSettings'
/// renderingColorSpace. Each one is made once and lives as long as the program, so that pointers
/// tell them apart.
struct RenderingSpace {
    std::string name; ///< as the configuration spells it; empty: linear Rec.709, the default
    /// CIE 1931 xy of red, green, blue and white.
    std::array<float, 8> chromaticities{0.64f, 0.33f, 0.30f, 0.60f, 0.15f, 0.06f, 0.3127f, 0.3290f};
    glm::mat3 fromRec709{1.0f}, toRec709{1.0f};

    bool isRec709() const { return name.empty(); }
    /// A colour of linear Rec.709 in this space. Greys stay as they are, to the bit: a weight of
    /// white is still 1.
    glm::vec3 from709(const glm::vec3& color) const;
    /// The way back.
    glm::vec3 to709(const glm::vec3& color) const;

    static const RenderingSpace& rec709();
    /// @param name of ColorSpaces::shared(); empty: the default
    /// @returns null where there is no such space, or it is not linear
    static const RenderingSpace* find(const std::string& name);
};

} // namespace patina
