// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/film/film.h"
#include "hdDelegate/film/relativeError.h"
#include "hdDelegate/film/tiles.h"
#include "hdDelegate/scene/settings.h"

#include <vector>

namespace patina {

/// Decides which tile takes how many samples next.
///
/// Every tile steps through the same sample counts (film/relativeError.h). At some of them its own
/// pixels decide whether it goes on, and all tiles together whether the image is done: it is as
/// soon as its mean error is within the tolerance, though noisy tiles are still above. So neither
/// threads, nor the order of tiles, nor an interruption changes a finished image. A part of a cut
/// frame does not know the other tiles, nor one that begins later the samples before it. It goes on
/// until each of its tiles is within the tolerance, and the whole decides when parts are merged
/// (film/partial.h).
///
/// Where the film has halves for the denoiser, the whole is also done when its colour would be
/// within the tolerance after denoising (film/denoiser.h).
class TileSchedule {
public:
    /// @param sharesLight both halves of the samples do: they do not tell of each other then
    TileSchedule(const Film& film, const RenderSettings& settings, bool sharesLight = false);

    const std::vector<Tile>& tiles() const { return _tiles; }
    /// The sample count that a tile should reach next; 0 when it has enough. One thread may ask for
    /// one tile at a time.
    int target(int tile) const;
    /// Sums up the error of a tile that has reached a step, so that tiles do so at once. One thread
    /// may ask for one tile at a time.
    void look(int tile) const;
    /// Tiles that have not reached the next step of the slowest tile; none when the image is done.
    std::vector<int> pending() const;
    int samplesDone() const; ///< of the tile with the fewest, since RenderSettings::sampleBegin

    /// How far the image is. While samples are looked at for their error, what is needed follows
    /// from it: noise falls with the root of the number of samples.
    struct Outlook {
        double taken = 0.0;     ///< samples, mean over the pixels
        double needed = 0.0;    ///< likewise, of those that are left
        double error = -1.0;    ///< relative error by noise so far; below 0: not looked at
        double denoised = -1.0; ///< likewise of the denoised colour
    };
    Outlook outlook() const;
    /// Looks at the error of the denoised colour. @returns below 0 where it is not known
    double lookDenoised() const;

    /// Samples that all pixels of a tile have.
    int count(int tile) const;

private:
    /// What a tile told when it was looked at.
    struct ErrorCheck {
        int samples = 0; ///< that it had then
        ErrorSums sums;
    };

    const ErrorSums& errorOf(int tile, int samples) const;
    bool isEnough(int tile, int samples) const;
    bool isDone() const;
    double samplesTaken() const;

    const Film& _film;
    int _begin, _samples, _minSamples;
    double _tolerance;
    bool _isWhole; ///< all tiles of the image, from the first sample on
    std::vector<Tile> _tiles;
    int _threads;
    bool _hasHalves;
    mutable std::vector<ErrorCheck> _errorChecks; ///< beside _tiles
    mutable double _denoisedAt = 0.0;             ///< samplesTaken() of the last look
    mutable double _denoised = -1.0;
};

} // namespace patina
