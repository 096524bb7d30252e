#pragma once

#include "hdDelegate/embree/embreeScene.h"
#include "hdDelegate/embree/integrator.h"
#include "hdDelegate/embree/lightsKey.h"
#include "hdDelegate/embree/tileSchedule.h"
#include "hdDelegate/image/textureSystem.h"
#include "hdDelegate/renderer.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <thread>

namespace patina {

/// The path tracing back end. One background thread builds and schedules; tiles run on TBB.
class EmbreeRenderer : public Renderer {
public:
    EmbreeRenderer();
    ~EmbreeRenderer() override;

    void start(std::shared_ptr<Scene> scene, const std::string& camera,
               const RenderSettings& settings, std::shared_ptr<Film> film) override;
    void stop() override;
    void pause() override;
    void resume() override;
    bool isRunning() const override { return _running; }
    void wait() override;
    RenderProgress progress() const override;
    void setListener(FilmListener listener) override { _listener = std::move(listener); }

private:
    using Clock = std::chrono::steady_clock;

    void run(std::shared_ptr<const SceneState> state, std::string cameraPath);
    void render(const SceneState& state, const Camera& camera);
    void renderTile(const Integrator& integrator, TileSchedule& schedule, int tile);
    void updateScene(const SceneState& state, const Camera& camera);
    std::map<std::string, double> buildCounts() const;
    bool waitWhilePaused();
    void maybeCheckpoint();
    void publish(const TileSchedule& schedule);
    void finish(const std::string& failure);
    void notify(bool last);

    std::shared_ptr<Scene> _scene;
    std::shared_ptr<Film> _film;
    RenderSettings _settings;
    FilmListener _listener;
    Clock::time_point _lastTold;
    bool _told = false; ///< the listener heard of this render

    // Kept between renders, so that an edit rebuilds only what it touched.
    std::shared_ptr<Scene> _builtFor;
    std::unique_ptr<EmbreeScene> _embree;
    std::unique_ptr<TextureSystem> _textures;
    std::unique_ptr<LightImages> _lightImages;
    LightsKey _lightsKey;
    std::unique_ptr<SceneLights> _lights;
    std::map<std::string, double> _builtBefore; ///< counts of scenes rendered earlier
    size_t _lightsBuilt = 0;
    dvec3 _origin{0.0}; ///< of all that is built, see originOfSeen()

    std::thread _thread;
    std::mutex _control; ///< start, stop and wait exclude each other
    mutable std::mutex _mutex;
    std::condition_variable _changed;
    RenderProgress _progress;
    std::atomic<bool> _running{false}, _stop{false}, _interrupt{false}, _pause{false};
    bool _idle = true; ///< no thread touches the film
    std::atomic<uint64_t> _rays{0}, _shadowRays{0}, _paths{0};
    Clock::time_point _started, _sampling, _lastCheckpoint;
};

} // namespace patina
