// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/film/partial.h"

#include "hdDelegate/film/filmStream.h"
#include "base/limits.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <utility>

namespace patina {

namespace {

constexpr FilmFileKind partial = {"part", {'P', 'a', 't', 'i', 'n', 'a', 'P', 'T'}, 2};
constexpr uint32_t longestDescription = 1u << 28;

bool inside(const Tile& t, int width, int height) {
    return t.x0 >= 0 && t.y0 >= 0 && t.x0 < t.x1 && t.y0 < t.y1 && t.x1 <= width &&
           t.y1 <= height && t.x1 - t.x0 <= tileSize && t.y1 - t.y0 <= tileSize;
}

/// Like FilmStream::Header's reset for a film that parts are merged into.
void begin(Film& film, FilmStream::Header header, const std::vector<Tile>& tiles,
           const FilmFileReader& file) {
    // A small file cannot ask for much memory: it holds the pixels of its tiles. Of an image that
    // is cut into very many parts one may hold a corner alone.
    constexpr uint64_t maxParts = 1 << 15;
    uint64_t area = 0;
    for (const Tile& tile : tiles) {
        if (!inside(tile, header.width, header.height)) file.fail("it is damaged");
        area += uint64_t(tile.x1 - tile.x0) * uint64_t(tile.y1 - tile.y0);
    }
    if (header.width < 1 || header.height < 1) file.fail("it is damaged");
    const uint64_t pixel = FilmStream::bytesOfPixel(header.aovs);
    if (area > file.left() / pixel) file.fail("it is truncated");
    const uint64_t most = std::max(limitOf(Limit::textureBytes),
                                   std::min(file.left(), UINT64_MAX / maxParts) * maxParts);
    if (uint64_t(header.width) * uint64_t(header.height) > most / pixel)
        file.fail("its image takes more bytes than " + limitText(Limit::textureBytes));
    header.firstSample = 0;
    header.dropped = 0;
    header.token.clear();
    try {
        FilmStream::reset(film, header);
    } catch (const std::invalid_argument& error) {
        file.fail(error.what());
    }
}

bool sameAovs(const std::vector<AovSpec>& a, const std::vector<AovSpec>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) {
        return x.name == y.name && x.components == y.components && x.kind == y.kind;
    });
}

/// Whether a tile has stopped before this sample, or does so now.
bool hasEnough(const Film& film, const Tile& tile, uint32_t first, const PartialMerge& merge) {
    const uint32_t samples = film.sampleCount(tile.x0, tile.y0);
    if (samples != first) {
        if (!(merge.tolerance > 0.0))
            throw std::runtime_error(
                "the parts do not follow each other: " + std::to_string(samples) +
                " samples are there, and the next are from " + std::to_string(first) + " on");
        return true;
    }
    if (merge.samples > 0 && int(samples) >= merge.samples) return true;
    if (!(merge.tolerance > 0.0) || int(samples) < std::max(2, merge.minSamples) ||
        !isErrorStep(int(samples)))
        return false;
    return relativeError(film, tile.x0, tile.y0, tile.x1, tile.y1) <= merge.tolerance;
}

} // namespace

void PartialErrors::add(const Tile& tile, int samples, const ErrorSums& sums) {
    _tiles[{tile.x0, tile.y0}][samples] = sums;
}

std::map<int, ErrorSums> PartialErrors::wholes(int minSamples) const {
    std::map<int, ErrorSums> found;
    int last = 0;
    for (const auto& tile : _tiles)
        for (const auto& [samples, sums] : tile.second) {
            if (samples >= std::max(2, minSamples) && isImageErrorStep(samples))
                found[samples] = ErrorSums();
            last = std::max(last, samples);
        }
    found.erase(last);
    for (auto whole = found.begin(); whole != found.end();) {
        const int samples = whole->first;
        bool isKnown = true;
        for (const auto& tile : _tiles) {
            auto told = tile.second.find(samples);
            if (told == tile.second.end()) {
                told = std::prev(tile.second.end()); // it stopped before
                isKnown = isKnown && told->first < samples;
            }
            whole->second += told->second;
        }
        whole = isKnown ? std::next(whole) : found.erase(whole);
    }
    return found;
}

int PartialErrors::samplesOfWhole(double tolerance, int minSamples) const {
    for (const auto& [samples, sums] : wholes(minSamples))
        if (relativeError(sums) <= tolerance) return samples;
    return 0;
}

std::vector<int> PartialErrors::stepsOfWhole(int minSamples) const {
    std::vector<int> steps;
    for (const auto& [samples, sums] : wholes(minSamples))
        if (isErrorStep(samples)) steps.push_back(samples);
    return steps;
}

