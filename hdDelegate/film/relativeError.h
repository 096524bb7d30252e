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
    double error = 0.0;      ///< of expected errors over luminance
    double own = 0.0;        ///< of each pixel's own deviation over luminance
    double ownSquares = 0.0; ///< of the squares of these
    double before = 0.0;     ///< as own, two powers of two of samples earlier
    double growth = 0.0;     ///< of the samples since the last power of two: their number over that
    double plain = 0.0;      ///< as error, by the variance of samples that would be independent

    ErrorSums& operator+=(const ErrorSums& other);
};

/// Of the pixels x0 <= x < x1, y0 <= y < y1.
ErrorSums errorSums(const Film& film, int x0, int y0, int x1, int y1);

/// The expected mean, over pixels that have samples, of |luminance - its limit| / (limit + 0.01),
/// estimated from their samples. RenderSettings::tolerance is compared with it. 0 without pixels.
///
/// Well spread samples err less than their changes tell: by how fast the changes get smaller the
/// estimate is corrected, as far as there are pixels enough to know. Two standard errors of
/// what chance makes of the pixels are added: next to nothing for many pixels.
/// docs/measurements/tolerance.md derives them, and says how often the true error is above.
double relativeError(const ErrorSums& sums, PixelNoise noise = PixelNoise::Independent);
double relativeError(const Film& film, int x0, int y0, int x1, int y1,
                     PixelNoise noise = PixelNoise::Independent);

/// The count after `samples` that a render goes to in one piece, at most `maximum`: 1, 2, 4, 8, 16,
/// then an eighth of the power of two below more each, and from 256 on a sixteenth, up to 256 more.
int nextStep(int samples, int maximum);

/// Whether the error is looked at after so many samples: powers of two, and from 32 on those in the
/// middle between two. All are steps. A render that is looked at nowhere else ends as any other,
/// however it was interrupted; and the more often one looks, the likelier an estimate is too low.
bool isErrorStep(int samples);

/// Whether that of a whole image is looked at after so many: at ends of spans (spans.h), so that no
/// image of 16 samples or more takes more than an eighth of them too many.
bool isImageErrorStep(int samples);

} // namespace patina
