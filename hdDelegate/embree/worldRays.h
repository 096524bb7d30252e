// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/embree/embreeGroup.h"

#include <atomic>

namespace patina {

/// Rays through the acceleration structure of a world.
class WorldRays {
public:
    /// The nearest hit. @param far in: largest distance
    bool intersect(const vec3& origin, const vec3& direction, float near, float far, float time,
                   unsigned mask, Hit& hit) const;
    /// Whether any surface is in the way, be it opaque or not.
    bool occluded(const vec3& origin, const vec3& direction, float near, float far, float time,
                  unsigned mask) const;
    static constexpr int packet = 16; ///< rays that occludedRays takes at once
    /// The same for up to `packet` rays from one point to any distance, in less time than each
    /// alone. @param directions of length 1
    /// @returns bit i: something blocks ray i
    unsigned occludedRays(const vec3& origin, const vec3* directions, int count, float time,
                          unsigned mask) const;

protected:
    explicit WorldRays(Diagnostics& diagnostics) : _diagnostics(diagnostics) {}

    Diagnostics& _diagnostics;
    EmbreeGroup* _world = nullptr;

private:
    /// Whether a ray may be traced. Tells once of one that may not.
    bool accepts(const RTCRay& ray) const;
    bool finishHit(const RTCRayHit& rayHit, const TraceContext& context, Hit& hit) const;

    mutable std::atomic<bool> _warnedOfRays{false};
};

} // namespace patina
