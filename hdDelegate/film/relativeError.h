#pragma once

#include "hdDelegate/film/film.h"

namespace patina {

/// Mean relative error (one standard deviation of the mean times sqrt(2/pi), over luminance + 0.01)
/// of the pixels x0 <= x < x1, y0 <= y < y1: what RenderSettings::tolerance is measured by. 0 where
/// there are no pixels.
double relativeError(const Film& film, int x0, int y0, int x1, int y1);

/// The count after `samples` at which errors are looked at next, at most `most`: 1, 2, 4, 8, 16,
/// then every 16. Looking only there makes an interrupted and resumed render end as any other.
int nextErrorStep(int samples, int most);
bool isErrorStep(int samples); ///< whether it is one of those counts

} // namespace patina
