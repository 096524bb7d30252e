// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/rasterRenderer.h"

#include "hdDelegate/film/sampler.h"
#include "hdDelegate/raster/gl/deviceError.h"
#include "hdDelegate/film/relativeError.h"
#include "hdDelegate/raster/gl/glContext.h"
#include "hdDelegate/raster/gl/glFaults.h"
#include "hdDelegate/raster/gl/programCompiler.h"
#include "hdDelegate/raster/passes/rasterPasses.h"
#include "hdDelegate/renderer/renderLoop.h"

#include <algorithm>
#include <cstdlib>
#include <stdexcept>
#include <system_error>
#include <thread>

namespace patina {

namespace {

/// Runs a function on a thread of its own: where a host's thread has a context of GLX current, EGL
/// can make none current, and OpenGL's functions would reach the host's.
template <class Function> void onOwnThread(const Function& function) {
    std::thread(function).join();
}

class RasterRenderer : public RenderLoop {
public:
    RasterRenderer(std::unique_ptr<GlContext> context, std::shared_ptr<HostContext> host)
        : RenderLoop("raster"), _host(std::move(host)), _context(std::move(context)) {}

    ~RasterRenderer() override {
        stop();
        try {
            onOwnThread([this] {
                {
                    const GlContext::Use use(*_context);
                    release();
                    _compiler.reset();
                }
                _context.reset();
            });
        } catch (const std::system_error&) {
            // Without a thread to make the context current on, the driver keeps what it holds.
            (void)_lights.release(), (void)_passes.release(), (void)_raster.release();
            (void)_domes.release(), (void)_compiler.release(), (void)_context.release();
        }
    }

private:
    void release() {
        if (_film && _film->source() && _passes && _film->source() == _passes->image())
            _film->reset(0, 0, {});
        _lights.reset();
        _passes.reset();
        _raster.reset();
        _domes.reset();
        _compiled.reset();
    }

    void prepareAndRender(const SceneState& state, const std::string& camera) override {
        const auto samples = _settings.methods.find("environmentSamples");
        if (samples != _settings.methods.end() && _settings.environmentSamples <= 0)
            _settings.environmentSamples = std::atoi(samples->second.c_str());
        _compiling = false;
        try {
            const GlContext::Use use(*_context);
            if (!use.ok()) throw DeviceError("the OpenGL context cannot be used");
            if (!_deviceFailure.empty()) throw DeviceError(_deviceFailure);
            struct Release { // also where the render fails, which may be for want of memory
                std::unique_ptr<RasterScene>& raster;
                ~Release() {
                    if (raster) raster->releaseShapes();
                }
            };
            try {
                const Release release{_raster};
                try {
                    RenderLoop::prepareAndRender(state, camera);
                } catch (const DeviceError&) {
                    throwIfLost();
                    throw;
                }
            } catch (const DeviceError& error) {
                _deviceFailure = error.what();
                release(); // another back end needs the memory
                _compiler.reset();
                throw;
            } catch (...) { // what is half made is made anew by the next render
                release();
                throw;
            }
        } catch (const DeviceError& error) {
            blameDevice();
            throw std::runtime_error("the rasterizer has failed: " + std::string(error.what()));
        }
    }

    /// @param standIns shows them where programs are not ready, instead of waiting
    void build(const SceneState& state, const RasterCamera& camera, bool standIns) {
        if (!_compiled || _compiled->scene() != _scene) {
            release();
            _passes = std::make_unique<RasterPasses>();
            _passes->setFirstDraws(
                [this] { report([](RenderProgress& p) { ++p.statistics["materialsDrawn"]; }); });
            _compiled = CompiledScene::of(_scene);
            if (!_compiler) _compiler = std::make_unique<ProgramCompiler>(*_context, helpers());
            _raster = std::make_unique<RasterScene>(*_compiled, _compiler.get());
            _domes = std::make_unique<RasterDomes>();
        }
        std::function<void(const RasterMaterials::Ready&)> compiling;
        if (!standIns)
            compiling = [this](const RasterMaterials::Ready& ready) { notifyCompiling(ready); };
        RasterInstances places(_compiled->compiled(state, _settings).placements,
                               camera.timeCode(0.5f), _origin);
        const auto plan = RasterLightPlan::of(state, _settings, places, _compiled->lightImages());
        _raster->update(state, _origin, camera, _settings, plan, stopFlag(), compiling);
        _lightsMayDiffer |= _raster->lightsMayDiffer();
        if (standIns) notifyCompiling(_raster->materials().ready());
        if (stopped()) return;
        // Every sample of a dome costs a shadow map: few of them where that takes long.
        const int domeSamples = _raster->trianglesDrawn() > 1000000 ? 1 : 4;
        if (_lights && !_lightsMayDiffer && domeSamples == _domeSamples) return;
        _lightsMayDiffer = false;
        _domeSamples = domeSamples;
        _lights = std::make_unique<RasterLights>(
            state, _settings, places, camera.timeCode(0.5f), domeSamples,
            _raster->materials().domeMethods(), _compiled->lightImages(), *_domes,
            *_raster->parts().links, _scene->diagnostics(), plan.needsChoice());
        _compiled->lightImages().forgetUnused();
    }

