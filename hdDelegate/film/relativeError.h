// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/film/film.h"

namespace patina {

/// How the noise of neighbouring pixels is related.
enum class PixelNoise {
    Independent, ///< every pixel has random numbers of its own (path tracer)
    Shared,      ///< all have the same (rasterizer): many pixels tell no more than one
};

/// What pixels tell of their error: sums over them, of which those of several rectangles add up.
struct ErrorSums {
    double pixels = 0.0;     ///< that have samples
    double around = 0.0;     ///< of deviations over luminance, squares averaged over neighbours
    double own = 0.0;        ///< of each pixel's own deviation over luminance
    double ownSquares = 0.0; ///< of the squares of these
    double before = 0.0;     ///< as own, when the samples were a power of two last
    double growth = 0.0;     ///< of the samples since then: their number over that one
    double plain = 0.0;      ///< as own, by the variance of samples that would be independent

    ErrorSums& operator+=(const ErrorSums& other);
};

/// Of the pixels x0 <= x < x1, y0 <= y < y1.
ErrorSums errorSums(const Film& film, int x0, int y0, int x1, int y1);

/// The expected mean, over pixels that have samples, of |luminance - its limit| / (limit + 0.01),
/// estimated from their samples. RenderSettings::tolerance is compared with it. 0 without pixels.
///
/// Well spread samples err less than their changes tell: by how fast the changes get smaller the
/// estimate is corrected, as far as there are pixels enough to know.
///
/// It is rather too high than too low. For 13 scenes of 12 x 7 pixels after 16 to 1024 samples it
/// was 1.4 times the true error (median), and below the true error in 4 of 100 images. For 3 x 2
/// pixels it was 1.6 times, and below in 18 of 100: the true error of so few pixels is itself a
/// matter of chance.
double relativeError(const ErrorSums& sums, PixelNoise noise = PixelNoise::Independent);
double relativeError(const Film& film, int x0, int y0, int x1, int y1,
                     PixelNoise noise = PixelNoise::Independent);

/// The count after `samples` that a render goes to in one piece, at most `maximum`: 1, 2, 4, 8, 16,
/// then 16 more each, and from 512 on a sixteenth of the power of two below, up to 256 more.
int nextStep(int samples, int maximum);

/// Whether the error is looked at after so many samples: powers of two, and from 32 on those in the
/// middle between two. All are steps. A render that is looked at nowhere else ends as any other,
/// however it was interrupted; and the more often one looks, the likelier an estimate is too low.
bool isErrorStep(int samples);

/// Whether that of a whole image is looked at after so many: at ends of spans (spans.h), so that no
/// image takes more than a quarter of its samples too many.
bool isImageErrorStep(int samples);

} // namespace patina
