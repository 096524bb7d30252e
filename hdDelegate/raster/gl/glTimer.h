// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/raster/gl/glFunctions.h"

#include <map>
#include <vector>

namespace patina {

/// Seconds that the driver works on stretches of commands, by its own clock. Made, used and
/// destroyed with the same context current.
class GlTimer {
public:
    enum Share { Aovs, Shadows, Surfaces, ReadBack };

    GlTimer() = default;
    ~GlTimer();

    /// Ends the stretch before, begins one that counts for `share`.
    void mark(Share share);
    /// Ends the last stretch and counts the seconds of each. Waits for the driver: call where its
    /// results are waited for anyhow.
    void collect();
    /// Of all stretches that were collected since clear().
    double seconds(Share share) { return _seconds[share]; }
    void clear() { _seconds.clear(); }

    GlTimer(const GlTimer&) = delete;
    GlTimer& operator=(const GlTimer&) = delete;

private:
    GLuint next();

    std::vector<GLuint> _queries;     ///< kept for reuse
    std::vector<Share> _shares;       ///< of the stretches begun since the last collect()
    std::map<Share, double> _seconds; ///< by share
};

} // namespace patina
