#include "hdDelegate/raster/rasterRenderer.h"

#include "hdDelegate/film/sampler.h"
#include "hdDelegate/raster/gl/deviceError.h"
#include "hdDelegate/film/relativeError.h"
#include "hdDelegate/raster/gl/eglContext.h"
#include "hdDelegate/raster/gl/glFaults.h"
#include "hdDelegate/raster/gl/programCompiler.h"
#include "hdDelegate/raster/passes/rasterPasses.h"
#include "hdDelegate/scene/instancerCheck.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <cstdlib>
#include <mutex>
#include <stdexcept>
#include <thread>

namespace patina {

namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Runs a function on a thread of its own: where a host's thread has a context of GLX current, EGL
/// can make none current, and OpenGL's functions would reach the host's.
template <class Function> void onOwnThread(const Function& function) {
    std::thread(function).join();
}

class RasterRenderer : public Renderer {
public:
    explicit RasterRenderer(std::unique_ptr<EglContext> context) : _context(std::move(context)) {
        _progress.backend = "raster";
    }

    ~RasterRenderer() override {
        stop();
        onOwnThread([this] {
            {
                const EglContext::Use use(*_context);
                release();
                _compiler.reset();
            }
            _context.reset();
        });
    }

    void start(std::shared_ptr<Scene> scene, const std::string& camera,
               const RenderSettings& settings, std::shared_ptr<Film> film) override {
        stop();
        const std::lock_guard<std::mutex> control(_control);
        _scene = std::move(scene);
        _film = std::move(film);
        _settings = settings;
        const auto samples = settings.methods.find("environmentSamples");
        if (samples != settings.methods.end() && settings.environmentSamples <= 0)
            _settings.environmentSamples = std::atoi(samples->second.c_str());
        _stop = _pause = false;
        {
            const std::lock_guard<std::mutex> lock(_mutex);
            _progress = RenderProgress();
            _progress.backend = "raster";
            _idle = false;
        }
        _running = true;
        _compiling = false;
        _started = Clock::now();
        _thread = std::thread(&RasterRenderer::run, this, _scene->snapshot(), camera);
    }

    void stop() override {
        const std::lock_guard<std::mutex> control(_control);
        _stop = true;
        {
            const std::lock_guard<std::mutex> lock(_mutex);
            _pause = false;
        }
        _changed.notify_all();
        if (_thread.joinable()) _thread.join();
    }

    void pause() override {
        std::unique_lock<std::mutex> lock(_mutex);
        _pause = true;
        _changed.wait(lock, [&] { return _idle || !_running; });
    }

    void resume() override {
        {
            const std::lock_guard<std::mutex> lock(_mutex);
            _pause = false;
        }
        _changed.notify_all();
    }

    bool isRunning() const override { return _running; }

    void wait() override {
        std::unique_lock<std::mutex> lock(_mutex);
        _changed.wait(lock, [&] { return !_running; });
    }

    RenderProgress progress() const override {
        const std::lock_guard<std::mutex> lock(_mutex);
        return _progress;
    }

    void setListener(FilmListener listener) override { _listener = std::move(listener); }

private:
    void release() {
        _lights.reset();
        _passes.reset();
        _raster.reset();
        _images.reset();
        _domes.reset();
        _builtFor.reset();
    }

    void run(std::shared_ptr<const SceneState> state, std::string cameraPath) {
        std::string failure;
        bool deviceFailed = false;
        try {
            const EglContext::Use use(*_context);
            if (!use.ok()) throw DeviceError("the OpenGL context cannot be used");
            if (!_deviceFailure.empty()) throw DeviceError(_deviceFailure);
            if (_settings.width < 1 || _settings.height < 1)
                throw std::runtime_error("the image has no pixels");
            const auto camera = state->cameras.find(cameraPath);
            if (camera == state->cameras.end())
                throw std::runtime_error("there is no camera " + cameraPath);
            for (const dmat4& transform : camera->second->transform.values)
                if (!hasInverse(mat4(transform)))
                    throw std::runtime_error("the camera " + cameraPath +
                                             " has a transform without an inverse");
            try {
                render(*state, *camera->second);
            } catch (const DeviceError& error) {
                _deviceFailure = error.what();
                release(); // another back end needs the memory
                _compiler.reset();
                throw;
            }
        } catch (const DeviceError& error) {
            failure = "the rasterizer has failed: " + std::string(error.what());
            deviceFailed = true;
        } catch (const std::exception& error) {
            failure = error.what();
        }
        finish(failure, deviceFailed);
    }

