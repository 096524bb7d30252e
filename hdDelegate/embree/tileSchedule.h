// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/film/film.h"
#include "hdDelegate/film/tiles.h"
#include "hdDelegate/scene/settings.h"

#include <vector>

namespace patina {

/// Decides which tile takes how many samples next.
///
/// Every tile steps through the same sample counts (film/relativeError.h). At some of them its own
/// pixels decide whether it goes on. So neither threads, nor the order of tiles, nor an
/// interruption changes a finished image. A part of a cut frame that begins later does not know the
/// samples before it. It takes all of its own, and the tiles decide when parts are merged
/// (film/partial.h).
class TileSchedule {
public:
    TileSchedule(const Film& film, const RenderSettings& settings);

    const std::vector<Tile>& tiles() const { return _tiles; }
    /// The sample count that a tile should reach next; 0 when it has enough. One thread may ask for
    /// one tile at a time.
    int target(int tile) const;
    /// Tiles that have not reached the next step of the slowest tile.
    std::vector<int> pending() const;
    /// 0..1: samples taken over samples that may be needed.
    double fraction() const;
    int samplesDone() const; ///< of the tile with the fewest, since RenderSettings::sampleBegin

    /// Of a tile's pixels, as of film/relativeError.h.
    double relativeError(const Tile& tile) const;

    /// Samples that all pixels of a tile have.
    int count(int tile) const;

private:
    /// The result of looking at a tile.
    struct ErrorCheck {
        int samples = 0; ///< that it had then
        bool isEnough = false;
    };

    bool isEnough(int tile, int samples) const;

    const Film& _film;
    int _begin, _samples, _minSamples;
    double _tolerance;
    std::vector<Tile> _tiles;
    mutable std::vector<ErrorCheck> _errorChecks; ///< beside _tiles
};

} // namespace patina
