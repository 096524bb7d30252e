// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/embree/path.h"
#include "hdDelegate/embree/sharing/sharedLight.h"

namespace patina {

/// Whether light may be shared at the next surface: the path comes from a rough one, and nothing is
/// around that cells do not know.
inline bool comesFromRough(const Path& path) {
    return !path.specular && path.scatterings == 0 && path.media.empty() && !path.waves.chosen() &&
           path.depth <= SharedPoint::mostDepth;
}

/// What paths find that are followed for others.
class SharedPoints {
public:
    /// A path begins.
    void begin() { _first = points.size(); }
    /// Lets the path go on by one group of the lobes of a vertex. By the Lambert ones it does as if
    /// the surface were white, and notes the point.
    void meet(Path& path, SurfacePoint& point, Bsdf& bsdf);
    /// The path is at its end: what came after each point is its light.
    /// @param radiance that came after the last one
    void end(const vec3& radiance);

    std::vector<SharedPoint> points;

private:
    static constexpr size_t perPath = 4; ///< points that a path notes at most

    /// Of a point of the path that is followed: the path's throughput there, and what it gathered
    /// before, since the point before.
    struct Open {
        vec3 throughput, gathered;
    };

    size_t _first = 0;
    std::vector<Open> _open; ///< of points from _first on
};

/// Adds the light that others found, and takes the lobes for it out.
/// @returns false where the path is at its end
bool takeShared(const SharedLight& shared, Path& path, const SurfacePoint& point, Bsdf& bsdf);

} // namespace patina
