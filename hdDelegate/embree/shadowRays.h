// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/embree/path.h"
#include "hdDelegate/embree/sceneLights.h"

namespace patina {

/// Whether a light with links of a category means what was hit.
bool isLinked(int category, const Surface* surface, const std::vector<int>* instance);

/// What is left of lights on their way to a point.
class ShadowRays {
public:
    /// @param enabled false: nothing blocks light
    ShadowRays(const EmbreeScene& scene, bool enabled) : _scene(scene), _enabled(enabled) {}

    /// From a point to a light.
    struct Way {
        vec3 origin, direction;
        float distance, time;
    };
    /// The part of a light that comes past everything in between. Surfaces block it but for their
    /// presence; media take their share, those of objects without a refracting surface too.
    /// @param media at the point, on the side that the light comes from
    vec3 seen(const LightInfo& light, const Way& way, const MediumStack& media, Sampler& sampler,
              TraceCounters& counters) const;

private:
    const EmbreeScene& _scene;
    const bool _enabled;
};

} // namespace patina
