// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/embree/aovWriter.h"
#include "hdDelegate/embree/embreeScene.h"
#include "hdDelegate/embree/lightPathRecord.h"
#include "hdDelegate/embree/materialClock.h"
#include "hdDelegate/embree/path.h"
#include "hdDelegate/embree/sceneLights.h"
#include "hdDelegate/film/pixelFilter.h"
#include "base/maths.h"

#include <algorithm>
#include <cmath>

namespace patina {

/// Counts of one thread; summed up for the statistics.
struct TraceCounters {
    uint64_t rays = 0, shadowRays = 0, paths = 0;
    MaterialClock clock;
};

struct PhotonPass;
struct Photon;
class CausticCasters;

constexpr int maxPassThroughs = 256; ///< surfaces that presence lets one ray through

/// The normal on the side that a surface is seen from.
inline vec3 facingNormal(const ShadingPoint& s) {
    return glm::dot(s.viewDirection, s.geometricNormal) < 0.0f ? -s.normal : s.normal;
}

/// Whether a direction leaves a surface on the side that it is seen from.
inline bool staysOutside(const SurfacePoint& point, const vec3& direction) {
    const vec3& n = point.shading.geometricNormal;
    return (glm::dot(point.shading.viewDirection, n) < 0.0f) == (glm::dot(direction, n) < 0.0f);
}

/// The lobes of a vertex of a path.
inline void setUpLobes(const SurfacePoint& point, Bsdf& bsdf) {
    const MaterialProgram& program = *point.slot->program;
    program.evaluate(point.shading, bsdf);
    if (program.hasSubsurface()) bsdf.walkSubsurface();
}

inline float powerHeuristic(float a, float b) {
    if (!std::isfinite(a)) return 1.0f;
    if (std::max(a, b) > 1e18f) { // squares would overflow
        const float ratio = b / a;
        return a > 0.0f ? 1.0f / (1.0f + ratio * ratio) : 0.0f;
    }
    const float aa = a * a, bb = b * b;
    return aa > 0.0f ? aa / (aa + bb) : 0.0f;
}

/// Weight of a sample of density a beside another strategy of density b. The power heuristic is for
/// lights that one strategy finds far better than the other. Both find a sky about as well, and
/// then the balance heuristic has less variance.
inline float misWeight(float a, float b, bool dome) {
    if (!dome) return powerHeuristic(a, b);
    if (!std::isfinite(a)) return 1.0f;
    return a > 0.0f ? a / (a + b) : 0.0f;
}

/// A unidirectional path tracer with next event estimation; light and BSDF samples are combined by
/// multiple importance sampling (Veach 1997), see misWeight(). Everything it refers to is
/// immutable while it traces, so many threads share one.
class Integrator {
public:
    Integrator(const EmbreeScene& scene, const SceneLights& lights, const CameraRays& camera,
               const RenderSettings& settings, const std::vector<AovSpec>& aovs);

    /// Caustics come from photons from now on, until the next call. @param pass null: from paths
    void usePhotons(const PhotonPass* pass) { _photons = pass; }
    /// Sends out a photon. It depends on the block, its index and the seed alone.
    /// @param count of the photons of the block
    Photon photon(const CausticCasters& casters, uint32_t block, uint32_t index, uint32_t count,
                  TraceCounters& counters) const;

    /// Traces one sample of a pixel and adds it to the film.
    void sample(Film& film, int x, int y, uint32_t index, TraceCounters& counters) const;

private:
    /// Light samples of a vertex that are begun; the others begin when they are taken.
    struct LightDraws {
        LightDraws() {} // NOLINT: most vertices begin one

        static constexpr int most = 4;
        union {
            LightDraw begun[most];
        };
        int count = 0;
        bool twoSided = false;
    };
    enum class Step { Arrives, GoesOn, Ends };

    void addFeatures(const Path& path, const AovTarget& target) const;
    // The stages of a path, in their order. Those that are a bool tell whether it goes on.
    void trace(Path& path, const AovTarget& target, TraceCounters& counters) const;
    bool advance(Path& path, const AovTarget& target, TraceCounters& counters) const;
    Step find(Path& path, Hit& hit, TraceCounters& counters) const;
    bool isThere(MediumStack& media, SurfacePoint& point, const Hit& hit) const;
    int priorityOf(const Hit& hit) const {
        return _scene.ranksMedia() ? dielectricPriorityOf(hit) : 0;
    }
    Step meet(Path& path, SurfacePoint& point, const Hit& hit, bool caught) const;
    bool scatter(Path& path, const SurfacePoint& point, const Hit& hit, float width,
                 const AovTarget& target, TraceCounters& counters) const;
    void show(Path& path, const SurfacePoint& point, const Bsdf& bsdf,
              const AovTarget& target) const;
    bool endsAt(const Path& path, const Hit& hit) const {
        return path.depth >= _settings.maxDepth || _lights.hidesMaterial(hit.surface);
    }
    /// @param dispersed the lobes of several wavelengths, or null
    bool goOn(Path& path, const SurfacePoint& point, const Hit& hit, const Bsdf& bsdf,
              const DispersedBsdf* dispersed, const LightDraws& draws,
              TraceCounters& counters) const;

