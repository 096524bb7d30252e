// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/embree/heroWavelengths.h"
#include "hdDelegate/embree/materialClock.h"
#include "hdDelegate/embree/media/mediumStack.h"
#include "hdDelegate/embree/surface.h"
#include "hdDelegate/film/sampler.h"

#include <type_traits>

namespace patina {

class DeepRay;
class LightPathRecord;
class SharedPoints;
class SplitProbe;

/// Counts of one thread; summed up for the statistics.
struct TraceCounters {
    uint64_t rays = 0, shadowRays = 0, paths = 0;
    MaterialClock clock;

    /// Time that was spent, where one ray with its vertex takes 1.
    float cost() const { return float(rays) + 0.6f * float(shadowRays); }
};

constexpr int maxPassThroughs = 256; ///< surfaces that presence lets one ray through

/// A path while it is traced, as plain data: the ray that goes on, what it carries, and what
/// multiple importance sampling has to know about the vertex it comes from.
struct PathState {
    explicit PathState(const Sampler& s) : sampler(s) {}

    Sampler sampler;
    vec3 origin{0.0f}, direction{0.0f};
    float near = 0.0f, far = 0.0f, time = 0.0f;
    vec3 throughput{1.0f}, radiance{0.0f};
    float alpha = 0.0f;
    float coneWidth = 0.0f, coneSpread = 0.0f;
    float blur = 0.0f;         ///< how far its vertices scatter: their GGX alphas, at most 1
    float travelled = 0.0f;    ///< since the last vertex, over surfaces that were passed through
    int passThroughs = 0;      ///< of these
    int depth = 0;             ///< bounces off surfaces so far
    int scatterings = 0;       ///< inside media
    unsigned rays = RayCamera; ///< kind of the ray, of RayMask
    bool seen = true;    ///< the camera sees the next vertex, if only in mirrors and clear glass
    float share = 1.0f;  ///< that it has of a path that was split
    float caught = 0.0f; ///< alpha that a reflection catcher has where the ray meets something
    bool shown = false;  ///< AOVs have what they show of the first surface
    int screen = -1;     ///< AOV primId of splats that hide it: half of the light is theirs
    vec3 screenPosition{0.0f}; ///< where that is so

    // the last vertex that scattered
    bool specular = true; ///< no light sample could have found this ray
    int lightSamples = 1; ///< that it took
    int branches = 1;     ///< paths that went on from it
    float pdf = 0.0f;     ///< of all branches together
    vec3 vertex{0.0f}, vertexNormal{0.0f};
    bool vertexTwoSided = false;
    vec3 diffuseShare{1.0f}, specularShare{0.0f}; ///< of the throughput's last factor, sum 1
    bool splatsSampled = false; ///< what it sees of splats a sample may have found, too
    bool departs = false;       ///< the ray comes from it directly, and was not traced yet

    // caustics from photons, see PhotonPass::meet()
    bool onPhotons = false;      ///< since a surface that shows photons it has met casters alone
    bool throughCasters = false; ///< and the last vertex is one of them: photons have its light

    // for the denoiser: the first surface that is no mirror
    bool featured = false;
    vec3 featureAlbedo{0.0f}, featureNormal{0.0f};

    /// The camera's own ray, not yet scattered.
    bool fromCamera() const { return depth == 0 && scatterings == 0; }
    bool indirect() const { return depth + scatterings > 1; }
};
static_assert(std::is_trivially_copyable<PathState>::value, "a path moves as bytes do");

/// A path with what stages ask for that few scenes have.
struct Path : PathState {
    using PathState::PathState;

    /// What a stage makes of a path.
    enum class Step { Arrives, GoesOn, Ends };

    MediumStack media;
    HeroWavelengths waves;
    float indirectClamp = 0.0f;             ///< of luminance from the second vertex on; 0: none
    float indirectRoughness = 0.0f;         ///< GGX alpha of surfaces after a diffuse one, at least
    DeepRay* deep = nullptr;                ///< null where no deep image is made
    SplitProbe* probe = nullptr;            ///< null but where splitting is chosen
    SharedPoints* found = nullptr;          ///< null but of paths that are followed for others
    LightPathRecord* lightPaths = nullptr;  ///< shares radiance out; null where no AOV asks
    const Surface* vertexSurface = nullptr; ///< of the last vertex, for light linking
    const std::vector<int>* vertexInstanceCategories = nullptr;

    /// Adds light that arrives by the path.
    void add(const vec3& light);
    /// Lets the ray go straight on behind a surface.
    void pass(const SurfacePoint& point);
    /// Sets the path on its way from a vertex, and keeps what later light hits have to know of it.
    /// @param splitsLobes some light treats diffuse and other lobes differently
    void depart(const SurfacePoint& point, const Hit& hit, const VertexBsdf& bsdf,
                const BsdfSample& next, bool splitsLobes);
    /// Ends paths by chance for what they have lost. @param rouletteDepth of RenderSettings
    bool survivesRoulette(int rouletteDepth);
};

} // namespace patina
