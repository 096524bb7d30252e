// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/image/textureSystem.h"
#include "materialNetwork/material.h"

#include <glm/glm.hpp>

#include <memory>
#include <string>
#include <vector>

namespace patina {

/// Numbers of one material at one shading point, as the driver computes them from the text that
/// the rasterizer draws with. Light that passes straight on is part of them, as a delta is. The
/// normal is +z, the tangent +x; directions are unit vectors.
class RasterBsdf {
public:
    struct Query {
        glm::vec4 wo{0, 0, 1, 0};
        glm::vec4 wi{0, 0, 1, 0};
        glm::vec4 u{0.0f}; ///< w chooses the lobe
    };
    struct Answer {
        glm::vec4 diffuse;  ///< f |cos| of wi; w: density of sample()
        glm::vec4 specular; ///< f |cos| of wi; w: presence
        glm::vec4 wi;       ///< of the sample; w: event, 0 for none
        glm::vec4 weight;   ///< f |cos| / pdf; w: pdf
        glm::vec4 albedo;
        glm::vec4 emission;
    };

    /// @param textures that the program was compiled with
    /// @param like of one context, which is used again; so is the shader of one whose text is the
    /// same, as it is where nothing but numbers differs
    /// @returns null with one line in `error` where there is no OpenGL, or the driver does not take
    /// the text
    static std::unique_ptr<RasterBsdf> make(std::shared_ptr<const MaterialProgram> program,
                                            const TextureSystem& textures, Diagnostics& diagnostics,
                                            std::string& error,
                                            const std::vector<const RasterBsdf*>& like = {});
    ~RasterBsdf();

    bool sharesShader() const; ///< none was compiled

    /// Answers all queries at once. `uv`, when given, is the value of every primvar of two floats,
    /// and with 0 as third coordinate the position.
    std::vector<Answer> evaluate(const std::vector<Query>& queries, const glm::vec2* uv) const;

private:
    struct Gpu;
    explicit RasterBsdf(std::unique_ptr<Gpu> gpu);
    std::unique_ptr<Gpu> _gpu;
};

} // namespace patina