    /// Threads that compile beside this one.
    int helpers() const {
        const int threads =
            _settings.threads > 0 ? _settings.threads : int(std::thread::hardware_concurrency());
        return std::clamp(threads - 1, 0, 7);
    }

    void notifyCompiling(const RasterMaterials::Ready& ready) {
        if (!_compiling) {
            _compiling = true;
            _readyAtStart = ready.ready;
            _compileStarted = Clock::now();
        }
        report([&](RenderProgress& progress) {
            progress.statistics["materialsWanted"] = double(ready.wanted);
            progress.statistics["materialsReady"] = double(ready.ready);
            // Those that were ready before tell nothing of how long the others take.
            if (progress.samplesDone == 0 && ready.ready > _readyAtStart)
                progress.secondsLeft = secondsSince(_compileStarted) *
                                       double(ready.wanted - ready.ready) /
                                       double(ready.ready - _readyAtStart);
        });
    }

    /// With places as seen from the origin.
    RasterCamera cameraFrom(Camera camera) const {
        for (dmat4& transform : camera.transform.values)
            transform[3] -= glm::dvec4(_origin, 0.0f);
        return RasterCamera(camera, _settings);
    }

    void render(const SceneState& state, const Camera& authored) {
        const Camera cameraPrim = rasterizedCamera(authored, _scene->diagnostics());
        RasterCamera camera = cameraFrom(cameraPrim);
        if (cameraPrim.clippingPlanes.size() > size_t(RasterPassBlock::maxPlanes))
            _scene->diagnostics().warn(cameraPrim.path, "clippingPlanes",
                                       messages::clippingPlanesTooMany(RasterPassBlock::maxPlanes));
        checkDevice(0);
        // Somebody looks on: images of what there is until all is there.
        const bool early = _settings.interactive && _listener && _film->resumeToken.empty();
        build(state, camera, early);
        if (stopped()) return;
        const PixelFilter filter(_settings.filterRadius);
        int border = filter.reach();
        if (!_passes->resize(_settings, border))
            throw DeviceError("the driver has no room for an image of " +
                              std::to_string(_settings.width) + " x " +
                              std::to_string(_settings.height) + " pixels");
        checkDevice(0);
        const std::vector<AovSpec> aovs = renderedAovs(_settings.aovs, _settings.cryptomatteLevels);
        for (const AovSpec& aov : aovs)
            if (!aov.paths.empty() || aov.id == AovId::shadow)
                _scene->diagnostics().warn("", "",
                                           messages::lightPathAovEmpty(channelsOfAov(aov.name)));
        if (_settings.deep) _scene->diagnostics().warn("", "", messages::deepLeftOut);
        if (tellMotion(_settings.aovs))
            for (const auto& item : state.geometry)
                if (deforms(*item.second) && isDrawnInRaster(*item.second, _settings))
                    _scene->diagnostics().warn(item.first, "points",
                                               messages::motionOfPointsLeftOut);
        _passes->timer().clear();
        _passes->drawAovs(*_raster, camera, _settings.interactive);
        if (const vec3 origin = _passes->seen().originOf(*_raster); origin != _origin) {
            _origin = origin;
            camera = cameraFrom(cameraPrim);
            build(state, camera, early);
            if (stopped()) return;
            _passes->drawAovs(*_raster, camera, _settings.interactive);
        }
        bool cached = true; // so programs may be there before an image of stand-ins would be
        while (early && _raster->materials().standIns() > 0) {
            if (!cached) showEarly(camera, aovs, sampleOf(0, filter, border));
            if (!waitForPrograms(cached ? cacheSeconds : 1e9) || !waitWhilePaused()) return;
            cached = false;
            build(state, camera, true);
            if (stopped()) return;
            _passes->timer().clear();
            _passes->drawAovs(*_raster, camera, _settings.interactive);
        }
        const bool stays = imageStays(aovs);
        if (stays)
            _film->resetTo(&_passes->beginImage(*_context, _host, camera), _settings.width,
                           _settings.height, aovs);
        else
            _film->reset(_settings.width, _settings.height, aovs, !_film->resumeToken.empty());
        reportBuild();
        _passes->seen().write(*_raster, camera, _passes->window(), *_film);
        const int* window = _passes->window();
        const bool empty = stays || window[2] < window[0] || window[3] < window[1];
        const uint32_t taken = empty ? 0 : _film->sampleCount(window[2], window[3]);
        beginSampling(double(taken));
        _noise = -1.0;
        const double goal = _raster->plan().noise(_settings.tolerance);
        report([&](RenderProgress& progress) { progress.noiseWanted = std::max(goal, 0.0); });
        const uint32_t again = RasterPasses::passesToRepeat(taken);
        if (again > 0) {
            Film film;
            film.reset(_settings.width, _settings.height, {}, false);
            for (uint32_t i = 0; i < again && !stopped(); ++i)
                drawPass(camera, sampleOf(i, filter, border), film);
        }
        _passes->resumeAt(*_raster, *_lights, again, taken, [&](uint32_t pass) {
            _raster->moveTo(camera.timeCode(sampleOf(pass, filter, 0).time));
        });
        const uint32_t samples = uint32_t(std::max(1, _settings.samples));
        const RasterMattes mattes(*_raster, camera.timeCode(0.5f), aovs);
        for (uint32_t i = taken; i < samples && !stopped(); ++i) {
            if (isGoodEnough(int(i))) break;
            const RasterSample sample = sampleOf(i, filter, border);
            drawPass(camera, sample, *_film);
            if (mattes.wanted())
                _passes->seen().count(*_raster, mattes, camera, sample, _settings.seed, window,
                                      *_film);
            checkDevice(int(i) + 1);
            report([&](RenderProgress& progress) {
                reportSamples(progress, i + 1.0, passesNeeded(int(i) + 1, int(samples)),
                              int(i) + 1);
                progress.noise = _noise;
                reportSeconds(progress.statistics);
            });
            if (i + 1 < samples) notify();
            maybeCheckpoint();
            if (!waitWhilePaused() || outOfTime()) return;
        }
    }

