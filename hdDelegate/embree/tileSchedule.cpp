#include "hdDelegate/embree/tileSchedule.h"

#include "hdDelegate/film/relativeError.h"

#include <algorithm>
#include <climits>

namespace patina {

TileSchedule::TileSchedule(const Film& film, const RenderSettings& settings)
    : _film(film), _samples(std::max(1, settings.samples)),
      _minSamples(std::max(2, settings.minSamples)), _tolerance(settings.tolerance) {
    int x0 = 0, y0 = 0, x1 = film.width(), y1 = film.height();
    if (settings.dataWindow[2] >= settings.dataWindow[0] &&
        settings.dataWindow[3] >= settings.dataWindow[1]) {
        x0 = std::clamp(settings.dataWindow[0], 0, x1);
        y0 = std::clamp(settings.dataWindow[1], 0, y1);
        x1 = std::clamp(settings.dataWindow[2] + 1, x0, x1);
        y1 = std::clamp(settings.dataWindow[3] + 1, y0, y1);
    }
    for (int y = y0; y < y1; y += tileSize)
        for (int x = x0; x < x1; x += tileSize)
            _tiles.push_back({x, y, std::min(x + tileSize, x1), std::min(y + tileSize, y1)});
    _errorChecks.resize(_tiles.size());
}

int TileSchedule::count(int tile) const {
    const Tile& t = _tiles[tile];
    return int(_film.sampleCount(t.x1 - 1, t.y1 - 1)); // the pixel that is rendered last
}

bool TileSchedule::isEnough(int tile, int samples) const {
    if (!(_tolerance > 0.0) || samples < _minSamples || !isErrorStep(samples)) return false;
    const Tile& t = _tiles[tile];
    // Some of its pixels are further already: it was broken off when it had been told to go on.
    if (int(_film.sampleCount(t.x0, t.y0)) != samples) return false;
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
    for (size_t i = 0; i < _tiles.size(); ++i)
        done += target(int(i)) == 0 ? 1.0 : double(count(int(i))) / _samples;
    return _tiles.empty() ? 1.0 : done / double(_tiles.size());
}

int TileSchedule::samplesDone() const {
    int fewest = _samples;
    for (size_t i = 0; i < _tiles.size(); ++i)
        fewest = std::min(fewest, count(int(i)));
    return fewest;
}

double TileSchedule::relativeError(const Tile& tile) const {
    return patina::relativeError(_film, tile.x0, tile.y0, tile.x1, tile.y1);
}

} // namespace patina
