// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/backends/picture.h"

namespace patina {

/// Mixes a path traced image, which still has noise, with a rasterized one, which has no noise but
/// lacks some of the light.
///
/// The rasterized picture is multiplied by the ratio of the local means of both, and the rest of
/// their difference is added. So it has the path traced brightness and colour everywhere. Each
/// pixel is a mix of it and the path traced value. The path traced value counts more where the
/// surroundings have less noise (half at a relative standard error of 5 %), and towards the end.
/// @param noise noiseOf() the film that `traced` comes from
/// @param done share of the path tracer's work, 0..1
Picture refine(Picture rasterized, const Picture& traced, const Picture& noise, float done);

/// For refine(): x is the variance of every pixel's mean, y is 1 where it cannot be known yet.
Picture noiseOf(const Film& traced);

} // namespace patina