    /// Whether the image is only looked at, and nothing has to be known of its samples.
    bool imageStays(const std::vector<AovSpec>& aovs) const {
        return _imagesMayStay && _settings.interactive && _listener && _settings.tolerance <= 0.0 &&
               _settings.checkpointFile.empty() && _film->resumeToken.empty() &&
               std::none_of(aovs.begin(), aovs.end(),
                            [](const AovSpec& aov) { return aov.kind == AovKind::Coverage; }) &&
               std::none_of(_settings.aovs.begin(), _settings.aovs.end(),
                            [](const std::string& aov) {
                                return aov == "sampleCount" || aov == "variance";
                            });
    }

    void reportBuild() {
        report([&](RenderProgress& progress) {
            progress.statistics["secondsBuild"] = secondsSinceStart();
            progress.statistics["trianglesStored"] = double(_raster->triangles());
            progress.statistics["bytes"] = double(_raster->bytes());
            progress.statistics["surfacesBuilt"] = double(_raster->shapesBuilt());
            progress.statistics["primsLookedAt"] = double(_raster->primsLookedAt());
            progress.statistics["instancesWritten"] = double(_raster->instancesWritten());
            progress.statistics["instances"] = double(_raster->instanceCount());
            progress.statistics["programsBuilt"] = double(_raster->materials().programsBuilt());
            const ScenePlan plan = _raster->plan();
            plan.addStatistics(_settings.tolerance, progress.statistics);
            progress.plans = plan.materials();
            if (_settings.tolerance >= 0.0) progress.sceneChoices = plan.choices();
        });
    }

    /// Until an image with more of them is worth its time.
    /// @param maximum seconds
    /// @returns false when the render is stopped
    bool waitForPrograms(double maximum) {
        const auto began = Clock::now();
        const size_t before = _raster->materials().ready().ready;
        while (!stopped()) {
            const RasterMaterials::Ready now = _raster->materials().ready();
            notifyCompiling(now);
            const double seconds = secondsSince(began);
            if (now.ready == now.wanted || seconds > maximum ||
                (now.ready > before && seconds > earlySeconds))
                break;
            _raster->materials().waitForMore(std::chrono::milliseconds(50));
        }
        return !stopped();
    }

    void drawPass(const RasterCamera& camera, const RasterSample& sample, Film& film) {
        _raster->moveTo(camera.timeCode(sample.time));
        _passes->draw(*_raster, *_lights, *_domes, camera, sample, film);
    }

    /// One pass with what is ready, in a film of its own: nothing of it reaches the final image.
    void showEarly(const RasterCamera& camera, const std::vector<AovSpec>& aovs,
                   const RasterSample& sample) {
        Film film;
        film.reset(_settings.width, _settings.height, aovs, false);
        _passes->seen().write(*_raster, camera, _passes->window(), film);
        drawPass(camera, sample, film);
        checkDevice(0);
        RenderProgress shown = progress();
        shown.samplesDone = 1;
        if (!stopped()) _listener(film, shown);
    }

