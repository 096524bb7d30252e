// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/film/film.h"

#include <array>
#include <vector>

namespace patina {

/// Pixels of a film whose samples count for all pixels that their filter reaches.
///
/// Samples are spread evenly over a pixel, and summed up in its four quarters (AOVs quarterColors
/// and quarterShares). With the filter's mass w_q in each quarter q of any pixel around,
///
///     pixel = sum w_q mean_q / sum w_q        over the quarters that have samples
class PixelSplat {
public:
    static constexpr int quarters = 4;

    /// What a sample adds to the AOVs quarterColors and quarterShares.
    struct Sample {
        static constexpr size_t shareCount = 2 * quarters + 1;
        std::array<float, 3 * quarters> colors{};
        std::array<float, shareCount> shares{}; ///< the last is the filter's radius
        Sample(int quarter, const glm::vec3& color, float alpha, float radius);
    };

    /// How splats lower the noise of pixels that all have equally much.
    struct Noise {
        std::vector<double> weights; ///< of whole pixels along one axis, from the left
        double finer = 1.0;          ///< deviation of the result over that with these weights alone
        double together = 1.0;       ///< pixels that err alike
        explicit Noise(float radius);
    };

    /// @param film that splats: see Film::splatRadius()
    explicit PixelSplat(const Film& film);

    /// @param own what stands for the means of the pixels' own samples (outliers are spread, say),
    ///        three floats each, top row first; empty: these means
    std::vector<float> color(const std::vector<float>& own = {}) const;
    std::vector<float> alpha() const;

private:
    template <size_t n> std::vector<float> filtered(const std::vector<float>& values) const;

    const Film& _film;
    size_t _width, _height;
    std::vector<float> _shares;
    std::vector<float> _weights; ///< of half pixels along one axis
};

} // namespace patina
