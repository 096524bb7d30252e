// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/tileSchedule.h"

#include "hdDelegate/film/denoiser.h"

#include <algorithm>
#include <climits>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace patina {

TileSchedule::TileSchedule(const Film& film, const RenderSettings& settings, bool sharesLight)
    : _film(film), _begin(std::max(0, settings.sampleBegin)),
      _samples(std::max(1, settings.samples)), _minSamples(std::max(2, settings.minSamples)),
      _tolerance(_begin > 0 ? 0.0 : settings.tolerance),
      _isWhole(settings.tileParts == 1 && settings.tilePart == 0),
      _tiles(tilesOf(film.width(), film.height(), settings.dataWindow)), _threads(settings.threads),
      _hasHalves(_tolerance > 0.0 && _isWhole && !sharesLight && hasHalves(film) &&
                 denoiserMissing().empty()) {
    if (settings.sampleEnd > 0) _samples = std::min(_samples, settings.sampleEnd);
    if (settings.tileParts != 1 || settings.tilePart != 0)
        _tiles = tilesOfPart(_tiles, settings.tilePart, settings.tileParts);
    _errorChecks.resize(_tiles.size());
}

int TileSchedule::count(int tile) const {
    const Tile& t = _tiles[tile];
    return int(_film.nextSample(t.x1 - 1, t.y1 - 1)); // the pixel that is rendered last
}

const ErrorSums& TileSchedule::errorOf(int tile, int samples) const {
    ErrorCheck& check = _errorChecks[tile];
    const Tile& t = _tiles[tile];
    if (check.samples != samples) check = {samples, errorSums(_film, t.x0, t.y0, t.x1, t.y1)};
    return check.sums;
}

bool TileSchedule::isEnough(int tile, int samples) const {
    if (!(_tolerance > 0.0) || samples < _minSamples || !isErrorStep(samples)) return false;
    const Tile& t = _tiles[tile];
    // Some of its pixels are further already: it was broken off when it had been told to go on.
    if (int(_film.nextSample(t.x0, t.y0)) != samples) return false;
    return relativeError(errorOf(tile, samples)) <= _tolerance;
}

/// Tiles that stopped have the error that they stopped with. The others must all be at one count,
/// or else the image was found wanting before and told to go on.
bool TileSchedule::isDone() const {
    if (!(_tolerance > 0.0) || !_isWhole) return false;
    int samples = 0;
    ErrorSums sums;
    for (size_t i = 0; i < _tiles.size(); ++i) {
        const int tile = int(i), done = count(tile);
        if (done < _samples && !isEnough(tile, done)) {
            if (samples == 0) samples = done;
            const Tile& t = _tiles[i];
            if (done != samples || !isImageErrorStep(done) || done < _minSamples ||
                int(_film.nextSample(t.x0, t.y0)) != done)
                return false;
        }
        sums += errorOf(tile, done);
    }
    if (relativeError(sums) <= _tolerance) return true;
    // Filters take their time: they run where tiles are looked at, and at no end of a span beside.
    const double denoised = _hasHalves && isErrorStep(samples) ? lookDenoised() : -1.0;
    return denoised >= 0.0 && denoised <= _tolerance;
}

double TileSchedule::lookDenoised() const {
    const double taken = samplesTaken();
    if (!_hasHalves || taken == std::exchange(_denoisedAt, taken)) return _denoised;
    try {
        _denoised = denoisedError(_film, _threads);
    } catch (const std::runtime_error&) { // whoever denoises the image says why it fails
        _denoised = -1.0;
    }
    return _denoised;
}

int TileSchedule::target(int tile) const {
    const int done = count(tile);
    if (done >= _samples || isEnough(tile, done)) return 0;
    int next = nextStep(done, _samples);
    // Where nobody looks, long steps wait for each other less often.
    while (!(_tolerance > 0.0) && next > 16 && next % 16 != 0 && next < _samples)
        next = nextStep(next, _samples);
    return next;
}

void TileSchedule::look(int tile) const {
    if (_tolerance > 0.0 && count(tile) > 1) errorOf(tile, count(tile));
}

std::vector<int> TileSchedule::pending() const {
    if (isDone()) return {};
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

int TileSchedule::samplesDone() const {
    int fewest = _samples;
    for (size_t i = 0; i < _tiles.size(); ++i)
        fewest = std::min(fewest, count(int(i)));
    return std::max(0, fewest - _begin);
}

double TileSchedule::samplesTaken() const {
    double samples = 0.0, pixels = 0.0;
    for (size_t i = 0; i < _tiles.size(); ++i) {
        const Tile& t = _tiles[i];
        const double area = double(t.x1 - t.x0) * double(t.y1 - t.y0);
        samples += area * std::max(0, count(int(i)) - _begin);
        pixels += area;
    }
    return pixels > 0.0 ? samples / pixels : 0.0;
}

TileSchedule::Outlook TileSchedule::outlook() const {
    Outlook found;
    struct Part {
        double pixels, samples, error;
        bool goesOn;
    };
    std::vector<Part> parts;
    ErrorSums sums;
    double pixels = 0.0, most = 0.0;
    for (size_t i = 0; i < _tiles.size(); ++i) {
        const int tile = int(i), done = count(tile);
        const Tile& t = _tiles[i];
        const double area = double(t.x1 - t.x0) * double(t.y1 - t.y0);
        const bool isLookedAt = _tolerance > 0.0 && done > 1;
        if (isLookedAt) sums += errorOf(tile, done);
        parts.push_back({area, double(done), isLookedAt ? relativeError(errorOf(tile, done)) : -1.0,
                         target(tile) > 0});
        pixels += area;
        most = std::max(most, double(done));
    }
    if (!(pixels > 0.0)) return found;
    found.taken = samplesTaken();
    const bool isKnown = sums.pixels > 0.5 * pixels;
    if (isKnown) found.error = relativeError(sums);

    const auto samplesAt = [&](const Part& part, double end) {
        if (!part.goesOn) return part.samples;
        double enough = end;
        if (isKnown)
            enough = std::max(double(_minSamples),
                              part.samples * std::pow(part.error / _tolerance, 2.0));
        return std::clamp(std::min(end, enough), part.samples,
                          std::max(part.samples, double(_samples)));
    };
    double end = double(_samples);
    if (isKnown && _isWhole) {
        double sum = 0.0;
        for (const Part& part : parts)
            sum += part.pixels * part.error;
        const double share =
            sum > 0.0 ? found.error * pixels / sum : 1.0; // of the image's estimate
        const auto errorAt = [&](double samples) {
            double error = 0.0;
            for (const Part& part : parts) {
                const double later = samplesAt(part, samples);
                error += part.pixels * part.error * std::sqrt(part.samples / std::max(later, 1.0));
            }
            return share * error / pixels;
        };
        double least = std::max(most, double(_minSamples));
        end = std::max(least, end);
        while (end - least > 0.01 * end) { // the count at which the image is done
            const double middle = std::sqrt(least * end);
            (errorAt(middle) <= _tolerance ? end : least) = middle;
        }
    }
    for (const Part& part : parts)
        found.needed += part.pixels * (samplesAt(part, end) - part.samples) / pixels;
    if (_denoised >= 0.0) {
        found.denoised = _denoised;
        const double enough = _denoisedAt * std::pow(_denoised / _tolerance, 2.0);
        found.needed = std::clamp(enough - found.taken, 0.0, found.needed);
    }
    return found;
}

} // namespace patina
