// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/image/textureSystem.h"
#include "hdDelegate/raster/gl/glResources.h"
#include "base/diagnostics.h"
#include "materialNetwork/glsl/glslTextures.h"

#include <map>
#include <memory>
#include <vector>

namespace patina {

/// The textures of materials in the driver's memory, each with the sampler that its request asks
/// for.
class RasterTextures {
public:
    /// @param format of the texels: GL_RGBA16F is what images show, GL_RGBA32F all digits
    RasterTextures(const TextureSystem& textures, Diagnostics& diagnostics,
                   GLenum format = GL_RGBA16F)
        : _textures(textures), _diagnostics(diagnostics), _format(format) {}

    /// The contents of a material's units, in their order: the texels of a handle, or an array of
    /// tiles or of textures. Magenta where there are none. Those that are larger than the driver
    /// takes start at a smaller level, with a warning.
    std::vector<std::shared_ptr<const GlTexture>> units(const std::vector<GlslTexture>& textures);

private:
    struct Layer;
    std::shared_ptr<const GlTexture> plain(int handle);
    std::shared_ptr<const GlTexture> array(const std::vector<const GlslTexture*>& textures);
    void upload(const GlTexture& texture, const Layer& layer, int index) const;
    const TextureSystem& _textures;
    Diagnostics& _diagnostics;
    GLenum _format;
    std::map<int, std::shared_ptr<const GlTexture>> _known;               ///< by handle
    std::map<std::vector<int>, std::shared_ptr<const GlTexture>> _arrays; ///< by handles and tiles
};

} // namespace patina
