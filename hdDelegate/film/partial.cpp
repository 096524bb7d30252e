// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/film/partial.h"

#include "hdDelegate/film/filmStream.h"
#include "hdDelegate/film/relativeError.h"
#include "base/limits.h"

#include <algorithm>
#include <cstdint>
#include <stdexcept>

namespace patina {

namespace {

constexpr FilmFileKind partial = {"part", {'P', 'a', 't', 'i', 'n', 'a', 'P', 'T'}, 1};
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
    if (!(merge.tolerance > 0.0) || int(samples) < std::max(2, merge.minSamples) ||
        !isErrorStep(int(samples)))
        return false;
    return relativeError(film, tile.x0, tile.y0, tile.x1, tile.y1) <= merge.tolerance;
}

} // namespace

PartialWriter::PartialWriter(const std::string& file, const std::string& description,
                             std::vector<Tile> tiles)
    : _target(file), _file(partial, _target.temporaryPath(), file), _tiles(std::move(tiles)) {
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
    _file.value(uint32_t(1));
    FilmStream::writeHeader(_file, film);
    for (const Tile& tile : _tiles)
        FilmStream::writePixels(_file, film, tile);
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

    Film part;
    while (reader.value<uint32_t>() != 0) {
        const FilmStream::Header header = FilmStream::readHeader(reader);
        if (film.width() == 0) begin(film, header, tiles, reader);
        if (header.width != film.width() || header.height != film.height() ||
            !sameAovs(header.aovs, film.aovs()))
            reader.fail("it is of another size or other AOVs than the parts before");
        FilmStream::addDropped(film, header.dropped);
        FilmStream::addNames(film, header);
        for (const Tile& tile : tiles) {
            if (!inside(tile, film.width(), film.height())) reader.fail("it is damaged");
            part.reset(tile.x1 - tile.x0, tile.y1 - tile.y0, header.aovs);
            FilmStream::readPixels(reader, part, {0, 0, part.width(), part.height()});
            if (!hasEnough(film, tile, header.firstSample, merge))
                FilmStream::append(film, part, tile);
        }
    }
    const std::string report = reader.text(longestDescription);
    reader.finish();
    return report;
}

} // namespace patina
