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

/// A frame of a sequence as image files hold it: interleaved rows, top row first. The AOVs are
/// those of the same names.
struct SequenceFrame {
    const float* color = nullptr;   ///< 3 floats a pixel, noisy
    const float* alpha = nullptr;   ///< 1
    const float* albedo = nullptr;  ///< 3, denoisingAlbedo
    const float* normal = nullptr;  ///< 3, denoisingNormal
    const float* depth = nullptr;   ///< 1
    const float* later = nullptr;   ///< 2, motionForward
    const float* earlier = nullptr; ///< 2, motionBackward
    const float* samples = nullptr; ///< 1, sampleCount; null: the same everywhere
};

struct Accumulated {
    std::vector<float> color;  ///< 3 floats a pixel; 0 where no frame has a number
    std::vector<float> frames; ///< of how many frames it is the mean, 0 to frames.size()
};

/// The colour of one frame, averaged with that of the frames around it where these see the same
/// place of a surface in the same light (docs/design/film.md#frames-of-a-sequence).
///
/// Each pixel is followed along the vectors of motion to the nearest texel that sees its surface;
/// the chain ends where there is none. Colour is taken by its albedo's ratio, counts by its
/// samples, and only where the differences of the pixels around have no mean that their own scatter
/// does not explain. The result depends on these frames alone.
/// @param frames one time code apart, in order, all of one size
/// @param current which of them
/// @param threads 0 for all
Accumulated accumulate(const std::vector<SequenceFrame>& frames, size_t current, int width,
                       int height, int threads = 0);

} // namespace patina
