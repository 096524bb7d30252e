// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/scene/camera.h"
#include "base/diagnostics.h"

#include <memory>
#include <vector>

namespace patina {

/// An ST map: for each place of the film, the place that it shows. The kept and interpolated values
/// are the ways between the two, so that a map that moves nothing changes no bit, and places
/// beyond the middles of the outermost texels go on as those do.
class DistortionMap {
public:
    /// @param places red and green of an image, top row first, 0 to 1 from the lower left
    DistortionMap(int width, int height, const std::vector<vec2>& places);

    /// Reads the map that a camera names.
    /// @returns null where it names none, and, after a warning, where that cannot be read
    static std::shared_ptr<const DistortionMap> read(const Camera& camera,
                                                     Diagnostics& diagnostics);

    /// The place that the film shows. Not finite where the map says so.
    /// @param place 0 to 1 from the upper left
    vec2 shown(const vec2& place) const;

private:
    int _width, _height;
    std::vector<vec2> _ways; ///< y down
};

} // namespace patina