    /// @param standIns shows displayColor where programs are not ready, instead of waiting
    void build(const SceneState& state, const RasterCamera& camera, bool standIns) {
        if (_builtFor != _scene) {
            release();
            std::string error;
            _passes = std::make_unique<RasterPasses>(error);
            if (!_passes->ok())
                throw DeviceError("the driver does not take the shaders: " + oneLine(error));
            _passes->setFirstDraws([this] {
                const std::lock_guard<std::mutex> lock(_mutex);
                ++_progress.statistics["materialsDrawn"];
            });
            if (!_compiler) _compiler = std::make_unique<ProgramCompiler>(*_context, helpers());
            _raster = std::make_unique<RasterScene>(_scene->diagnostics(), _compiler.get());
            _images = std::make_unique<LightImages>(_scene->diagnostics());
            _domes = std::make_unique<RasterDomes>();
            _builtFor = _scene;
        }
        std::function<void(const RasterMaterials::Ready&)> compiling;
        if (!standIns)
            compiling = [this](const RasterMaterials::Ready& ready) { notifyCompiling(ready); };
        _raster->update(state, _origin, camera, _settings, lightPlan(state), _stop, compiling);
        if (standIns) notifyCompiling(_raster->programsReady());
        if (_stop) return;
        // Every sample of a dome costs a shadow map: few of them where that takes long.
        const int domeSamples = _raster->trianglesDrawn() > 1000000 ? 1 : 4;
        RasterInstances places(state, _settings, camera.timeCode(0.5f), _origin);
        _lights = std::make_unique<RasterLights>(
            state, _settings, places, camera.timeCode(0.5f), domeSamples, _raster->domeMethods(),
            *_images, *_domes, _raster->categories(), _scene->diagnostics());
    }

    /// Threads that compile beside this one.
    int helpers() const {
        const int threads =
            _settings.threads > 0 ? _settings.threads : int(std::thread::hardware_concurrency());
        return std::clamp(threads - 1, 0, 7);
    }

    void notifyCompiling(const RasterMaterials::Ready& ready) {
        const std::lock_guard<std::mutex> lock(_mutex);
        if (!_compiling) {
            _compiling = true;
            _readyAtStart = ready.ready;
            _compileStarted = Clock::now();
        }
        _progress.statistics["materialsWanted"] = double(ready.wanted);
        _progress.statistics["materialsReady"] = double(ready.ready);
        // Those that were ready before tell nothing of how long the others take.
        if (_progress.samplesDone == 0 && ready.ready > _readyAtStart)
            _progress.secondsLeft = secondsSince(_compileStarted) *
                                    double(ready.wanted - ready.ready) /
                                    double(ready.ready - _readyAtStart);
    }

    /// What lights there are for the planner to look at; without a tolerance it does not.
    RasterLightPlan lightPlan(const SceneState& state) {
        RasterLightPlan plan;
        if (_settings.tolerance < 0.0) return plan;
        for (const auto& item : state.geometry)
            if (item.second->kind == GeometryKind::Volume) plan.needSamples();
        for (const auto& item : state.lights) {
            const Light& light = *item.second;
            if (!_settings.enableSceneLights || !light.visible) continue;
            if (light.type != LightType::Dome) {
                plan.addArea(light);
                continue;
            }
            std::shared_ptr<const EnvironmentMap> map;
            if (!light.textureFile.empty())
                map = _images->environment(light.textureFile, light.textureColorSpace,
                                           environmentFormat(light.textureFormat), light.path,
                                           "inputs:texture:file");
            plan.addDome(map.get());
        }
        return plan;
    }

