// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/embree/caustics/causticCasters.h"
#include "hdDelegate/embree/caustics/photonMap.h"
#include "hdDelegate/embree/media/mediaTransport.h"
#include "hdDelegate/embree/shadowRays.h"

namespace patina {

/// Sends photons from lights over surfaces of glass to the first surface that is none.
class PhotonTracer {
public:
    PhotonTracer(const EmbreeScene& scene, const SceneLights& lights, const ShadowRays& shadows,
                 const MediaTransport& media, const RenderSettings& settings)
        : _scene(scene), _lights(lights), _shadows(shadows), _media(media), _settings(settings) {}

    /// A photon depends on the block, its index and the seed alone.
    /// @param count of the photons of the block
    Photon trace(const CausticCasters& casters, uint32_t block, uint32_t index, uint32_t count,
                 TraceCounters& counters) const;

private:
    /// Chooses a point of a caster, and a light that it sees. @returns whether light comes there
    bool begin(const CausticCasters& casters, uint32_t count, Path& path, Hit& hit,
               SurfacePoint& point, TraceCounters& counters) const;
    /// Takes a photon over a surface of glass. @param first its flux is not over a cosine yet
    bool bend(Path& path, const SurfacePoint& point, bool first) const;

    const EmbreeScene& _scene;
    const SceneLights& _lights;
    const ShadowRays& _shadows;
    const MediaTransport& _media;
    const RenderSettings& _settings;
};

} // namespace patina
