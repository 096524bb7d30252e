#include "hdDelegate/embree/embreeRenderer.h"

#include "hdDelegate/embree/seenOrigin.h"
#include "hdDelegate/parallel.h"
#include "hdDelegate/scene/instancerCheck.h"

#include <cmath>

namespace patina {

namespace {

double secondsSince(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

} // namespace

std::unique_ptr<Renderer> makeRenderer(const std::string& backend) {
    if (backend == "embree") return std::make_unique<EmbreeRenderer>();
    return nullptr;
}

EmbreeRenderer::EmbreeRenderer() {
    _progress.backend = "embree";
}

EmbreeRenderer::~EmbreeRenderer() {
    stop();
}

void EmbreeRenderer::start(std::shared_ptr<Scene> scene, const std::string& camera,
                           const RenderSettings& settings, std::shared_ptr<Film> film) {
    stop();
    std::lock_guard<std::mutex> control(_control);
    _scene = std::move(scene);
    _film = std::move(film);
    _settings = settings;
    _stop = _interrupt = _pause = false;
    {
        std::lock_guard<std::mutex> lock(_mutex);
        _progress = RenderProgress();
        _progress.backend = "embree";
        _idle = false;
    }
    _rays = _shadowRays = _paths = 0;
    _told = false;
    _running = true;
    _started = _sampling = _lastCheckpoint = Clock::now();
    _thread = std::thread(&EmbreeRenderer::run, this, _scene->snapshot(), camera);
}

void EmbreeRenderer::stop() {
    std::lock_guard<std::mutex> control(_control);
    {
        // Locked, or waitWhilePaused() could overwrite _interrupt, and a whole pass would go on.
        std::lock_guard<std::mutex> lock(_mutex);
        _stop = _interrupt = true;
        _pause = false;
    }
    _changed.notify_all();
    if (_thread.joinable()) _thread.join();
}

void EmbreeRenderer::pause() {
    std::unique_lock<std::mutex> lock(_mutex);
    _pause = _interrupt = true;
    _changed.wait(lock, [&] { return _idle || !_running; });
}

void EmbreeRenderer::resume() {
    {
        std::lock_guard<std::mutex> lock(_mutex);
        _pause = false;
    }
    _changed.notify_all();
}

void EmbreeRenderer::wait() {
    std::unique_lock<std::mutex> lock(_mutex);
    _changed.wait(lock, [&] { return !_running; });
}

RenderProgress EmbreeRenderer::progress() const {
    std::lock_guard<std::mutex> lock(_mutex);
    return _progress;
}

void EmbreeRenderer::notify(bool last) {
    if (!_listener) return;
    constexpr double pause = 0.03; // seconds: hosts do not draw more often
    if (_told && !last && secondsSince(_lastTold) < pause) return;
    _told = true;
    RenderProgress seen = progress();
    if (last) {
        seen.converged = true;
        seen.fraction = 1.0;
        seen.secondsLeft = 0.0;
    }
    _listener(*_film, seen);
    _lastTold = Clock::now();
}

void EmbreeRenderer::finish(const std::string& failure) {
    if (!failure.empty()) {
        RenderProgress seen = progress();
        seen.failed = true;
        seen.error = failure;
        if (_listener) _listener(*_film, seen);
        std::lock_guard<std::mutex> lock(_mutex);
        _progress = seen;
        return;
    }
    notify(true);
    std::lock_guard<std::mutex> lock(_mutex);
    _progress.converged = true;
    _progress.fraction = 1.0;
    _progress.secondsLeft = 0.0;
}

void EmbreeRenderer::run(std::shared_ptr<const SceneState> state, std::string cameraPath) {
    try {
        if (_settings.width < 1 || _settings.height < 1)
            throw std::runtime_error("the image has no pixels");
        const auto camera = state->cameras.find(cameraPath);
        if (camera == state->cameras.end())
            throw std::runtime_error("there is no camera " + cameraPath);
        for (const dmat4& transform : camera->second->transform.values)
            if (!hasInverse(mat4(transform)))
                throw std::runtime_error("the camera " + cameraPath +
                                         " has a transform without an inverse");
        render(*state, *camera->second);
    } catch (const std::exception& error) {
        finish(error.what());
    }
    {
        std::lock_guard<std::mutex> lock(_mutex);
        _running = false;
        _idle = true;
    }
    _changed.notify_all();
}

bool EmbreeRenderer::waitWhilePaused() {
    std::unique_lock<std::mutex> lock(_mutex);
    if (_pause) {
        _idle = true;
        _changed.notify_all();
        _changed.wait(lock, [&] { return !_pause; });
        _idle = false;
    }
    _interrupt = bool(_stop);
    return !_stop;
}

void EmbreeRenderer::maybeCheckpoint() {
    if (_settings.checkpointFile.empty() ||
        secondsSince(_lastCheckpoint) < _settings.checkpointSeconds)
        return;
    try {
        _film->saveCheckpoint(_settings.checkpointFile);
    } catch (const std::exception& e) { // a full disk: the render is worth more
        _scene->diagnostics().warn("", "", e.what());
    }
    _lastCheckpoint = Clock::now();
}

void EmbreeRenderer::publish(const TileSchedule& schedule) {
    std::lock_guard<std::mutex> lock(_mutex);
    _progress.fraction = schedule.fraction();
    _progress.samplesDone = schedule.samplesDone();
    _progress.secondsRendering = secondsSince(_sampling);
    _progress.secondsLeft =
        _progress.fraction > 0.0
            ? _progress.secondsRendering * (1.0 - _progress.fraction) / _progress.fraction
            : 0.0;
    _progress.statistics["rays"] = double(_rays + _shadowRays);
    _progress.statistics["shadowRays"] = double(_shadowRays);
    _progress.statistics["paths"] = double(_paths);
    _progress.statistics["droppedSamples"] = double(_film->droppedSamples());
}

void EmbreeRenderer::renderTile(const Integrator& integrator, TileSchedule& schedule, int tile) {
    if (_interrupt) return;
    const int target = schedule.target(tile);
    const Tile& t = schedule.tiles()[tile];
    TraceCounters counters;
    // The last pixel of the tile is done last: its count tells how far the whole tile is.
    for (int y = t.y0; y < t.y1 && !_interrupt; ++y)
        for (int x = t.x0; x < t.x1; ++x)
            for (int i = int(_film->sampleCount(x, y)); i < target; ++i)
                integrator.sample(*_film, x, y, uint32_t(i), counters);
    _rays += counters.rays;
    _shadowRays += counters.shadowRays;
    _paths += counters.paths;
}

std::map<std::string, double> EmbreeRenderer::buildCounts() const {
    std::map<std::string, double> counts = _builtBefore;
    if (!_embree) return counts;
    const BuildCounts& built = _embree->counts();
    counts["surfacesBuilt"] += double(built.surfaces);
    counts["surfacesTessellated"] += double(built.tessellated);
    counts["groupsBuilt"] += double(built.groups);
    counts["programsBuilt"] += double(built.programs);
    return counts;
}

void EmbreeRenderer::updateScene(const SceneState& state, const Camera& camera) {
    if (!_textures || _builtFor != _scene) {
        _builtBefore = buildCounts();
        _lights.reset();
        _lightsKey = LightsKey();
        _embree.reset();
        _textures = std::make_unique<TextureSystem>(_scene->diagnostics());
        _lightImages = std::make_unique<LightImages>(_scene->diagnostics());
        _embree = std::make_unique<EmbreeScene>(_scene->diagnostics());
        _builtFor = _scene;
        _origin = dvec3(0.0);
    }
    // Few scenes are seen so far from the origin that they are built once more; while the camera
    // stays there, the origin does too.
    constexpr int maxMoves = 2;
    for (int i = 0; i <= maxMoves; ++i) {
        _embree->update(state, camera, _settings, *_textures, _stop, _origin);
        if (_stop) return;
        const dvec3 origin = originOfSeen(*_embree, camera, _settings);
        if (origin == _origin || i == maxMoves) break;
        _origin = origin;
    }
    LightsKey key = makeLightsKey(state, *_embree, camera, _settings);
    if (_lights && key == _lightsKey) return;
    _lights = std::make_unique<SceneLights>(state, *_embree, camera, _settings, *_lightImages,
                                            _scene->diagnostics());
    _lightsKey = std::move(key);
    ++_lightsBuilt;
}

void EmbreeRenderer::render(const SceneState& state, const Camera& camera) {
    const auto buildStart = Clock::now();
    constexpr int maxThreads = 4096;
    Arena arena(std::min(_settings.threads, maxThreads));
    arena.execute([&] { updateScene(state, camera); });
    if (_stop) return;
    ScenePlan plan = _embree->plan();
    plan.addPaths(_settings);
    {
        std::lock_guard<std::mutex> lock(_mutex);
        _progress.statistics = buildCounts();
        _progress.statistics["lightsBuilt"] = double(_lightsBuilt);
        _progress.statistics["bytes"] = double(_embree->bytes());
        _progress.statistics["secondsBuild"] = secondsSince(buildStart);
        _progress.statistics["trianglesStored"] = double(_embree->trianglesStored());
        _progress.statistics["instances"] = double(_embree->instanceCount());
        plan.addStatistics(_settings.tolerance, _progress.statistics);
        _progress.plans = plan.materials();
        _progress.sceneChoices = plan.choices();
        _progress.statistics["maxDepth"] = plan.depth(_settings);
    }

    const std::vector<AovSpec> aovs = renderedAovs(_settings.aovs);
    _film->reset(_settings.width, _settings.height, aovs, !_film->resumeToken.empty());

    const CameraRays rays(camera, _settings, _origin);
    RenderSettings sampled = _settings;
    sampled.tolerance = plan.noise(_settings.tolerance);
    sampled.maxDepth = plan.depth(_settings);
    sampled.rouletteDepth = plan.rouletteDepth(_settings);
    const Integrator integrator(*_embree, *_lights, rays, sampled, aovs);
    TileSchedule schedule(*_film, sampled);
    _sampling = _lastCheckpoint = Clock::now();
    const auto outOfTime = [&] {
        return _settings.seconds > 0.0 && secondsSince(_started) > _settings.seconds;
    };
    bool haveImage = schedule.samplesDone() > 0; // the time limit never leaves holes
    while (!_stop) {
        const std::vector<int> tiles = schedule.pending();
        if (tiles.empty()) break;
        arena.execute([&] {
            parallelForEach(tiles.begin(), tiles.end(), [&](int tile) {
                renderTile(integrator, schedule, tile);
                if (haveImage && outOfTime()) _interrupt = true;
                if (!_settings.checkpointFile.empty() &&
                    secondsSince(_lastCheckpoint) > _settings.checkpointSeconds)
                    _interrupt = true;
            });
        });
        publish(schedule);
        maybeCheckpoint();
        haveImage = haveImage || schedule.samplesDone() > 0;
        if (!_stop && haveImage && !schedule.pending().empty()) notify(false);
        if (!waitWhilePaused()) return;
        if (haveImage && outOfTime()) break;
    }
    if (_stop) return;
    publish(schedule);
    finish("");
}

} // namespace patina
