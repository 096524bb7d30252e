// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace patina {

/// OpenImageIO looks through an ICC profile when it opens an image, and dies of some that point
/// beyond their end.
/// @param file descriptor of a regular file
/// @returns whether the image may hold one: of PNG, JPEG and TIFF by their headers, of OpenEXR and
///          Radiance never, of others always
bool mayHoldProfile(int file);

} // namespace patina
