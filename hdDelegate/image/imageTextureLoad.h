// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/image/imageTexture.h"
#include "materialNetwork/color/colorSpaces.h"
#include "base/diagnostics.h"

#include <memory>
#include <string>
#include <vector>

namespace patina {

struct TileStore;

/// Where an image comes from, and whom to name when something is wrong with it.
struct ImageSource {
    std::string file;
    std::string colorSpace = "auto";
    std::string prim, input;
    bool finestOnly = false; ///< coarser levels are not made, and not to be sampled
    const RenderingSpace* renderingSpace = &RenderingSpace::rec709(); ///< which colours become
};

/// What a file's header says.
struct ImageHeader {
    std::string problem;  ///< in one line why it cannot be read; empty: nothing is known against it
    std::string tooLarge; ///< why it cannot be read whole; empty: it can
    TexelLayout layout = TexelLayout::Rgb;
    uint64_t bytes = 0;    ///< of all levels, about
    std::string wrapModes; ///< of OpenEXR and TIFF, as `maketx` writes them: "black,periodic"
};
ImageHeader probeImage(const std::string& file);

/// Reads any format of OIIO into a mip pyramid in the rendering space. 8-bit files stay 8-bit where
/// their colour space works channel by channel; 16-bit data stays 16-bit; half stays half. Colour
/// whose three channels are equal everywhere is kept as grey.
/// Colour space "auto" is what the file says, see automaticSpace().
/// Alpha is neither decoded nor multiplied in or out. Of more than four channels the first three
/// (and a fourth named A) are used. NaN and infinite texels become 0, with a warning.
/// @returns null after a warning when the file cannot be read
std::shared_ptr<ImageTexture> loadImageTexture(const ImageSource& source,
                                               const ColorSpaces& colorSpaces,
                                               Diagnostics& diagnostics);

/// A texture of which only the tiles that are sampled are read, when they are. As
/// loadImageTexture() else, to the bit; tiles that cannot be read are magenta, as are those of
/// further levels that are made from them, and the first is warned of.
/// @returns null after a warning when the file cannot be read
std::shared_ptr<ImageTexture> openTiledTexture(const ImageSource& source,
                                               const ColorSpaces& colorSpaces,
                                               const std::shared_ptr<TileStore>& store,
                                               Diagnostics& diagnostics);

/// A colour image in floats of the rendering space.
struct ImageRGB {
    int width = 0, height = 0;
    std::vector<glm::vec3> pixels; ///< top row first
    bool valid = false; ///< false: the file could not be read, one magenta pixel stands for it
};

/// Reads an environment or a light's texture; warns and gives magenta when it cannot.
/// @param source its colour space may be empty: "auto"
ImageRGB loadImageLinear(ImageSource source, Diagnostics& diagnostics);

} // namespace patina
