#pragma once

#include "hdDelegate/embree/cameraRays.h"
#include "hdDelegate/embree/embreeScene.h"
#include "hdDelegate/embree/lights/lightSet.h"
#include "hdDelegate/embree/sampler.h"
#include "hdDelegate/film/film.h"

namespace patina {

/// Counts of one thread; summed up for the statistics.
struct TraceCounters {
    uint64_t rays = 0, shadowRays = 0, paths = 0;
};

/// What one camera sample found.
struct PathResult {
    vec3 radiance{0.0f};
    float alpha = 0.0f;
};

/// A unidirectional path tracer with next event estimation; light and BSDF samples are combined by
/// multiple importance sampling with the power heuristic (Veach 1997). Everything it refers to is
/// immutable while it traces, so many threads share one.
class Integrator {
public:
    Integrator(const EmbreeScene& scene, const LightSet& lights, const CameraRays& camera,
               const RenderSettings& settings, const std::vector<AovSpec>& aovs, const SceneState& state);

    /// Traces one sample of a pixel and adds it to the film.
    void sample(Film& film, int x, int y, uint32_t index, TraceCounters& counters) const;

private:
    struct Path;
    struct Medium;

    PathResult trace(const CameraRay& ray, Sampler& sampler, Film& film, int x, int y,
                     float filterDistance, TraceCounters& counters) const;
    void addEscaped(Path& path, bool camera) const;
    void addLightHits(Path& path, float distance, bool& blocked) const;
    vec3 directLight(Path& path, const SurfacePoint& point, const Bsdf& bsdf, const Hit& hit) const;
    vec3 emissionOfSurface(const Path& path, const SurfacePoint& point, const Hit& hit) const;
    vec3 transmittance(Path& path, const vec3& origin, const vec3& direction, float distance,
                       int light) const;
    bool illuminates(int link, const Hit& hit) const;
    void writeAovs(Film& film, int x, int y, float filterDistance, const Path& path,
                   const SurfacePoint* point, const Hit* hit, const Bsdf* bsdf) const;

    const EmbreeScene& _scene;
    const LightSet& _lights;
    const CameraRays& _camera;
    RenderSettings _settings;
    struct AovWriter;
    std::vector<AovSpec> _aovs;
};

} // namespace patina
