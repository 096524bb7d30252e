// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/film/film.h"
#include "hdDelegate/film/outliers.h"
#include "materialNetwork/color/colorSpaces.h"

#include <map>
#include <string>
#include <variant>
#include <vector>

namespace patina {

using MetadataValue = std::variant<std::string, int, double>;
/// Metadata of an image about its making. Names are those of OIIO (Software, DateTime, ...) or
/// free.
using Metadata = std::map<std::string, MetadataValue>;

/// How a film becomes a file.
struct ImageOptions {
    /// The AOVs to write, in order; empty means all of the film for OpenEXR, color and alpha for
    /// other formats, which hold nothing else.
    std::vector<std::string> aovs;

    int displayWidth = 0, displayHeight = 0; ///< of the uncropped image; 0: as the film
    /// Crop: xmin, ymin, xmax, ymax inclusive in the uncropped image; xmax < xmin means none. A
    /// film of the size of the uncropped image is cropped, one of the size of the window is placed.
    int dataWindow[4] = {0, 0, -1, -1};
    double pixelAspectRatio = 1.0;

    bool deep = false;       ///< the film's deep pixels (film/deepPixels.h), instead of its AOVs
    bool half = false;       ///< OpenEXR: colour, alpha and albedo as half; data always is float
    bool integerIds = false; ///< OpenEXR: ids as UINT; else as float, which is exact below 2^24
    std::string compression = "zip"; ///< OpenEXR: none, rle, zip, zips, piz, pxr24, b44, dwaa...

    int bits = 8;              ///< of other formats: 8, 16, or 32 (TIFF: linear floats)
    std::string display, view; ///< OCIO's; empty: its defaults
    bool raw = false;          ///< no display transform: linear values are written
    bool dither = false;       ///< noise of one step before rounding, the same in every run
    /// Of images that are shown through the display transform: not of OpenEXR, nor of linear
    /// values.
    Outliers outliers = Outliers::Keep;
    int quality = 95;                         ///< of JPEG and WebP
    const ColorSpaces* colorSpaces = nullptr; ///< null: ColorSpaces::shared()
    /// Of the film's colours: OpenEXR's chromaticities, and where the display transform begins.
    const RenderingSpace* renderingSpace = &RenderingSpace::rec709();
};

/// Says early why writeImage() will fail: unknown format, missing folder, place that cannot be
/// written, AOVs that the format or the film cannot hold.
/// @throws std::runtime_error with a one-line reason
void checkImagePath(const std::string& path, const std::vector<std::string>& aovs = {});

/// Writes a film.
///
/// OpenEXR files hold all AOVs as linear values, in one part: R, G, B, A; depth.Z, likewise
/// cameraDepth and deviceDepth; albedo.R, .G, .B; normal.X, .Y, .Z, likewise Neye, position and
/// primvars:NAME (one component: .X, two: .X, .Y); primId, instanceId, elementId, sampleCount and
/// variance under these names; crypto_object00.R ... (cryptomatte.h). Colour is multiplied by
/// alpha.
///
/// Radiance files (.hdr) hold linear colour. All other formats hold the colour after the display
/// transform, clamped to [0,1]. Formats with alpha store it not multiplied, formats without alpha
/// show it over black.
///
/// The file appears whole or not at all: an earlier file stays when writing fails.
/// @throws std::runtime_error with a one-line reason
void writeImage(const Film& film, const std::string& path, const ImageOptions& options = {},
                const Metadata& metadata = {});

/// The names of the ids of all of a film's Cryptomatte AOVs, as files have them:
/// cryptomatte/ID/name, hash, conversion and manifest.
Metadata cryptomatteMetadata(const Film& film);

/// The names of an AOV's channels in OpenEXR files.
std::vector<std::string> channelNames(const AovSpec& spec);

/// An image as it is in its file.
struct ImageData {
    int width = 0, height = 0;               ///< of the pixels
    int x = 0, y = 0;                        ///< of the first pixel in the uncropped image
    int displayWidth = 0, displayHeight = 0; ///< of the uncropped image
    double pixelAspectRatio = 1.0;
    std::vector<std::string> channels;
    std::vector<float> pixels; ///< channels interleaved, top row first; integers of 8 and 16 bits
                               ///< in [0,1], ids as numbers; alpha as it is stored
    Metadata metadata;
};

/// Reads any format of OIIO without changing values. Samples of deep images are put over each
/// other.
/// @throws std::runtime_error with a one-line reason
ImageData readImage(const std::string& path);

/// A deep image as it is in its file.
struct DeepImage {
    int width = 0, height = 0;
    std::vector<std::string> channels;
    std::vector<int> counts;   ///< samples by pixel, top row first
    std::vector<float> values; ///< sample after sample, channels interleaved
};

/// @throws std::runtime_error with a one-line reason
DeepImage readDeep(const std::string& path);

/// Writes float pixels by the rules of writeImage(); of OpenEXR all channels with their names.
/// Other formats take the first three or four channels (premultiplied) or one.
/// @throws std::runtime_error with a one-line reason
void writePixels(const ImageData& image, const std::string& path, const ImageOptions& options = {});

} // namespace patina