PartialWriter::PartialWriter(const std::string& file, const std::string& description,
                             std::vector<Tile> tiles)
    : _target(file, Links::replace), _file(partial, _target.temporaryPath(), file),
      _tiles(std::move(tiles)), _counts(_tiles.size(), UINT32_MAX) {
    _file.text(description);
    _file.value(uint32_t(_tiles.size()));
    for (const Tile& tile : _tiles)
        _file.value(tile);
    _file.seal();
}

void PartialWriter::add(const Film& film) {
    if (_finished) throw std::logic_error("the part is finished");
    for (const Tile& tile : _tiles)
        if (!inside(tile, film.width(), film.height()))
            throw std::invalid_argument("a tile lies outside of the film");
    std::vector<uint32_t> grown;
    for (size_t i = 0; i < _tiles.size(); ++i) {
        const uint32_t count = film.nextSample(_tiles[i].x1 - 1, _tiles[i].y1 - 1);
        if (count != _counts[i]) grown.push_back(uint32_t(i));
        _counts[i] = count;
    }
    _file.value(uint32_t(1));
    FilmStream::writeHeader(_file, film);
    _file.value(uint32_t(grown.size()));
    for (uint32_t i : grown)
        _file.value(i);
    for (uint32_t i : grown)
        FilmStream::writePixels(_file, film, _tiles[i]);
}

void PartialWriter::commit(const std::string& report) {
    if (_finished) throw std::logic_error("the part is finished");
    _finished = true;
    _file.value(uint32_t(0));
    _file.text(report);
    _file.finish();
    _target.commit();
}

std::string partialDescription(const std::string& file) {
    FilmFileReader reader(partial, file);
    return reader.text(longestDescription);
}

std::string mergePartial(Film& film, const std::string& file, const PartialMerge& merge) {
    FilmFileReader reader(partial, file);
    reader.text(longestDescription);
    const uint32_t count = reader.value<uint32_t>();
    if (count > reader.left() / sizeof(Tile)) reader.fail("it is truncated");
    std::vector<Tile> tiles(count);
    for (Tile& tile : tiles)
        tile = reader.value<Tile>();
    reader.checkSeal();

    // Of films from sample 0 on that hold each other, the last that is wanted.
    std::vector<std::unique_ptr<Film>> whole(tiles.size());
    uint64_t dropped = 0;
    const auto takeWhole = [&] {
        for (size_t i = 0; i < tiles.size(); ++i)
            if (whole[i]) {
                if (!hasEnough(film, tiles[i], 0, merge))
                    FilmStream::append(film, *whole[i], tiles[i]);
                whole[i].reset();
            }
        FilmStream::addDropped(film, std::exchange(dropped, 0));
    };
    while (reader.value<uint32_t>() != 0) {
        const FilmStream::Header header = FilmStream::readHeader(reader);
        if (film.width() == 0) begin(film, header, tiles, reader);
        if (header.width != film.width() || header.height != film.height() ||
            !sameAovs(header.aovs, film.aovs()))
            reader.fail("it is of another size or other AOVs than the parts before");
        if (header.firstSample > 0) takeWhole();
        const uint32_t written = reader.value<uint32_t>();
        if (written > tiles.size()) reader.fail("it is damaged");
        std::vector<uint32_t> indices(written);
        for (uint32_t& i : indices)
            if ((i = reader.value<uint32_t>()) >= tiles.size()) reader.fail("it is damaged");
        bool isWanted = merge.samples == 0;
        for (const uint32_t i : indices) {
            const Tile& tile = tiles[i];
            if (!inside(tile, film.width(), film.height())) reader.fail("it is damaged");
            auto part = std::make_unique<Film>();
            part->reset(tile.x1 - tile.x0, tile.y1 - tile.y0, header.aovs);
            FilmStream::readPixels(reader, *part, {0, 0, part->width(), part->height()});
            const int samples = int(header.firstSample + part->sampleCount(0, 0));
            if (header.firstSample == 0) {
                if (merge.errors)
                    merge.errors->add(tile, samples,
                                      errorSums(*part, 0, 0, part->width(), part->height()));
                if (whole[i] && merge.samples > 0 && samples > merge.samples) continue;
                whole[i] = std::move(part);
                isWanted = true;
            } else if (!hasEnough(film, tile, header.firstSample, merge)) {
                FilmStream::append(film, *part, tile);
                isWanted = true;
                if (merge.errors)
                    merge.errors->add(tile, samples,
                                      errorSums(film, tile.x0, tile.y0, tile.x1, tile.y1));
            }
        }
        if (!isWanted) continue;
        FilmStream::addNames(film, header);
        if (header.firstSample == 0)
            dropped = header.dropped;
        else
            FilmStream::addDropped(film, header.dropped);
    }
    takeWhole();
    const std::string report = reader.text(longestDescription);
    reader.finish();
    return report;
}

} // namespace patina
