// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace patina {

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
