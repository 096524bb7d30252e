// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/emissionProfile.h"

#include <glm/glm.hpp>

#include <memory>
#include <string>
#include <vector>

namespace patina {

enum class TextureWrap { Black, Clamp, Repeat, Mirror };

/// A texture that a material reads, and how it is read.
struct TextureRequest {
    std::string file; ///< resolved path; `<UDIM>` stands for the tile number
    std::string
        colorSpace; ///< "auto", "raw"/"none", "sRGB"/"srgb_texture", "lin_rec709", or any OCIO name
    TextureWrap wrapS = TextureWrap::Repeat, wrapT = TextureWrap::Repeat;
    bool nearest = false;                    ///< no filtering at all
    bool ownWrapS = false, ownWrapT = false; ///< the file's own mode, if it has one, comes first
    std::string prim, input;                 ///< for messages
};

/// How a texture lies in the plane, for back ends with samplers of their own.
struct TextureTiling {
    std::vector<int> tiles; ///< UDIM numbers of those that exist, ascending; empty: no UDIM texture
    TextureWrap wrapS = TextureWrap::Repeat, wrapT = TextureWrap::Repeat;
};

/// Gives filtered texels in linear Rec.709. Implemented where images are read; thread safe after
/// open().
class TextureSource {
public:
    virtual ~TextureSource() = default;
    /// @returns a handle; equal requests share one. A file that cannot be read gives a handle too
    /// (valid() says false), after a warning.
    virtual int open(const TextureRequest& request) = 0;
    virtual bool valid(int handle) const = 0;
    /// @param uv texture coordinates, v up (0,0 is the lower left corner)
    /// @param footprint width of the filter in uv units, 0 for the finest level
    virtual glm::vec4 sample(int handle, glm::vec2 uv, float footprint) const = 0;
    virtual int channels(int handle) const = 0; ///< of the file: 1..4
    virtual TextureTiling tiling(int /*handle*/) const { return {}; }

    /// Reads an IES file; file, prim and input of the request count.
    /// @returns null after a warning when it cannot be read, or where none are read
    virtual std::shared_ptr<const EmissionProfile> openProfile(const TextureRequest&) {
        return nullptr;
    }
};

} // namespace patina
