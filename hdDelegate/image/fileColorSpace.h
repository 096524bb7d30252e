// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <OpenImageIO/imageio.h>

#include <string>

namespace patina {

class ColorSpaces;

/// The colour space "auto" of a file, as UsdUVTexture has it. What the file says comes first:
///
/// - an ICC profile (PNG's iCCP, JPEG, TIFF and others), see spaceOfIccProfile();
/// - a PNG's sRGB chunk, or gAMA with cHRM (W3C, PNG Specification, Third Edition, section 11.3.2);
/// - the chromaticities of an OpenEXR, whose values are linear;
/// - EXIF's ColorSpace, where it is sRGB;
/// - a claim to be linear, in other formats.
///
/// Without any of it, 8-bit files of three channels and more are sRGB, and others are data.
/// @param file of a regular file
/// @param format OpenImageIO's name of it, lower case
/// @param unread becomes whether there is a profile that cannot be followed
/// @returns a name that ColorSpaces knows
std::string automaticSpace(const std::string& file, const std::string& format,
                           const OIIO::ImageSpec& spec, const ColorSpaces& colorSpaces,
                           bool& unread);

} // namespace patina