    /// With places as seen from the origin.
    RasterCamera cameraFrom(Camera camera) const {
        for (dmat4& transform : camera.transform.values)
            transform[3] -= glm::dvec4(_origin, 0.0f);
        return RasterCamera(camera, _settings);
    }

    void render(const SceneState& state, const Camera& cameraPrim) {
        RasterCamera camera = cameraFrom(cameraPrim);
        if (cameraPrim.clippingPlanes.size() > size_t(RasterPasses::maxPlanes))
            _scene->diagnostics().warn(cameraPrim.path, "clippingPlanes",
                                       "the rasterizer clips by the first " +
                                           std::to_string(RasterPasses::maxPlanes) + " alone");
        checkDevice(0);
        // Somebody looks on: images of what there is until all is there.
        const bool early = _settings.interactive && _listener && _film->resumeToken.empty();
        build(state, camera, early);
        if (_stop) return;
        const PixelFilter filter(_settings.filterRadius);
        int border = filter.reach();
        if (!_passes->resize(_settings, border))
            throw DeviceError("the driver has no room for an image of " +
                              std::to_string(_settings.width) + " x " +
                              std::to_string(_settings.height) + " pixels");
        checkDevice(0);
        const std::vector<AovSpec> aovs = renderedAovs(_settings.aovs);
        _passes->clearSeconds();
        _passes->drawAovs(*_raster, camera);
        if (const vec3 origin = _passes->originOfSeen(*_raster); origin != _origin) {
            _origin = origin;
            camera = cameraFrom(cameraPrim);
            build(state, camera, early);
            if (_stop) return;
            _passes->drawAovs(*_raster, camera);
        }
        while (early && _raster->standIns() > 0) {
            showEarly(state, camera, aovs, sampleOf(0, filter, border));
            if (!waitForPrograms() || !waitWhilePaused()) return;
            build(state, camera, true);
            if (_stop) return;
            _passes->clearSeconds();
            _passes->drawAovs(*_raster, camera);
        }
        _film->reset(_settings.width, _settings.height, aovs, !_film->resumeToken.empty());
        {
            const std::lock_guard<std::mutex> lock(_mutex);
            _progress.statistics["secondsBuild"] = secondsSince(_started);
            _progress.statistics["trianglesStored"] = double(_raster->triangles());
            _progress.statistics["bytes"] = double(_raster->bytes());
            _progress.statistics["surfacesBuilt"] = double(_raster->shapesBuilt());
            _progress.statistics["instancesWritten"] = double(_raster->instancesWritten());
            _progress.statistics["instances"] = double(_raster->instanceCount());
            _progress.statistics["programsBuilt"] = double(_raster->programsBuilt());
            const ScenePlan plan = _raster->plan();
            plan.addStatistics(_settings.tolerance, _progress.statistics);
            _progress.plans = plan.materials();
            if (_settings.tolerance >= 0.0) _progress.sceneChoices = plan.choices();
        }
        _passes->writeAovs(*_raster, camera, aovs, *_film);
        const auto sampling = Clock::now();
        const int* window = _passes->window();
        const bool empty = window[2] < window[0] || window[3] < window[1];
        const uint32_t taken = empty ? 0 : _film->sampleCount(window[2], window[3]);
        const auto moveTo = [&](const RasterSample& sample) {
            _raster->moveTo(state, _settings, camera.timeCode(sample.time));
        };
        const uint32_t again = RasterPasses::passesToRepeat(taken);
        if (again > 0) {
            Film film;
            film.reset(_settings.width, _settings.height, {}, false);
            for (uint32_t i = 0; i < again && !_stop; ++i) {
                const RasterSample sample = sampleOf(i, filter, border);
                moveTo(sample);
                _passes->draw(*_raster, *_lights, *_domes, _raster->environmentSamples(), camera,
                              sample, film);
            }
        }
        _passes->resumeAt(*_raster, *_lights, again, taken,
                          [&](uint32_t pass) { moveTo(sampleOf(pass, filter, 0)); });
        auto saved = Clock::now();
        auto told = Clock::now() - std::chrono::seconds(1);
        for (uint32_t i = taken; i < uint32_t(std::max(1, _settings.samples)) && !_stop; ++i) {
            if (isGoodEnough(int(i))) break;
            const RasterSample sample = sampleOf(i, filter, border);
            _raster->moveTo(state, _settings, camera.timeCode(sample.time));
            _passes->draw(*_raster, *_lights, *_domes, _raster->environmentSamples(), camera,
                          sample, *_film);
            checkDevice(int(i) + 1);
            {
                const std::lock_guard<std::mutex> lock(_mutex);
                _progress.samplesDone = int(i) + 1;
                reportSeconds();
                _progress.fraction = double(i + 1) / std::max(1, _settings.samples);
                _progress.secondsRendering = secondsSince(sampling);
                _progress.secondsLeft =
                    _progress.secondsRendering * (1.0 - _progress.fraction) / _progress.fraction;
            }
            if (_listener && int(i) + 1 < _settings.samples &&
                Clock::now() - told > std::chrono::milliseconds(30)) {
                _listener(*_film, progress());
                told = Clock::now();
            }
            if (!_settings.checkpointFile.empty() &&
                secondsSince(saved) > _settings.checkpointSeconds) {
                try {
                    _film->saveCheckpoint(_settings.checkpointFile);
                } catch (const std::exception& e) { // a full disk: the render is worth more
                    _scene->diagnostics().warn("", "", e.what());
                }
                saved = Clock::now();
            }
            if (!waitWhilePaused()) return;
            if (_settings.seconds > 0.0 && secondsSince(_started) > _settings.seconds) break;
        }
    }

