// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/embree/caustics/photonPass.h"
#include "hdDelegate/embree/caustics/photonTracer.h"
#include "hdDelegate/embree/lightSampling.h"
#include "hdDelegate/embree/metLights.h"
#include "hdDelegate/embree/sampleWriter.h"
#include "hdDelegate/embree/sharing/sharedVertex.h"
#include "hdDelegate/embree/splitting.h"
#include "hdDelegate/film/pixelFilter.h"

#include <atomic>

namespace patina {

/// A unidirectional path tracer: the stages of a path, in their order. Others have their parts:
/// LightSampling and MetLights light, MediaTransport media, PhotonTracer caustics, SampleWriter the
/// film. Everything it refers to is immutable while it traces, so many threads share one.
class Integrator {
public:
    Integrator(const EmbreeScene& scene, const SceneLights& lights, const CameraRays& camera,
               const RenderSettings& settings, const std::vector<AovSpec>& aovs);
    Integrator(const Integrator&) = delete;
    Integrator& operator=(const Integrator&) = delete;

    const PhotonTracer& photonTracer() const { return _photonTracer; }
    /// Caustics come from photons from now on, until the next call. @param pass null: from paths
    void usePhotons(const PhotonPass* pass) { _photons = pass; }
    /// Paths take diffuse light from others from now on. @param light null: they do not
    void useShared(const SharedLight* light) { _shared = light; }
    /// Follows a path for others. @param index of the block's paths
    void findLight(uint32_t block, uint32_t index, SharedPoints& found,
                   TraceCounters& counters) const;

    /// Chooses how often paths are split, as the settings ask or as it pays. Before the first
    /// sample.
    /// @param stopped the render needs no answer any more
    void split(const std::atomic<bool>& stopped);
    bool isSplit() const { return _isSplit; }
    const Splitting& splitting() const { return _splitting; }
    /// Traces one sample of a pixel and adds it to the film.
    void sample(Film& film, int x, int y, uint32_t index, TraceCounters& counters) const;

private:
    using Step = Path::Step;

    // Those that are a bool tell whether the path goes on.
    bool advance(Path& path, const AovTarget& target, TraceCounters& counters) const;
    Step find(Path& path, Hit& hit, TraceCounters& counters) const;
    Step meet(Path& path, SurfacePoint& point, const Hit& hit, bool caught) const;
    bool shadeCatcher(Path& path, const SurfacePoint& point, const Hit& hit,
                      const AovTarget& target, TraceCounters& counters) const;
    bool scatter(Path& path, SurfacePoint& point, const Hit& hit, const AovTarget& target,
                 TraceCounters& counters) const;
    bool disperse(Path& path, SurfacePoint& point, const Hit& hit, const AovTarget& target,
                  TraceCounters& counters) const;
    bool goOn(Path& path, const SurfacePoint& point, const Hit& hit, const Bsdf& bsdf,
              const DispersedBsdf* dispersed, const LightSampling::Draws& draws,
              const AovTarget& target, TraceCounters& counters) const;
    bool branch(Path& path, const SurfacePoint& point, const Hit& hit, const VertexBsdf& vertex,
                bool litBySplats, const AovTarget& target, TraceCounters& counters) const;
    void addLightSamples(Path& path, const SurfacePoint& point, const Hit& hit,
                         const VertexBsdf& vertex, const LightSampling::Draws& draws,
                         TraceCounters& counters) const;
    bool leave(Path& path, const SurfacePoint& point, const Hit& hit, const VertexBsdf& vertex,
               bool litBySplats, const vec4& u, TraceCounters& counters) const;
    bool start(Path& path, const vec2& pixel, uint32_t block) const;
    void start(Path& path, const CameraRay& ray, uint32_t block) const;
    SplitProbe probe(int x, int y, uint32_t index) const;
    void prepare(Path& path, const SurfacePoint& point, Bsdf& bsdf, const AovTarget& target) const;
    bool endsAt(const Path& path, const Hit& hit) const {
        return path.depth >= _settings.maxDepth || _lights.hidesMaterial(hit.surface);
    }
    bool culls(const Geometry& prim, bool back) const {
        return (back ? _cullBack : _cullFront) && (_cullDoubleSided || !prim.doubleSided);
    }

    const EmbreeScene& _scene;
    const SceneLights& _lights;
    const CameraRays& _camera;
    const RenderSettings _settings;
    const SampleWriter _writer;
    const ShadowRays _shadows;
    const LightPathEvents _events;
    const LightSampling _lightSampling;
    const MetLights _metLights;
    const MediaTransport _media;
    const PhotonTracer _photonTracer;
    const PixelFilter _filter;
    const Wavelengths& _wavelengths;      ///< of the rendering space
    const PhotonPass* _photons = nullptr; ///< of the samples that are taken now
    const SharedLight* _shared = nullptr; ///< likewise
    MediumStack _cameraMedia;             ///< that the camera stands in
    const bool _cullBack, _cullFront, _cullDoubleSided, _ambientOcclusion;
    Splitting _splitting;
    bool _isSplit = false;
};

} // namespace patina
