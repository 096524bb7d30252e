// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/film/sampler.h"
#include "hdDelegate/image/volumeMedium.h"

#include <cmath>
#include <functional>
#include <memory>

namespace patina {

/// All volume prims of a scene. Collisions are found by delta tracking with a majorant per cell,
/// transmittance by ratio tracking (Novak et al. 2014); colours follow Kutz et al. 2017, Spectral
/// and Decomposition Tracking. Volumes that overlap add up.
class VolumeScene {
public:
    using MediumOf =
        std::function<std::shared_ptr<const VolumeMedium>(const std::shared_ptr<const Volume>&)>;
    using PlacesOf = std::function<std::vector<mat4>(const std::string& group)>;

    /// Takes over the volumes of a scene.
    /// @param open time of the shutter's opening; volumes stand still
    /// @param origin of the space that they are wanted in, see seenFrom(); places are in it already
    void update(const std::vector<std::shared_ptr<const Volume>>& prims, const MediumOf& mediumOf,
                const PlacesOf& placesOf, float open, const dvec3& origin,
                Diagnostics& diagnostics);

    bool empty() const { return _placed.empty(); }
    vec3 boundsMin() const { return _min; } ///< world
    vec3 boundsMax() const { return _max; }

    struct Collision {
        bool scattered = false, absorbed = false;
        float distance = 0.0f; ///< of the collision, or the end
        Medium medium;
        vec3 emitted{0.0f};       ///< radiance that reaches the origin, times the throughput there
        float emittedFrom = 0.0f; ///< its mean, times distances
    };
    /// Takes light along a ray up to where it scatters, or the end.
    /// @param throughput is multiplied by what remains
    Collision track(const vec3& origin, const vec3& direction, float end, unsigned rays,
                    vec3& throughput, Sampler& sampler) const;

    /// An estimate of the transmittance; its mean is exact.
    vec3 transmittance(const vec3& origin, const vec3& direction, float end, unsigned rays,
                       Sampler& sampler) const;

private:
    struct Placed {
        std::shared_ptr<const VolumeMedium> medium;
        mat4 worldToObject{1.0f};
        Visibility visibility;
        vec3 light{1.0f}; ///< factor of its glow for rays that gather light
    };
    class Tracker;
    std::vector<Placed> _placed;
    std::vector<std::shared_ptr<const VolumeMedium>> _held; ///< those that are nowhere too
    vec3 _min{INFINITY}, _max{-INFINITY};
};

} // namespace patina
