// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/film/imageFile.h"

#include <OpenImageIO/imageio.h>

#include <functional>
#include <memory>

namespace patina {

enum class ChannelStore { Float, Half, Int };

/// One channel on its way into a file.
struct ChannelSource {
    std::string name;
    ChannelStore store;
    const float* data; ///< of the first pixel; ids are float bits of int32 when bits is set
    size_t stride;     ///< floats from pixel to pixel
    bool bits = false;
};

/// Which part of the pixels is written, and where it lies in the uncropped image.
struct ImagePlacement {
    int width, height;               ///< written
    int sourceX, sourceY;            ///< of its first pixel in the source
    int x, y;                        ///< of its first pixel in the uncropped image
    int displayWidth, displayHeight; ///< uncropped
};

/// @throws std::runtime_error when nothing is left or the sizes contradict each other
ImagePlacement placementOf(int width, int height, const ImageOptions& options);

/// @throws std::runtime_error naming an unknown extension
std::unique_ptr<OIIO::ImageOutput> createOutput(const std::string& path);

/// A spec with size, windows, pixel aspect ratio and metadata.
OIIO::ImageSpec makeSpec(const ImagePlacement& placement, int channels, OIIO::TypeDesc type,
                         const ImageOptions& options, const Metadata& metadata);

/// Opens a temporary beside path, lets write fill it and puts it in its place.
/// @param write returns false when the output has an error
void writeAtomically(const std::string& path, const OIIO::ImageSpec& spec,
                     const std::function<bool(OIIO::ImageOutput&)>& write);

void writeExr(const std::vector<ChannelSource>& channels, int sourceWidth,
              const ImagePlacement& placement, const std::string& path, const ImageOptions& options,
              const Metadata& metadata);

/// OpenEXR does not tell its caller when one of its own threads could not compress its rows.
/// @param path that messages name; file: what was written
/// @throws TemporaryFailure when rows are missing, std::runtime_error when it cannot be read
void checkExrIsWhole(const std::string& path, const std::string& file);

/// @param channels 1, 3 or 4: grey, colour, colour multiplied by alpha
void writeDisplayImage(const float* pixels, int channels, int sourceWidth,
                       const ImagePlacement& placement, const std::string& path,
                       const ImageOptions& options, const Metadata& metadata);

/// One line of an error text.
std::string firstLine(const std::string& text);

bool isExr(const std::string& path);

} // namespace patina
