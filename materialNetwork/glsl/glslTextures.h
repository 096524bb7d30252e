// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/messages.h"
#include "materialNetwork/textureSource.h"

#include <glm/glm.hpp>

#include <string>
#include <vector>

namespace patina {

/// A texture that the text of a material reads.
struct GlslTexture {
    int handle = -1;
    int unit = 0;           ///< `sampler<unit>` of the text
    bool array = false;     ///< the unit is an array: of UDIM tiles, or of what has no unit alone
    bool shared = false;    ///< the unit holds other textures too, all of one size
    int firstLayer = 0;     ///< of the array
    std::vector<int> tiles; ///< UDIM numbers, a layer each; empty: one layer
};

/// Texture units that a material may use: OpenGL promises 16 to every stage.
constexpr int glslTextureUnits = 16;

/// Gives textures their units, and writes the functions `texture<i>(uv, footprint)` and
/// `texel(i, uv, footprint)`. Those beyond the units share the last one.
/// @param parameters gets tables of the tiles
/// @param leftOut gets what cannot be shown as it should
/// @param arrays whether there may be arrays; else UDIM shows its first tile, and there may be more
///        units than OpenGL promises
std::string glslTextureText(const std::vector<int>& handles, const TextureSource* source,
                            bool arrays, std::vector<GlslTexture>& textures,
                            std::vector<glm::vec4>& parameters, std::vector<Message>& leftOut);

} // namespace patina
