// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/embree/cameraRays.h"
#include "hdDelegate/embree/lightPathEvents.h"
#include "hdDelegate/embree/shadowRays.h"

namespace patina {

/// Lights that the ray of a path meets, weighted against what light samples would have found: the
/// other half of LightSampling.
class MetLights {
public:
    /// @param enabled lights that are no surfaces are there
    MetLights(const EmbreeScene& scene, const SceneLights& lights, const ShadowRays& shadows,
              const LightPathEvents& events, const CameraRays& camera, bool enabled)
        : _scene(scene), _lights(lights), _shadows(shadows), _events(events), _camera(camera),
          _shapes(enabled && lights.set().hasIntersectable()) {}

    /// Adds shapes of lights that the ray meets before `distance`.
    /// @returns where the camera's ray ends on one, or `distance`
    float along(Path& path, float distance) const;
    /// Adds lights at infinity.
    void escaped(Path& path) const;
    /// Adds light that the surface itself gives off towards the ray.
    void emission(Path& path, const SurfacePoint& point, const Hit& hit, float presence) const;
    /// Adds lights with shadows of their own, which a ray from a vertex finds past the shapes that
    /// stop it, as light samples do. Triangles that glow are left to light samples. A mirror shows
    /// lights where its ray meets them.
    void withOwnShadows(Path& path, TraceCounters& counters) const;

private:
    /// The share of a light that its filters leave for the point that it lights: where the path
    /// comes from. @param distance along the ray
    vec3 filtered(const Path& path, int light, float distance) const;
    /// Density with which light samples find what a ray from a vertex has met.
    float densityOf(const Path& path, const LightHit& hit) const;
    /// @param lightPdf with which light samples would have found it
    void add(Path& path, int light, const vec3& radiance, float lightPdf) const;
    /// @param seen what is left of the light on its way
    void addInfinite(Path& path, int light, const vec3& seen) const;
    void show(Path& path, int light, const vec3& radiance) const; ///< to the camera

    const EmbreeScene& _scene;
    const SceneLights& _lights;
    const ShadowRays& _shadows;
    const LightPathEvents& _events;
    const CameraRays& _camera;
    const bool _shapes; ///< there are some that a ray may meet
};

} // namespace patina
