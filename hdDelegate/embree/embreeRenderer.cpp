// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/embreeRenderer.h"

#include "hdDelegate/embree/seenOrigin.h"
#include "hdDelegate/film/pixelFilter.h"
#include "hdDelegate/lights/resolvedLight.h"
#include "hdDelegate/parallel.h"

#include <algorithm>
#include <climits>
#include <utility>

namespace patina {

std::unique_ptr<Renderer> makeRenderer(const std::string& backend) {
    if (backend == "embree") return std::make_unique<EmbreeRenderer>();
    return nullptr;
}

void EmbreeRenderer::publish(const TileSchedule& schedule) {
    const TileSchedule::Outlook outlook = schedule.outlook();
    report([&](RenderProgress& progress) {
        reportSamples(progress, outlook.taken, outlook.needed, schedule.samplesDone());
        progress.noise = outlook.error;
        if (outlook.denoised >= 0.0) progress.statistics["denoisedError"] = outlook.denoised;
        progress.statistics["rays"] = double(_rays + _shadowRays);
        progress.statistics["shadowRays"] = double(_shadowRays);
        progress.statistics["paths"] = double(_paths);
        progress.statistics["droppedSamples"] = double(_film->droppedSamples());
        _compiled->textures().memory().addStatistics(progress.statistics);
        if (_settings.timeMaterials) progress.materialSeconds = materialSeconds();
    });
}

void EmbreeRenderer::addCounts(const TraceCounters& counters) {
    _rays += counters.rays;
    _shadowRays += counters.shadowRays;
    _paths += counters.paths;
}

void EmbreeRenderer::renderTile(const Integrator& integrator, TileSchedule& schedule, int tile,
                                int end) {
    if (interrupted()) return;
    const int target = std::min(schedule.target(tile), end);
    const Tile& t = schedule.tiles()[tile];
    TraceCounters counters;
    if (_settings.timeMaterials) counters.clock.start();
    // The last pixel of the tile is done last: its count tells how far the whole tile is.
    for (int y = t.y0; y < t.y1 && !interrupted(); ++y)
        for (int x = t.x0; x < t.x1; ++x)
            for (int i = int(_film->nextSample(x, y)); i < target; ++i)
                integrator.sample(*_film, x, y, uint32_t(i), counters);
    addCounts(counters);
    schedule.look(tile);
    if (!_settings.timeMaterials) return;
    const std::lock_guard<std::mutex> lock(_spentMutex);
    for (const auto& item : counters.clock.stop())
        _spent[item.first] += item.second;
}

void EmbreeRenderer::showBlocks(const Integrator& integrator, const TileSchedule& schedule,
                                Arena& arena) {
    constexpr double quick = 0.1; // seconds: a pass that hosts need not wait for
    const std::vector<Tile>& tiles = schedule.tiles();
    const bool isWhole = _settings.sampleBegin == 0 && _settings.tileParts == 1;
    if (!_settings.interactive || !_listener || !isWhole || tiles.empty() ||
        schedule.samplesDone() > 0)
        return;
    const glm::ivec4 window(tiles.front().x0, tiles.front().y0, tiles.back().x1, tiles.back().y1);
    int size = 1;
    while (2 * size <= _settings.firstBlockSize)
        size *= 2;
    double seconds = 0.0;
    for (double share = 1.0 / (size * size); size > 1; size /= 2, share *= 4.0) {
        const auto started = Clock::now();
        const auto isOfBlock = [&](int x, int y) {
            return (x - window.x) % size == 0 && (y - window.y) % size == 0;
        };
        arena.execute([&] {
            parallelFor(size_t(0), tiles.size(), [&](size_t i) {
                const Tile& t = tiles[i];
                TraceCounters counters;
                for (int y = t.y0; y < t.y1 && !interrupted(); ++y)
                    for (int x = t.x0; x < t.x1; ++x) {
                        // The last pixel's count is the tile's.
                        const bool isLast = x == t.x1 - 1 && y == t.y1 - 1;
                        if (isOfBlock(x, y) && !isLast && _film->nextSample(x, y) == 0)
                            integrator.sample(*_film, x, y, 0, counters);
                    }
                addCounts(counters);
            });
        });
        if (interrupted()) return;
        seconds += secondsSince(started);
        if (seconds * (1.0 / share - 1.0) < quick) return;
        _film->showBlocks(size, window);
        notify();
    }
}

std::unique_ptr<CausticCasters> EmbreeRenderer::casters(const RenderSettings& settings,
                                                        const Camera& camera,
                                                        const std::vector<AovSpec>& aovs) const {
    if (chosenMethod(settings.methods, "caustics") != "photons") return nullptr;
    auto result = std::make_unique<CausticCasters>(*_embree);
    const char* reason =
        result->empty()                ? nullptr
        : _lights->splitsLobes()       ? "a light treats diffuse and specular light differently"
        : !LightPathAovs(aovs).empty() ? "an AOV asks for light paths"
        : !result->complete()
            ? "curves, points, shared shapes or very many instances are made of glass"
        : settings.enableMotionBlur && camera.shutterOpen < camera.shutterClose
            ? "the shutter is open"
            : "";
    if (!reason) return nullptr;
    if (!*reason) return result;
    _scene->diagnostics().warn(camera.path, "method:caustics", messages::causticsByPaths(reason));
    return nullptr;
}

PhotonMap EmbreeRenderer::photons(const PhotonTracer& tracer, const CausticCasters& casters,
                                  int block) {
    // Where caustics are not all there is, paths have most of the noise and cost less.
    constexpr double perPath = 1.0 / 16.0;
    constexpr int min = 1 << 11, max = 1 << 20; // 1 << 20 take 72 MB
    const double wanted =
        perPath * SampleBlock::samples * _settings.width * double(_settings.height);
    const int count = int(std::clamp(wanted, double(min), double(max)));
    std::vector<Photon> sent(static_cast<size_t>(count));
    constexpr int batch = 1024;
    parallelFor(0, (count + batch - 1) / batch, [&](int b) {
        TraceCounters counters;
        for (int i = b * batch; i < std::min(count, (b + 1) * batch) && !stopped(); ++i)
            sent[size_t(i)] =
                tracer.trace(casters, uint32_t(block), uint32_t(i), uint32_t(count), counters);
        addCounts(counters);
    });
    return PhotonMap(std::move(sent));
}

bool EmbreeRenderer::sharesLight(const RenderSettings& settings, const Camera& camera,
                                 const std::vector<AovSpec>& aovs) const {
    if (chosenMethod(settings.methods, "indirectLight") != "shared" ||
        settings.integrator == "ambientOcclusion")
        return false;
    const char* reason = _lights->linksSurfaces()       ? "a light is linked to some surfaces"
                         : !LightPathAovs(aovs).empty() ? "an AOV asks for light paths"
                         : settings.enableMotionBlur && camera.shutterOpen < camera.shutterClose
                             ? "the shutter is open"
                             : nullptr;
    if (!reason) return true;
    _scene->diagnostics().warn(camera.path, "method:indirectLight",
                               messages::lightNotShared(reason));
    return false;
}

bool EmbreeRenderer::splats(const Camera& camera, const std::vector<AovSpec>& aovs) const {
    if (chosenMethod(_settings.methods, "pixelFilter") != "splatted" ||
        PixelFilter(_settings.filterRadius).isBox())
        return false;
    std::string reason = _settings.deep ? "deep pixels are kept"
                         : _settings.filterRadius > PixelFilter::largestReach
                             ? "the filter's radius is above 8 pixels"
                             : "";
    for (const AovSpec& spec : aovs)
        if (spec.kind != AovKind::First && !isOfFilm(spec.name))
            reason = "AOV " + spec.name + " is of the samples of each pixel alone";
    if (reason.empty()) return true;
    _scene->diagnostics().warn(camera.path, "method:pixelFilter",
                               messages::pixelFilterSampled(reason));
    return false;
}

SharedLight EmbreeRenderer::shared(const Integrator& integrator, int block) {
    constexpr double perSample = 1.0 / 8.0;
    constexpr int min = 1 << 11, max = 1 << 17; // 1 << 17 take some 100 MB
    const double wanted =
        perSample * SampleBlock::samples * _settings.width * double(_settings.height);
    const int count = int(std::clamp(wanted, double(min), double(max)));
    constexpr int batch = 256;
    std::vector<SharedPoints> found(size_t(count) / batch + 1);
    parallelFor(0, int(found.size()), [&](int b) {
        TraceCounters counters;
        for (int i = b * batch; i < std::min(count, (b + 1) * batch) && !stopped(); ++i)
            integrator.findLight(uint32_t(block), uint32_t(i), found[size_t(b)], counters);
        addCounts(counters);
    });
    std::vector<SharedPoint> points;
    for (const SharedPoints& some : found)
        points.insert(points.end(), some.points.begin(), some.points.end());
    return SharedLight(points, SharedLight::firstWidth * SampleBlock::radius(block));
}

void EmbreeRenderer::split(Integrator& integrator, Arena& arena) {
    arena.execute([&] { integrator.split(stopFlag()); });
    report([&](RenderProgress& progress) {
        progress.statistics["lightSamples"] = integrator.splitting().lightSamples;
        progress.statistics["branches"] = integrator.splitting().branches;
    });
}

void EmbreeRenderer::takeBlocks(Integrator& integrator, const CausticCasters* casters,
                                bool sharesLight, const TileSchedule& schedule,
                                const std::vector<int>& tiles, Arena& arena,
                                const std::function<void(int end)>& take) {
    int begin = INT_MAX, end = 0;
    for (int tile : tiles) {
        begin = std::min(begin, schedule.count(tile));
        end = std::max(end, schedule.target(tile));
    }
    const auto prepare = [&](int block) {
        if (std::exchange(_block, block) == block) return;
        integrator.useShared(nullptr);
        arena.execute([&] {
            if (casters) {
                _photonPass.radius = PhotonPass::firstRadius * SampleBlock::radius(block);
                _photonPass.map = photons(integrator.photonTracer(), *casters, block);
                integrator.usePhotons(&_photonPass);
            }
            if (!sharesLight) return;
            _sharedLight = shared(integrator, block);
            integrator.useShared(&_sharedLight);
        });
    };
    if (!integrator.isSplit()) { // by the first block, wherever samples begin
        prepare(0);
        split(integrator, arena);
    }
    for (int block = begin / SampleBlock::samples; block * SampleBlock::samples < end; ++block) {
        prepare(block);
        if (interrupted()) return;
        take((block + 1) * SampleBlock::samples);
    }
}

std::map<std::string, double> EmbreeRenderer::materialSeconds() {
    std::map<std::string, double> seconds;
    const std::lock_guard<std::mutex> lock(_spentMutex);
    if (_spent.empty()) return seconds;
    const auto names = _embree->surfaces().materialNames();
    for (const auto& [program, nanoseconds] : _spent) {
        const auto name = names.find(program);
        seconds[name == names.end() ? "camera" : name->second] += 1e-9 * double(nanoseconds);
    }
    return seconds;
}

std::map<std::string, double> EmbreeRenderer::buildCounts() const {
    std::map<std::string, double> counts = _builtBefore;
    if (!_embree) return counts;
    const BuildCounts& built = _embree->counts();
    counts["surfacesBuilt"] += double(built.surfaces);
    counts["surfacesTessellated"] += double(built.tessellated);
    counts["groupsBuilt"] += double(built.groups);
    counts["programsBuilt"] += double(built.programs);
    counts["primsLookedAt"] += double(built.looked);
    return counts;
}

const std::shared_ptr<const DistortionMap>& EmbreeRenderer::distortionOf(const Camera& camera) {
    if (!_distortion || _distortionFile != camera.lens.distortionMap)
        _distortion = DistortionMap::read(camera, _scene->diagnostics());
    _distortionFile = camera.lens.distortionMap;
    return _distortion;
}

void EmbreeRenderer::updateScene(const SceneState& state, const Camera& camera) {
    if (!_compiled || _compiled->scene() != _scene) {
        _builtBefore = buildCounts();
        _lights.reset();
        _lightsKey = LightsKey();
        _lightsMayDiffer = true;
        _embree.reset();
        _compiled = CompiledScene::of(_scene);
        _embree = std::make_unique<EmbreeScene>(*_compiled);
        _origin = dvec3(0.0);
    }
    // Few scenes are seen so far from the origin that they are built once more; while the camera
    // stays there, the origin does too.
    constexpr int maxMoves = 2;
    for (int i = 0; i <= maxMoves; ++i) {
        _embree->update(state, camera, _settings, stopFlag(), _origin);
        _lightsMayDiffer |= _embree->lightsMayDiffer();
        if (stopped()) return;
        const dvec3 origin = originOfSeen(*_embree, camera, _settings);
        if (origin == _origin || i == maxMoves) break;
        _origin = origin;
    }
    if (!std::exchange(_lightsMayDiffer, false)) return;
    LightsKey key = makeLightsKey(state, *_embree, camera, _settings);
    if (_lights && key == _lightsKey) return;
    _lights = std::make_unique<SceneLights>(state, *_embree, camera, _settings,
                                            _compiled->lightImages(), _scene->diagnostics());
    _lightsKey = std::move(key);
    ++_lightsBuilt;
    _compiled->lightImages().forgetUnused();
}

void EmbreeRenderer::render(const SceneState& state, const Camera& camera) {
    _rays = _shadowRays = _paths = 0;
    _spent.clear();
    constexpr int maxThreads = 4096;
    const int threads = std::min(_settings.threads, maxThreads);
    // Kept from render to render: what TBB allocates for another one does not all come back.
    if (!_arena || threads != _arenaThreads) _arena = std::make_unique<Arena>(threads);
    _arenaThreads = threads;
    Arena& arena = *_arena;
    try {
        arena.execute([&] { updateScene(state, camera); });
    } catch (...) { // for want of memory, say: what is half made is made anew by the next render
        _builtBefore = buildCounts();
        _lights.reset();
        _embree.reset();
        _compiled.reset();
        throw;
    }
    if (stopped()) return;
    ScenePlan plan = _embree->surfaces().plan();
    plan.addPaths(_settings);
    report([&](RenderProgress& progress) {
        progress.statistics = buildCounts();
        progress.statistics["lightsBuilt"] = double(_lightsBuilt);
        progress.statistics["bytes"] = double(_embree->bytes());
        progress.statistics["secondsBuild"] = secondsSinceStart();
        progress.statistics["trianglesStored"] = double(_embree->surfaces().triangles());
        progress.statistics["instances"] = double(_embree->instanceCount());
        plan.addStatistics(_settings.tolerance, progress.statistics);
        progress.plans = plan.materials();
        progress.sceneChoices = plan.choices();
        progress.statistics["maxDepth"] = plan.depth(_settings);
    });

    std::vector<AovSpec> aovs = renderedAovs(_settings.aovs, _settings.cryptomatteLevels);
    if (splats(camera, aovs))
        for (const char* part : {"quarterColors", "quarterShares"})
            aovs.push_back(standardAov(part));
    _film->reset(_settings.width, _settings.height, aovs, !_film->resumeToken.empty());

    if (_settings.deep) _film->keepDeep(_settings.deepSamples);
    _film->allowNegative(takesLightAway(state, _settings));
    _film->setFirstSample(uint32_t(std::max(0, _settings.sampleBegin)));
    const CameraRays rays(camera, _settings, _origin, distortionOf(camera));
    if (tellMotion(_settings.aovs) && !ScreenMotion::knows(camera))
        _scene->diagnostics().warn(camera.path, "", messages::motionAovsEmpty);
    RenderSettings sampled = _settings;
    sampled.tolerance = plan.noise(_settings.tolerance);
    sampled.maxDepth = plan.depth(_settings);
    sampled.renderingColorSpace = state.renderingSpace->name; // hosts may not say it in settings
    sampled.rouletteDepth = plan.rouletteDepth(_settings);
    Integrator integrator(*_embree, *_lights, rays, sampled, aovs);
    const std::unique_ptr<CausticCasters> glass = casters(sampled, camera, aovs);
    const bool isShared = sharesLight(sampled, camera, aovs);
    const bool hasBlocks = glass || isShared;
    _block = -1;
    _photonPass = PhotonPass();
    _sharedLight = SharedLight();
    if (!hasBlocks) split(integrator, arena);
    TileSchedule schedule(*_film, sampled, hasBlocks);
    beginSampling(schedule.outlook().taken);
    report(
        [&](RenderProgress& progress) { progress.noiseWanted = std::max(sampled.tolerance, 0.0); });
    bool haveImage = schedule.samplesDone() > 0; // the time limit never leaves holes
    if (!hasBlocks) showBlocks(integrator, schedule, arena);
    if (!waitWhilePaused()) return;
    while (!stopped()) {
        const std::vector<int> tiles = schedule.pending();
        if (tiles.empty()) break;
        const auto take = [&](int end) {
            arena.execute([&] {
                parallelForEach(tiles.begin(), tiles.end(), [&](int tile) {
                    renderTile(integrator, schedule, tile, end);
                    if ((haveImage && outOfTime()) || wantsCheckpoint()) interrupt();
                });
            });
        };
        if (!hasBlocks)
            take(INT_MAX);
        else
            takeBlocks(integrator, glass.get(), isShared, schedule, tiles, arena, take);
        if (schedule.samplesDone() > 0) _film->showBlocks(1, {});
        publish(schedule);
        maybeCheckpoint();
        haveImage = haveImage || schedule.samplesDone() > 0;
        if (!stopped() && haveImage && !schedule.pending().empty()) notify();
        if (!waitWhilePaused()) return;
        if (haveImage && outOfTime()) break;
    }
    if (stopped()) return;
    schedule.lookDenoised();
    publish(schedule);
}

} // namespace patina
