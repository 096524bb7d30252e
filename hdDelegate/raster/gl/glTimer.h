// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/raster/gl/glFunctions.h"

#include <vector>

namespace patina {

/// Seconds that the driver works on stretches of commands, by its own clock. Made, used and
/// destroyed with the same context current.
class GlTimer {
public:
    GlTimer() = default;
    ~GlTimer();

    /// Ends the stretch before, begins one that counts for `share` (0 and up).
    void mark(int share);
    /// Ends the last stretch and adds the seconds of each to the element of `sums` of its share.
    /// Waits for the driver: call where its results are waited for anyhow.
    void collect(std::vector<double>& sums);

    GlTimer(const GlTimer&) = delete;
    GlTimer& operator=(const GlTimer&) = delete;

private:
    GLuint next();

    std::vector<GLuint> _queries; ///< kept for reuse
    std::vector<int> _shares;     ///< of the stretches begun since the last collect()
};

} // namespace patina