    /// Until an image with more of them is worth its time. @returns false when the render is
    /// stopped
    bool waitForPrograms() {
        const auto began = Clock::now();
        const size_t before = _raster->programsReady().ready;
        while (!_stop) {
            const RasterMaterials::Ready now = _raster->programsReady();
            notifyCompiling(now);
            if (now.ready == now.wanted ||
                (now.ready > before && secondsSince(began) > earlySeconds))
                break;
            _raster->waitForPrograms(std::chrono::milliseconds(50));
        }
        return !_stop;
    }

    /// One pass with what is ready, in a film of its own: nothing of it reaches the final image.
    void showEarly(const SceneState& state, const RasterCamera& camera,
                   const std::vector<AovSpec>& aovs, const RasterSample& sample) {
        Film film;
        film.reset(_settings.width, _settings.height, aovs, false);
        _passes->writeAovs(*_raster, camera, aovs, film);
        _raster->moveTo(state, _settings, camera.timeCode(sample.time));
        _passes->draw(*_raster, *_lights, *_domes, _raster->environmentSamples(), camera, sample,
                      film);
        checkDevice(0);
        RenderProgress told = progress();
        told.samplesDone = 1;
        if (!_stop) _listener(film, told);
    }

    /// @param border of the image, as RasterPasses::resize() has left it
    RasterSample sampleOf(uint32_t pass, const PixelFilter& filter, int border) const {
        Sampler numbers(0, 0, _settings.seed, pass);
        RasterSample sample;
        sample.pass = pass;
        sample.taken = pass + 1;
        const vec2 beside = filter.sample(numbers.next2());
        // The first image stands where the last one will, and is as soft: a pixel is the mean of
        // its corners.
        sample.offset = pass > 0 ? beside : vec2(border > 0 ? 0.5f : 0.0f);
        sample.lens = numbers.next2();
        sample.time = numbers.next2().x;
        if (border > 0) {
            sample.splatX = filter.splatWeights(sample.offset.x);
            sample.splatY = filter.splatWeights(sample.offset.y);
        }
        return sample;
    }

