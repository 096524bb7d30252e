// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/embree/cameraRays.h"
#include "hdDelegate/embree/embreeScene.h"
#include "hdDelegate/embree/path.h"
#include "hdDelegate/scene/settings.h"

namespace patina {

class LightSampling;

/// Transmittance along the ray of a path up to a distance; of volumes an estimate.
vec3 transmittanceTo(const EmbreeScene& scene, Path& path, float distance);

/// Takes paths through media that objects are filled with, volumes and splats.
class MediaTransport {
public:
    MediaTransport(const EmbreeScene& scene, const LightSampling& lights, const CameraRays& camera,
                   const RenderSettings& settings)
        : _scene(scene), _lights(lights), _camera(camera), _settings(settings) {}

    /// Takes a path along its ray, up to `distance` or to where it scatters.
    Path::Step traverse(Path& path, float distance, TraceCounters& counters) const;

private:
    Path::Step scatter(Path& path, const Medium& medium, float distance,
                       TraceCounters& counters) const;

    const EmbreeScene& _scene;
    const LightSampling& _lights;
    const CameraRays& _camera;
    const RenderSettings& _settings;
};

} // namespace patina
