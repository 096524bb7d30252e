// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/compiled/compiledScene.h"
#include "hdDelegate/embree/embreeScene.h"
#include "hdDelegate/embree/integrator.h"
#include "hdDelegate/embree/lightsKey.h"
#include "hdDelegate/embree/tileSchedule.h"
#include "hdDelegate/renderer/renderLoop.h"

#include <atomic>
#include <mutex>

namespace patina {

/// The path tracing back end. The render thread builds and schedules; tiles run on TBB.
class EmbreeRenderer : public RenderLoop {
public:
    EmbreeRenderer() : RenderLoop("embree") {}
    ~EmbreeRenderer() override { stop(); }

private:
    void render(const SceneState& state, const Camera& camera) override;
    void renderTile(const Integrator& integrator, TileSchedule& schedule, int tile);
    void updateScene(const SceneState& state, const Camera& camera);
    std::map<std::string, double> buildCounts() const;
    void publish(const TileSchedule& schedule);
    std::map<std::string, double> materialSeconds();

    // Kept between renders, so that an edit rebuilds only what it touched.
    std::shared_ptr<CompiledScene> _compiled;
    std::unique_ptr<EmbreeScene> _embree;
    LightsKey _lightsKey;
    bool _lightsMayDiffer = true; ///< from what the key was made of
    std::unique_ptr<SceneLights> _lights;
    std::map<std::string, double> _builtBefore; ///< counts of scenes rendered earlier
    size_t _lightsBuilt = 0;
    dvec3 _origin{0.0}; ///< of all that is built, see originOfSeen()

    std::atomic<uint64_t> _rays{0}, _shadowRays{0}, _paths{0};
    std::mutex _spentMutex;
    std::map<const MaterialProgram*, uint64_t> _spent; ///< nanoseconds; guarded by _spentMutex
};

} // namespace patina
