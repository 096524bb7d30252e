// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/film/film.h"

#include <string>
#include <vector>

namespace patina {

/// Names of the AOVs that guide the denoiser, means over all samples of a pixel.
constexpr char denoisingAlbedoAov[] = "denoisingAlbedo"; ///< of the first surface that is no mirror
constexpr char denoisingNormalAov[] = "denoisingNormal"; ///< its shading normal, in world space

/// Which Open Image Denoise to load: a path, or empty for $PATINA_OIDN_LIBRARY, then what the
/// system's loader knows. It holds from the next call on; what is loaded stays loaded.
void setDenoiserLibrary(const std::string& path);

/// @returns why images cannot be denoised here, in one line; empty where they can
std::string denoiserMissing();

/// Replaces a film's colour by what Open Image Denoise makes of it ("RT" filter, HDR; Áfra 2019),
/// led by the film's denoising AOVs where it holds both, which are denoised themselves first.
/// Alpha stays. The noisy colour stays too, as "color.noisy"; a second call starts from it.
/// @param threads 0 for all
/// @param ofLight AOVs of light paths as well, each by itself with the same guides: they add up to
///        the colour nearly, no longer to all bits
/// @throws std::runtime_error with a one-line reason; the film is as before then
void denoise(Film& film, int threads = 0, bool ofLight = false);

/// The same of pixels, three floats each: of images that no film holds.
/// @param cleanGuides whether albedo and normal are free of noise
/// @throws std::runtime_error with a one-line reason
std::vector<float> denoisedPixels(std::vector<float>& color, std::vector<float>& albedo,
                                  std::vector<float>& normal, int width, int height,
                                  bool cleanGuides, int threads = 0);

} // namespace patina
