// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/film/film.h"

#include <vector>

namespace patina {

/// What an image for eyes does about outliers: pixels that a few very bright samples have decided
/// (fireflies).
enum class Outliers {
    Keep,  ///< shows them: the mean of the samples, without bias
    Spread ///< gives their light to the pixels around, so that the mean of the picture stays
};

/// Spreads the light of outliers. An outlier is brighter than all but one of its neighbours by more
/// than a third and by more than three times their own noise, and by less than four times its own
/// noise: so few samples made it that they may as well be chance. Pixels whose samples agree, such
/// as highlights, stay whatever they are beside, and so does an image without noise.
///
/// The excess over the mean of its neighbours goes to the pixels around, in proportion to their
/// luminance, over an area that grows with it, so that no spot shows.
/// @param color of the film, three floats per pixel, top row first
/// @returns how many pixels were outliers
int spreadOutliers(const Film& film, std::vector<float>& color);

} // namespace patina