    /// @param border of the image, as RasterPasses::resize() has left it
    RasterSample sampleOf(uint32_t pass, const PixelFilter& filter, int border) const {
        Sampler numbers(0, 0, _settings.seed, pass);
        RasterSample sample;
        sample.pass = pass;
        sample.taken = pass + 1;
        sample.beside = filter.sample(numbers.next2());
        // The first image stands where the last one will, and is as soft: a pixel is the mean of
        // its corners.
        sample.offset = pass > 0 ? sample.beside : vec2(border > 0 ? 0.5f : 0.0f);
        sample.lens = numbers.next2();
        sample.time = numbers.next2().x;
        if (border > 0) {
            sample.splatX = filter.splatWeights(sample.offset.x);
            sample.splatY = filter.splatWeights(sample.offset.y);
        }
        return sample;
    }

    /// Whether the image of so many passes meets the tolerance.
    bool isGoodEnough(int passes) {
        if (!(_settings.tolerance > 0.0) || passes < std::max(2, _settings.minSamples) ||
            !isErrorStep(passes))
            return false;
        const int* w = _passes->window();
        _noise = relativeError(*_film, w[0], w[1], w[2] + 1, w[3] + 1, PixelNoise::Shared);
        _noiseAt = passes;
        return _noise <= _raster->plan().noise(_settings.tolerance);
    }

    /// Noise falls with the root of the number of passes.
    double passesNeeded(int passes, int most) const {
        double end = most;
        if (_noise >= 0.0) {
            const double over = _noise / _raster->plan().noise(_settings.tolerance);
            end = std::clamp(_noiseAt * over * over, double(passes), end);
        }
        return std::max(0.0, end - passes);
    }

    void reportSeconds(std::map<std::string, double>& to) const {
        to["secondsAovs"] = _passes->timer().seconds(GlTimer::Aovs);
        to["secondsShadows"] = _passes->timer().seconds(GlTimer::Shadows);
        to["secondsSurfaces"] = _passes->timer().seconds(GlTimer::Surfaces);
        to["secondsRead"] = _passes->timer().seconds(GlTimer::ReadBack);
    }

    /// @param passes that were drawn
    void checkDevice(int passes) const {
        const auto asked = [&](const char* fault) {
            const std::string after = glFault(fault);
            return !after.empty() && passes >= std::atoi(after.c_str());
        };
        bool full = asked("memory");
        // Without a context there may be an error for ever.
        bool lost = _context->lost() || asked("lost");
        for (GLenum error; !full && !lost && (error = gl.GetError()) != GL_NO_ERROR;) {
            full = error == GL_OUT_OF_MEMORY;
            lost = error == GL_CONTEXT_LOST;
        }
        if (full) throw DeviceError("the driver is out of memory");
        if (lost) throw DeviceError("the driver has reset the OpenGL context");
    }

    std::shared_ptr<HostContext> _host; ///< that the context shares its objects with, or null
    std::unique_ptr<GlContext> _context;
    std::unique_ptr<ProgramCompiler> _compiler; ///< goes before its context
    // Kept between renders, so that an edit rebuilds less than everything.
    std::shared_ptr<CompiledScene> _compiled;
    std::unique_ptr<RasterPasses> _passes;
    std::unique_ptr<RasterScene> _raster;
    std::unique_ptr<RasterLights> _lights;
    std::unique_ptr<RasterDomes> _domes;

    bool _lightsMayDiffer = true;               ///< from what _lights are made of
    int _domeSamples = 0;                       ///< that they were made with
    vec3 _origin{0.0f};                         ///< see RasterScene::update()
    std::string _deviceFailure;                 ///< what was made with the context is gone
    static constexpr double earlySeconds = 0.5; ///< between early images
    static constexpr double cacheSeconds = 0.3; ///< for programs that the driver's cache holds
    double _noise = -1.0;     ///< relative error when it was looked at last; below 0: never
    int _noiseAt = 0;         ///< passes that there were then
    bool _compiling = false;  ///< notifyCompiling() was called in this render
    size_t _readyAtStart = 0; ///< programs
    Clock::time_point _compileStarted;
};

} // namespace

bool hasGpu() {
    return eglHasHardware();
}

std::unique_ptr<Renderer> makeRasterRenderer(std::string& error,
                                             std::shared_ptr<HostContext> host) {
    std::unique_ptr<GlContext> context;
    if (host) context = host->share(error);
    if (!context) host.reset();
    try {
        if (!context) onOwnThread([&] { context = GlContext::create(error); });
    } catch (const std::system_error& failure) {
        error = failure.what();
    }
    if (!context) {
        error = "the rasterizer cannot run: " + error;
        return nullptr;
    }
    return std::make_unique<RasterRenderer>(std::move(context), std::move(host));
}

} // namespace patina