    float addLightsAlong(Path& path, float distance) const;
    void addOwnShadows(Path& path, TraceCounters& counters) const;
    void addInfinite(Path& path, int light, const vec3& seen) const;
    /// Density with which light samples find what a ray from a vertex has met.
    float densityOf(const Path& path, const LightHit& hit) const;
    vec3 filteredTo(const Path& path, int light, float distance) const;
    void addLight(Path& path, int light, const vec3& radiance, float lightPdf) const;
    void addRadiance(Path& path, const vec3& radiance) const;
    void addEscaped(Path& path) const;
    void addEmission(Path& path, const SurfacePoint& point, const Hit& hit, float presence) const;
    /// Begins a light sample for directLight(), before the lobes are known.
    LightDraw beginLight(const Path& path, const SurfacePoint& point, bool twoSided,
                         const vec3& u) const;
    LightDraws beginLights(const Path& path, const SurfacePoint& point) const;
    vec3 directLight(Path& path, const SurfacePoint& point, const VertexBsdf& bsdf, const Hit& hit,
                     const LightDraw& draw, TraceCounters& counters) const;
    /// Light that a medium scatters towards the path, from one light sample.
    vec3 mediumLight(Path& path, const vec3& position, const sh::PhaseMixture& phase, const vec3& u,
                     TraceCounters& counters) const;
    /// Takes the path through the medium that it is in, up to `distance` or to where it scatters.
    Step traverseMedia(Path& path, float distance, TraceCounters& counters) const;
    /// Adds what splats along the path's ray shine, up to `end`.
    /// @returns what they let through up to `way`
    float passSplats(Path& path, float end, float way) const;
    /// What they shine. @param left of the light, up to `way`
    vec3 splatsAlong(Path& path, float end, float way, float& left) const;
    /// Light of splats at a vertex, from one sample.
    vec3 splatLight(Path& path, const SurfacePoint& point, const VertexBsdf& bsdf,
                    TraceCounters& counters) const;
    /// Transmittance along the path's ray up to a distance.
    vec3 transmittanceTo(Path& path, float distance) const;
    Step scatterInside(Path& path, const Medium& medium, float distance,
                       TraceCounters& counters) const;
    bool survivesRoulette(Path& path) const;
    void chooseWavelengths(Path& path, const MaterialProgram& program, ShadingPoint& s) const;
    /// Takes the path through a vertex whose lobes differ between wavelengths.
    bool disperse(Path& path, SurfacePoint& point, const Hit& hit, float width,
                  const AovTarget& target, TraceCounters& counters) const;
    /// Takes a photon over a surface of glass. @param first its flux is not over a cosine yet
    bool bendPhoton(Path& path, const SurfacePoint& point, bool first) const;
    vec3 photonLight(const Path& path, const SurfacePoint& point, const Bsdf& bsdf,
                     float width) const;
    /// Shows photons where the path meets a surface that is no glass, and notes which light they
    /// have from there.
    /// @param width of the ray's cone
    void meetCaustics(Path& path, const SurfacePoint& point, const Bsdf& bsdf, float width) const;
    void depart(Path& path, const SurfacePoint& point, const Hit& hit, const VertexBsdf& bsdf,
                const BsdfSample& next) const;
    /// Light that the camera sees of a prim that is a matte or a catcher; the path may go on by
    /// reflection.
    bool catchLight(Path& path, const SurfacePoint& point, const Hit& hit, const AovTarget& target,
                    TraceCounters& counters) const;
    /// The share of the direct light at a point that does not reach it.
    float shadowed(Path& path, const SurfacePoint& point, const Hit& hit, const Bsdf& bsdf,
                   TraceCounters& counters) const;
    /// Takes the path through subsurface scattering, light at its exit included.
    /// @returns false when the path ends beneath the surface
    bool scatterBeneath(Path& path, const SurfacePoint& point, const Hit& hit,
                        const SubsurfaceEntry& entry, TraceCounters& counters) const;
    vec3 visibility(Path& path, const MediumStack& media, const vec3& origin, const vec3& direction,
                    float distance, const LightInfo& light, TraceCounters& counters) const;
    // For AOVs of light paths: who gives light, and what happens to the path.
    LightEvent emitterOf(int light) const;
    LightEvent glowOf(const Surface& surface) const;
    void recordEmission(const Path& path, const Hit& hit) const;
    /// @param incident radiance over density, with its weight and what is left of it
    void recordDirect(const Path& path, const ShadingPoint& s, const LightSample& light,
                      const BsdfEval& f, const vec3& incident) const;
    void recordScatter(const Path& path, const BsdfSample& next, const VertexBsdf& bsdf) const;
    void addShadow(const Path& path, const vec3& value, const LightSample& light,
                   const vec3& radiance, const vec3& seen) const;
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
    LightPathAovs _lightPaths;
    int _denoisingAlbedo = -1, _denoisingNormal = -1; ///< places in the film, or -1
    bool _guided = false;                             ///< there is one of them
    bool _finiteLights;                               ///< there are some that a ray may meet
    PixelFilter _filter;
    const Wavelengths& _wavelengths;      ///< of the rendering space
    const PhotonPass* _photons = nullptr; ///< of the samples that are taken now
    MediumStack _cameraMedia;             ///< that the camera stands in
    bool _cullBack, _cullFront, _cullDoubleSided, _ambientOcclusion;
    int _lightSamples; ///< at the first vertex
};

} // namespace patina
