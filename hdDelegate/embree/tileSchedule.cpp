// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/tileSchedule.h"

#include "hdDelegate/film/relativeError.h"

#include <algorithm>
#include <climits>

namespace patina {

TileSchedule::TileSchedule(const Film& film, const RenderSettings& settings)
    : _film(film), _begin(std::max(0, settings.sampleBegin)),
      _samples(std::max(1, settings.samples)), _minSamples(std::max(2, settings.minSamples)),
      _tolerance(_begin > 0 ? 0.0 : settings.tolerance),
      _tiles(tilesOf(film.width(), film.height(), settings.dataWindow)) {
    if (settings.sampleEnd > 0) _samples = std::min(_samples, settings.sampleEnd);
    if (settings.tileParts != 1 || settings.tilePart != 0)
        _tiles = tilesOfPart(_tiles, settings.tilePart, settings.tileParts);
    _errorChecks.resize(_tiles.size());
}

int TileSchedule::count(int tile) const {
    const Tile& t = _tiles[tile];
    return int(_film.nextSample(t.x1 - 1, t.y1 - 1)); // the pixel that is rendered last
}

bool TileSchedule::isEnough(int tile, int samples) const {
    if (!(_tolerance > 0.0) || samples < _minSamples || !isErrorStep(samples)) return false;
    const Tile& t = _tiles[tile];
    // Some of its pixels are further already: it was broken off when it had been told to go on.
    if (int(_film.nextSample(t.x0, t.y0)) != samples) return false;
    ErrorCheck& check = _errorChecks[tile];
    if (check.samples != samples) check = {samples, relativeError(_tiles[tile]) <= _tolerance};
    return check.isEnough;
}

int TileSchedule::target(int tile) const {
    const int done = count(tile);
    return done >= _samples || isEnough(tile, done) ? 0 : nextStep(done, _samples);
}

std::vector<int> TileSchedule::pending() const {
    std::vector<int> targets(_tiles.size());
    int lowest = INT_MAX;
    for (size_t i = 0; i < _tiles.size(); ++i) {
        targets[i] = target(int(i));
        if (targets[i] > 0) lowest = std::min(lowest, targets[i]);
    }
    std::vector<int> result;
    for (size_t i = 0; i < _tiles.size(); ++i)
        if (targets[i] > 0 && targets[i] <= lowest) result.push_back(int(i));
    return result;
}

double TileSchedule::fraction() const {
    double done = 0.0;
    const double samples = std::max(1, _samples - _begin);
    for (size_t i = 0; i < _tiles.size(); ++i)
        done += target(int(i)) == 0 ? 1.0 : (count(int(i)) - _begin) / samples;
    return _tiles.empty() ? 1.0 : done / double(_tiles.size());
}

int TileSchedule::samplesDone() const {
    int fewest = _samples;
    for (size_t i = 0; i < _tiles.size(); ++i)
        fewest = std::min(fewest, count(int(i)));
    return std::max(0, fewest - _begin);
}

double TileSchedule::relativeError(const Tile& tile) const {
    return patina::relativeError(_film, tile.x0, tile.y0, tile.x1, tile.y1);
}

} // namespace patina
