// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/backends/picture.h"

namespace patina {

/// Shows a path traced image that still has noise with the help of a rasterized one that
/// has none but lacks some of the light.
///
/// The rasterized picture is multiplied by the ratio of the local means of both and moved by what
/// is left of their difference, so that it has the path traced brightness and colour everywhere.
/// Each pixel is a mix of it and the path traced value, which counts the more the less noise the
/// surroundings have (half at a relative standard error of 5 %) and the nearer the end is.
/// @param noise noiseOf() the film that `traced` is of
/// @param done share of the path tracer's work, 0..1
Picture refine(Picture rasterized, const Picture& traced, const Picture& noise, float done);

/// For refine(): x is the variance of every pixel's mean, y is 1 where it cannot be known yet.
Picture noiseOf(const Film& traced);

} // namespace patina
