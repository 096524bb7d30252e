// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/messages.h"
#include "materialNetwork/ir/materialIr.h"

#include <glm/glm.hpp>

#include <string>
#include <vector>

namespace patina {

/// A material in GLSL ES 3.00, for WebGL2, which has neither storage buffers nor bindings.
///
/// The text is that of makeGlslMaterial() with every parameter written as a number, samplers
/// without bindings, and primvar `i` read by `vec4 primvar<i>(vec4 fallback)`, which the host
/// defines before the text. No string of a scene is part of it.
struct GlslWebMaterial {
    std::string text;
    std::vector<int> textures;    ///< TextureSource handle of each `sampler<i>`
    std::vector<Message> leftOut; ///< as GlslMaterial::leftOut, and NaN that became 0
    /// Texels of a row `parameterTable`, where the text finds parameters by a number that it works
    /// out; else empty.
    std::vector<glm::vec4> parameters;
    bool presence = false;
    bool emission = false;
};

GlslWebMaterial makeGlslWebMaterial(const MaterialIr& ir);

} // namespace patina
