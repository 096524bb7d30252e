// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/film/film.h"

#include <string>
#include <vector>

namespace patina {

/// Names of the AOVs that guide the denoiser, means over all samples of a pixel.
constexpr char denoisingAlbedoAov[] = "denoisingAlbedo"; ///< of the first surface that is no mirror
constexpr char denoisingNormalAov[] = "denoisingNormal"; ///< its shading normal, in world space
/// Likewise of every second sample of a pixel, beginning with the first, as is the colour.
constexpr char denoisingHalfColorAov[] = "denoisingHalfColor";
constexpr char denoisingHalfAlbedoAov[] = "denoisingHalfAlbedo";
constexpr char denoisingHalfNormalAov[] = "denoisingHalfNormal";

/// Which Open Image Denoise to load: a path, or empty for $PATINA_OIDN_LIBRARY, then what the
/// system's loader knows. It holds from the next call on; what is loaded stays loaded.
void setDenoiserLibrary(const std::string& path);

/// @returns why images cannot be denoised here, in one line; empty where they can
std::string denoiserMissing();

/// An image for the filter: three floats for each pixel, top row first.
struct NoisyImage {
    int width = 0, height = 0;
    std::vector<float> color;
    std::vector<float> albedo, normal; ///< guides; empty: none
    double samples = 0.0;              ///< of a pixel, in the mean; few make guides noisy
};

/// @returns the colours without noise
/// @param threads 0 for all
/// @throws std::runtime_error with a one-line reason
std::vector<std::vector<float>> denoised(std::vector<NoisyImage> images, int threads = 0);

/// Replaces a film's colour by what Open Image Denoise makes of it ("RT" filter, HDR; Áfra 2019),
/// led by the film's denoising AOVs where it holds both, which are denoised themselves first.
/// Alpha stays. The noisy colour stays too, as "color.noisy"; a second call starts from it.
/// @param threads 0 for all
/// @param ofLight AOVs of light paths as well, each by itself with the same guides: they add up to
///        the colour nearly, no longer to all bits
/// @throws std::runtime_error with a one-line reason; the film is as before then
void denoise(Film& film, int threads = 0, bool ofLight = false);

/// Whether denoisedError() can tell something of a film: it has both guides, and halves of these
/// and of the colour.
bool hasHalves(const Film& film);

/// The expected mean over the pixels of |luminance - its limit| / (limit + 0.01), as
/// relativeError() has it, of the colour as denoise() leaves it.
///
/// Both halves of the samples are denoised. A half that was not denoised, and is independent, tells
/// how far the other is from the limit: so what the filter blurs counts, as what it leaves does.
/// docs/design/film.md derives it (cross-validation; compare Rousselle et al. 2012, Adaptive
/// rendering with non-local means filtering). Two standard errors of what chance makes of the
/// pixels are added.
/// @param threads of the filter; 0 for all
/// @returns below 0 where the film has no halves, or no pixel of two samples
/// @throws std::runtime_error as denoise()
double denoisedError(const Film& film, int threads = 0);

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
