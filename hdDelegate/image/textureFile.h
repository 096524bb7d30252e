// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/image/texelFormat.h"

#include <OpenImageIO/imageio.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace patina {

/// The file of a texture with its header read, or the reason why there is none.
struct TextureFile {
    std::unique_ptr<OIIO::ImageInput> input; ///< null: see error
    OIIO::ImageSpec spec;                    ///< of the first level
    std::string error;                       ///< one line
    TexelLayout layout = TexelLayout::Rgb;
    /// Levels of the file's own that are used: its first, and those behind it that have the sizes
    /// and the texels of a pyramid, as `maketx` writes them.
    int levels = 1;
    std::vector<std::array<int, 2>> origins; ///< of their first texels, x and y

    explicit TextureFile(const std::string& file);
    /// Of all levels, about, as the file stores its texels.
    uint64_t bytes() const;
};

TexelType texelTypeOf(const OIIO::ImageSpec& spec);
OIIO::TypeDesc typeOf(TexelType type);
std::string oneLine(std::string text); ///< of OpenImageIO's messages

} // namespace patina