    /// Whether the image of so many passes meets the tolerance.
    bool isGoodEnough(int passes) const {
        if (!(_settings.tolerance > 0.0) || passes < std::max(2, _settings.minSamples) ||
            !isErrorStep(passes))
            return false;
        const int* w = _passes->window();
        return relativeError(*_film, w[0], w[1], w[2] + 1, w[3] + 1, PixelNoise::Shared) <=
               _raster->plan().noise(_settings.tolerance);
    }

    /// With _mutex held.
    void reportSeconds() {
        auto& to = _progress.statistics;
        to["secondsAovs"] = _passes->seconds(RasterPasses::Aovs);
        to["secondsShadows"] = _passes->seconds(RasterPasses::Shadows);
        to["secondsSurfaces"] = _passes->seconds(RasterPasses::Surfaces);
        to["secondsRead"] = _passes->seconds(RasterPasses::ReadBack);
    }

    /// @param passes that were drawn
    void checkDevice(int passes) const {
        const auto asked = [&](const char* fault) {
            const std::string after = glFault(fault);
            return !after.empty() && passes >= std::atoi(after.c_str());
        };
        bool full = asked("memory");
        for (GLenum error; !full && (error = gl.GetError()) != GL_NO_ERROR;)
            full = error == GL_OUT_OF_MEMORY;
        if (full) throw DeviceError("the driver is out of memory");
        if (_context->lost() || asked("lost"))
            throw DeviceError("the driver has reset the OpenGL context");
    }

    bool waitWhilePaused() {
        std::unique_lock<std::mutex> lock(_mutex);
        if (_pause) {
            _idle = true;
            _changed.notify_all();
            _changed.wait(lock, [&] { return !_pause; });
            _idle = false;
        }
        return !_stop;
    }

    void finish(const std::string& failure, bool deviceFailed) {
        RenderProgress seen = progress();
        if (!failure.empty()) {
            seen.failed = true;
            seen.deviceFailed = deviceFailed;
            seen.error = failure;
        } else if (!_stop) {
            seen.converged = true;
            seen.fraction = 1.0;
            seen.secondsLeft = 0.0;
        }
        if (_listener && (seen.converged || seen.failed)) _listener(*_film, seen);
        {
            const std::lock_guard<std::mutex> lock(_mutex);
            _progress = seen;
            _running = false;
            _idle = true;
        }
        _changed.notify_all();
    }

    std::unique_ptr<EglContext> _context;
    std::unique_ptr<ProgramCompiler> _compiler; ///< goes before its context
    std::shared_ptr<Scene> _scene, _builtFor;
    std::shared_ptr<Film> _film;
    RenderSettings _settings;
    FilmListener _listener;

    // Kept between renders, so that an edit rebuilds less than everything.
    std::unique_ptr<RasterPasses> _passes;
    std::unique_ptr<RasterScene> _raster;
    std::unique_ptr<RasterLights> _lights;
    std::unique_ptr<LightImages> _images;
    std::unique_ptr<RasterDomes> _domes;

    std::thread _thread;
    std::mutex _control;
    mutable std::mutex _mutex;
    std::condition_variable _changed;
    RenderProgress _progress;
    std::atomic<bool> _running{false}, _stop{false}, _pause{false};
    bool _idle = true;
    vec3 _origin{0.0f};         ///< see RasterScene::update()
    std::string _deviceFailure; ///< what was made with the context is gone
    Clock::time_point _started;
    static constexpr double earlySeconds = 0.5; ///< between early images
    bool _compiling = false;                    ///< notifyCompiling() was called in this render
    size_t _readyAtStart = 0;                   ///< programs
    Clock::time_point _compileStarted;
};

} // namespace

bool hasGpu() {
    return EglContext::hasHardware();
}

std::unique_ptr<Renderer> makeRasterRenderer(std::string& error) {
    std::unique_ptr<EglContext> context;
    onOwnThread([&] { context = EglContext::create(error); });
    if (!context) {
        error = "the rasterizer cannot run: " + error;
        return nullptr;
    }
    return std::make_unique<RasterRenderer>(std::move(context));
}

} // namespace patina
