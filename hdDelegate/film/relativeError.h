// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/film/film.h"

namespace patina {

/// How the noise of neighbouring pixels is related.
enum class PixelNoise {
    Independent, ///< every pixel has random numbers of its own (path tracer)
    Shared,      ///< all have the same (rasterizer): many pixels tell no more than one
};

/// The expected mean, over the pixels x0 <= x < x1, y0 <= y < y1, of |luminance - its limit| /
/// (limit + 0.01), estimated from their samples. RenderSettings::tolerance is compared with it. 0
/// without pixels.
///
/// It is rather too high than too low. For 13 scenes of 12 x 7 pixels after 16 to 1024 samples it
/// was 1.4 times the true error (median), and below the true error in 4 of 100 images. For 3 x 2
/// pixels it was 1.6 times, and below in 18 of 100: the true error of so few pixels is itself a
/// matter of chance.
double relativeError(const Film& film, int x0, int y0, int x1, int y1,
                     PixelNoise noise = PixelNoise::Independent);

/// The count after `samples` that a render goes to in one piece, at most `maximum`: 1, 2, 4, 8, 16,
/// then 16 more each, and from 512 on a sixteenth of the power of two below, up to 256 more.
int nextStep(int samples, int maximum);

/// Whether the error is looked at after so many samples: powers of two, and from 32 on those in the
/// middle between two. All are steps. A render that is looked at nowhere else ends as any other,
/// however it was interrupted; and the more often one looks, the likelier an estimate is too low.
bool isErrorStep(int samples);

} // namespace patina
