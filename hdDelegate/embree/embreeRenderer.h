// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/compiled/compiledScene.h"
#include "hdDelegate/embree/embreeScene.h"
#include "hdDelegate/embree/integrator.h"
#include "hdDelegate/embree/lightsKey.h"
#include "hdDelegate/embree/sampleBlock.h"
#include "hdDelegate/embree/tileSchedule.h"
#include "hdDelegate/parallel.h"
#include "hdDelegate/renderer/renderLoop.h"

#include <atomic>
#include <functional>
#include <mutex>

namespace patina {

/// The path tracing back end. The render thread builds and schedules; tiles run on TBB.
class EmbreeRenderer : public RenderLoop {
public:
    EmbreeRenderer() : RenderLoop("embree") {}
    ~EmbreeRenderer() override { stop(); }

private:
    void render(const SceneState& state, const Camera& camera) override;
    /// @param end of the samples that are taken now, even where the schedule wants more
    void renderTile(const Integrator& integrator, TileSchedule& schedule, int tile, int end);
    /// Where a host waits for a first image, and a pass takes long: shows some of its pixels as
    /// blocks, then more of them in smaller blocks. The pass that follows takes the others. Which
    /// pixels come first changes no sample.
    void showBlocks(const Integrator& integrator, const TileSchedule& schedule, Arena& arena);
    /// The casters of the scene, where photons are asked for and show all that paths would.
    std::unique_ptr<CausticCasters> casters(const RenderSettings& settings, const Camera& camera,
                                            const std::vector<AovSpec>& aovs) const;
    /// Whether paths share light: it is asked for, and cells know all that tells paths apart.
    bool sharesLight(const RenderSettings& settings, const Camera& camera,
                     const std::vector<AovSpec>& aovs) const;
    /// Whether samples count for all pixels that their filter reaches: it is asked for, and all
    /// that is asked for can be shown so.
    bool splats(const Camera& camera, const std::vector<AovSpec>& aovs) const;
    void split(Integrator& integrator, Arena& arena);
    /// Takes samples up to the schedule's targets in blocks, each with photons and light of its
    /// own. @param casters null: without photons
    void takeBlocks(Integrator& integrator, const CausticCasters* casters, bool sharesLight,
                    const TileSchedule& schedule, const std::vector<int>& tiles, Arena& arena,
                    const std::function<void(int end)>& take);
    /// Sends out the photons of a block of samples.
    PhotonMap photons(const PhotonTracer& tracer, const CausticCasters& casters, int block);
    /// Finds the light that a block of samples shares.
    SharedLight shared(const Integrator& integrator, int block);
    void updateScene(const SceneState& state, const Camera& camera);
    /// The camera's map, from the render before where that has the same.
    const std::shared_ptr<const DistortionMap>& distortionOf(const Camera& camera);
    std::map<std::string, double> buildCounts() const;
    void publish(const TileSchedule& schedule);
    void addCounts(const TraceCounters& counters);
    std::map<std::string, double> materialSeconds();

    // Kept between renders, so that an edit rebuilds only what it touched.
    std::shared_ptr<CompiledScene> _compiled;
    std::unique_ptr<EmbreeScene> _embree;
    LightsKey _lightsKey;
    bool _lightsMayDiffer = true; ///< from what the key was made of
    std::unique_ptr<SceneLights> _lights;
    std::shared_ptr<const DistortionMap> _distortion;
    std::string _distortionFile;
    int _block = -1; ///< that has these:
    PhotonPass _photonPass;
    SharedLight _sharedLight;
    std::map<std::string, double> _builtBefore; ///< counts of scenes rendered earlier
    size_t _lightsBuilt = 0;
    dvec3 _origin{0.0}; ///< of all that is built, see originOfSeen()

    std::atomic<uint64_t> _rays{0}, _shadowRays{0}, _paths{0};
    std::mutex _spentMutex;
    std::map<const MaterialProgram*, uint64_t> _spent; ///< nanoseconds; guarded by _spentMutex
    std::unique_ptr<Arena> _arena;                     ///< null before the first render
    int _arenaThreads = 0;
};

} // namespace patina
