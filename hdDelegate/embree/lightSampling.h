// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/embree/lightPathEvents.h"
#include "hdDelegate/embree/shadowRays.h"

namespace patina {

/// Next event estimation: light that comes straight to a vertex of a path, from samples of lights.
/// They are weighted against what following the path would have found (Veach 1997), see
/// misWeight(), and MetLights for the other half.
class LightSampling {
public:
    /// @param events of paths that have a record
    LightSampling(const EmbreeScene& scene, const SceneLights& lights, const ShadowRays& shadows,
                  const LightPathEvents& events)
        : _scene(scene), _lights(lights), _shadows(shadows), _events(events) {}

    const SceneLights& lights() const { return _lights; }
    bool empty() const { return _lights.set().empty(); } ///< there is nothing to sample

    /// Samples of a vertex that are begun; the others begin when they are taken.
    struct Draws {
        Draws() {} // NOLINT: most vertices begin one

        static constexpr int most = 4;
        union {
            LightDraw begun[most];
        };
        int count = 0;
        bool twoSided = false;
    };
    /// Begins a sample before the lobes of a vertex are known.
    LightDraw begin(const Path& path, const SurfacePoint& point, bool twoSided,
                    const vec3& u) const;
    /// Begins those of a vertex before its lobes are set up, so that what they have to wait for
    /// comes from memory meanwhile. @param maxDepth paths that end here take none
    Draws beginAll(const Path& path, const SurfacePoint& point, int maxDepth) const;
    /// Light that a surface sends on to the path, from one sample.
    vec3 atSurface(Path& path, const SurfacePoint& point, const VertexBsdf& bsdf, const Hit& hit,
                   const LightDraw& draw, TraceCounters& counters) const;
    /// The same of a medium.
    vec3 inMedium(Path& path, const vec3& position, const sh::PhaseMixture& phase, const vec3& u,
                  TraceCounters& counters) const;
    /// The share of the direct light at a point that does not reach it.
    float shadowed(Path& path, const SurfacePoint& point, const Hit& hit, const Bsdf& bsdf,
                   TraceCounters& counters) const;

private:
    /// The first step of all three. @returns null where the sample is of no use
    const LightInfo* sample(const Path& path, const SurfacePoint& point, const Hit& hit,
                            const LightDraw& draw, bool twoSided, LightSample& light) const;

    const EmbreeScene& _scene;
    const SceneLights& _lights;
    const ShadowRays& _shadows;
    const LightPathEvents& _events;
};

} // namespace patina
