// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/tests/testTools.h"
#include "hdDelegate/film/imageFile.h"
#include "hdDelegate/film/tests/tempFolder.h"
#include "hdDelegate/film/tiles.h"

#include <algorithm>

namespace patina {

/// A film that is ready for samples.
struct TestFilm : Film {
    TestFilm(int width, int height, const std::vector<AovSpec>& aovs = {}) {
        reset(width, height, aovs);
    }
};

/// @param f of x and y, row by row
template <class F> void forPixels(const Film& film, const F& f) {
    for (int y = 0; y < film.height(); ++y)
        for (int x = 0; x < film.width(); ++x)
            f(x, y);
}

template <class F> void forTile(const Tile& tile, const F& f) {
    for (int y = tile.y0; y < tile.y1; ++y)
        for (int x = tile.x0; x < tile.x1; ++x)
            f(x, y);
}

/// One sample for each pixel. @param colorOf x and y
template <class F> void addColors(Film& film, const F& colorOf) {
    forPixels(film, [&](int x, int y) { film.addColor(x, y, colorOf(x, y), 1.0f); });
}

inline ImageOptions windowed(int x0, int y0, int x1, int y1) {
    ImageOptions options;
    const int window[] = {x0, y0, x1, y1};
    std::copy(window, window + 4, options.dataWindow);
    return options;
}

} // namespace patina
