// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/film/deepPixels.h"
#include "hdDelegate/film/imageFile.h"

namespace patina {

/// Writes a deep OpenEXR image with the channels R, G, B, A, Z and ZBack. Depths are those of the
/// AOV depth. The file appears whole or not at all.
/// @throws std::runtime_error with a one-line reason
void writeDeep(const DeepPixels& pixels, const std::string& path, const ImageOptions& options = {},
               const Metadata& metadata = {});

/// The channels of a deep image after OpenImageIO has put the samples of each pixel over each
/// other.
/// @throws std::runtime_error with a one-line reason
std::vector<float> flattened(const std::string& path);

} // namespace patina
