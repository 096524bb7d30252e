// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/film/atomicFile.h"
#include "hdDelegate/film/filmFile.h"
#include "hdDelegate/film/relativeError.h"
#include "hdDelegate/film/tiles.h"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace patina {

class Film;

/// Writes what one part of a cut frame has found: films of the same tiles, each with the samples of
/// one span (spans.h), or with all samples from 0 to the end of some span. Of several films from 0
/// on each holds those before it, and tiles that have got no further are not written again.
/// @throws std::runtime_error with a one-line reason
class PartialWriter {
public:
    /// @param file appears all at once, when commit() is called; a link there is replaced
    /// @param description what made the part; its host reads it
    PartialWriter(const std::string& file, const std::string& description, std::vector<Tile> tiles);
    /// @throws std::invalid_argument where a tile lies outside of the film
    void add(const Film& film);
    /// @param report what the render told; its host reads it
    void commit(const std::string& report);

private:
    AtomicFile _target;
    FilmFileWriter _file;
    std::vector<Tile> _tiles;
    std::vector<uint32_t> _counts; ///< next samples of the tiles, as written last
    bool _finished = false;
};

/// @returns what PartialWriter was given
std::string partialDescription(const std::string& file);

/// What the tiles of parts told of their error, at each count of samples that they come with.
class PartialErrors {
public:
    void add(const Tile& tile, int samples, const ErrorSums& sums);
    /// The count at which the image rendered at once was done, though tiles of parts went on: they
    /// did not know the others. As TileSchedule has it.
    /// @returns 0 where no tile went on
    int samplesOfWhole(double tolerance, int minSamples) const;
    /// @returns the counts before the last one at which that image had its denoised error looked at
    std::vector<int> stepsOfWhole(int minSamples) const;

private:
    std::map<int, ErrorSums> wholes(int minSamples) const;          ///< by count
    std::map<std::pair<int, int>, std::map<int, ErrorSums>> _tiles; ///< by corner, then by count
};

/// The numbers that decide about a tile after some samples, as TileSchedule does.
struct PartialMerge {
    double tolerance = 0.0; ///< of noise; 0 or less: all samples count
    int minSamples = 0;
    int samples = 0;                 ///< the most of a tile; 0: no limit
    PartialErrors* errors = nullptr; ///< is told them
};

/// Adds a part to a film: to an empty one, or behind the samples of the parts before. Parts of
/// other tiles may come in any order, those of the same tiles in that of their samples. Samples of
/// tiles that have enough before them are left out.
/// @param film is undefined after a failure
/// @returns the report
std::string mergePartial(Film& film, const std::string& file, const PartialMerge& merge);

} // namespace patina
