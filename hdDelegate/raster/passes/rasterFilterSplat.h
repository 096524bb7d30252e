// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/film/film.h"
#include "hdDelegate/film/pixelFilter.h"

#include <functional>
#include <vector>

namespace patina {

/// Where one pass samples, the same in every pixel, and what of a sample goes to other pixels.
struct RasterSample {
    uint32_t pass = 0;                  ///< number of its samples
    uint32_t taken = 1;                 ///< how many passes there are with this one
    glm::vec2 offset{0.0f}, lens{0.0f}; ///< as of RasterCamera::view()
    glm::vec2 beside{0.0f}; ///< an offset by the filter's density alone, for what is not splatted
    float time = 0.5f;      ///< in [0,1) over the shutter
    std::vector<float> splatX{1.0f}, splatY{1.0f}; ///< of PixelFilter::splatWeights()

    /// Pixels around the image that are drawn for the sake of those within.
    int border() const { return int(splatX.size() / 2); }
};

/// Gives what a pass has for each pixel of a film.
/// @param pixels RGBA, rows from the bottom up, with the sample's border on all sides; they are
///        overwritten
/// @param window xmin, ymin, xmax, ymax of the film, inclusive, y down
/// @param take called once for each pixel, on all threads
void takeSplats(std::vector<glm::vec4>& pixels, const RasterSample& sample, const int window[4],
                const Film& film,
                const std::function<void(int x, int y, const glm::vec4& value)>& take);
/// Adds a pass to a film.
void addSplats(std::vector<glm::vec4>& pixels, const RasterSample& sample, const int window[4],
               Film& film);

} // namespace patina
