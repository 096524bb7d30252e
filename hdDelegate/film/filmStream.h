// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/film/film.h"
#include "hdDelegate/film/filmFile.h"
#include "hdDelegate/film/tiles.h"

namespace patina {

/// Films in files, bit for bit: a header, and the accumulators of rectangles of pixels.
class FilmStream {
public:
    struct Header {
        int width = 0, height = 0;
        uint64_t dropped = 0;
        uint32_t firstSample = 0;
        std::string token;
        std::vector<AovSpec> aovs;
        std::map<std::string, std::vector<std::string>> names; ///< of ids, by AOV
    };

    static void writeHeader(FilmFileWriter& file, const Film& film);
    static void writePixels(FilmFileWriter& file, const Film& film, const Tile& tile);

    static Header readHeader(FilmFileReader& file);
    /// Makes an empty film of a header.
    static void reset(Film& film, const Header& header);
    static void readPixels(FilmFileReader& file, Film& film, const Tile& tile);
    static size_t bytesOfPixel(const std::vector<AovSpec>& aovs);

    /// Adds samples of another film behind those of a tile.
    /// @param part of the tile's size and the film's AOVs. Where the tile has samples, those of the
    ///        part are of one span, and follow them.
    static void append(Film& film, const Film& part, const Tile& tile);
    /// Takes over the names of a part's ids.
    static void addNames(Film& film, const Header& header);
    static void addDropped(Film& film, uint64_t samples) { film._dropped += samples; }

private:
    template <class FilmType, class Act>
    static void eachRow(FilmType& film, const Tile& tile, const Act& act);
    template <class FilmType, class Act>
    static void eachCell(FilmType& film, const Tile& tile, const Act& act);
    static void appendPixel(Film::Pixel& pixel, const Film::Pixel& part);
    static void appendPlane(const AovSpec& spec, Film::Plane& plane, size_t to,
                            const Film::Plane& part, size_t from);
};

} // namespace patina
