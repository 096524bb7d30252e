#pragma once

#include "hdDelegate/embree/aovWriter.h"
#include "hdDelegate/embree/embreeScene.h"
#include "hdDelegate/embree/path.h"
#include "hdDelegate/embree/pixelFilter.h"
#include "hdDelegate/embree/sceneLights.h"

namespace patina {

/// Counts of one thread; summed up for the statistics.
struct TraceCounters {
    uint64_t rays = 0, shadowRays = 0, paths = 0;
};

/// A unidirectional path tracer with next event estimation; light and BSDF samples are combined by
/// multiple importance sampling with the power heuristic (Veach 1997). Everything it refers to is
/// immutable while it traces, so many threads share one.
class Integrator {
public:
    Integrator(const EmbreeScene& scene, const SceneLights& lights, const CameraRays& camera,
               const RenderSettings& settings, const std::vector<AovSpec>& aovs);

    /// Traces one sample of a pixel and adds it to the film.
    void sample(Film& film, int x, int y, uint32_t index, TraceCounters& counters) const;

private:
    void trace(Path& path, const AovTarget& target, TraceCounters& counters) const;
    bool addLightsAlong(Path& path, float distance) const;
    void addLight(Path& path, int light, const vec3& radiance, float lightPdf,
                  float distance) const;
    void addRadiance(Path& path, const vec3& radiance) const;
    void addEscaped(Path& path) const;
    void addEmission(Path& path, const SurfacePoint& point, const Hit& hit) const;
    vec3 directLight(const Path& path, const SurfacePoint& point, const Bsdf& bsdf, const Hit& hit,
                     const vec3& u, TraceCounters& counters) const;
    vec3 visibility(const Path& path, const vec3& origin, const vec3& direction, float distance,
                    const LightInfo& light, TraceCounters& counters) const;
    bool linked(int category, const Surface* surface, const std::vector<int>* instance) const;
    bool cullsBack(const Geometry& prim) const {
        return _cullBack && (_cullDoubleSided || !prim.doubleSided);
    }
    bool cullsFront(const Geometry& prim) const {
        return _cullFront && (_cullDoubleSided || !prim.doubleSided);
    }

    const EmbreeScene& _scene;
    const SceneLights& _lights;
    const CameraRays& _camera;
    RenderSettings _settings;
    std::vector<AovSpec> _aovs;
    PixelFilter _filter;
    bool _cullBack, _cullFront, _cullDoubleSided;
};

} // namespace patina
