// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/renderer/renderLoop.h"

#include "hdDelegate/film/temporaryFailure.h"
#include "hdDelegate/renderer/startedThread.h"
#include "hdDelegate/scene/instancerCheck.h"

#include <algorithm>
#include <new>
#include <stdexcept>

namespace patina {

RenderLoop::RenderLoop(std::string backend) {
    _progress.backend = std::move(backend);
}

RenderLoop::~RenderLoop() {
    {
        const std::lock_guard<std::mutex> lock(_mutex);
        _quit = true;
    }
    _changed.notify_all();
    if (_thread.joinable()) _thread.join();
}

void RenderLoop::start(std::shared_ptr<Scene> scene, const std::string& camera,
                       const RenderSettings& settings, std::shared_ptr<Film> film) {
    stop();
    const std::lock_guard<std::mutex> control(_control);
    if (!_thread.joinable()) _thread = startedThread([this] { work(); });
    _scene = std::move(scene);
    _film = std::move(film);
    _film->beginRender();
    _settings = settings;
    _stop = _interrupt = _pause = false;
    _deviceFailed = _notified = false;
    Job job{_scene->snapshot(), camera};
    _running = true;
    _started = _sampling = _lastCheckpoint = Clock::now();
    {
        const std::lock_guard<std::mutex> lock(_mutex);
        RenderProgress fresh;
        fresh.backend = _progress.backend;
        _progress = fresh;
        _idle = false;
        _working = true;
        _job = std::move(job);
    }
    _changed.notify_all();
}

void RenderLoop::stop() {
    const std::lock_guard<std::mutex> control(_control);
    {
        // Locked, or waitWhilePaused() could overwrite _interrupt, and a whole pass would go on.
        const std::lock_guard<std::mutex> lock(_mutex);
        _stop = _interrupt = true;
        _pause = false;
    }
    _changed.notify_all();
    std::unique_lock<std::mutex> lock(_mutex);
    _changed.wait(lock, [&] { return !_working; });
}

void RenderLoop::pause() {
    std::unique_lock<std::mutex> lock(_mutex);
    _pause = _interrupt = true;
    _changed.wait(lock, [&] { return _idle || !_running; });
}

void RenderLoop::resume() {
    {
        const std::lock_guard<std::mutex> lock(_mutex);
        _pause = false;
    }
    _changed.notify_all();
}

void RenderLoop::wait() {
    std::unique_lock<std::mutex> lock(_mutex);
    _changed.wait(lock, [&] { return !_running; });
}

RenderProgress RenderLoop::progress() const {
    const std::lock_guard<std::mutex> lock(_mutex);
    return _progress;
}

void RenderLoop::work() {
    std::unique_lock<std::mutex> lock(_mutex);
    for (;;) {
        _changed.wait(lock, [&] { return _quit || _job; });
        if (!_job) return;
        std::optional<Job> job;
        job.swap(_job);
        lock.unlock();
        run(*job);
        job.reset(); // nobody else may hold the state
        lock.lock();
        _working = false;
        _changed.notify_all();
    }
}

void RenderLoop::run(const Job& job) {
    std::string failure;
    bool temporary = false;
    try {
        for (const Message& problem : leaveOutLightPaths(_settings.aovs))
            _scene->diagnostics().warn("", "aovs", problem);
        prepareAndRender(*job.state, job.camera);
        if (_film->leftOutCoverage())
            _scene->diagnostics().warn("", "aovs", messages::cryptomatteFull);
    } catch (const std::bad_alloc&) {
        failure = "out of memory";
        temporary = true;
    } catch (const std::exception& error) {
        failure = error.what();
        temporary = dynamic_cast<const TemporaryFailure*>(&error) != nullptr;
    }
    finish(std::move(failure), temporary);
}

void RenderLoop::prepareAndRender(const SceneState& state, const std::string& path) {
    if (_settings.width < 1 || _settings.height < 1)
        throw std::runtime_error("the image has no pixels");
    const auto camera = state.cameras.find(path);
    if (camera == state.cameras.end()) throw std::runtime_error("there is no camera " + path);
    for (const dmat4& transform : camera->second->transform.values)
        if (const std::string problem = inverseProblem(transform); !problem.empty())
            throw std::runtime_error("the transform of camera " + path + " " + problem);
    render(state, *camera->second);
}

void RenderLoop::notify() {
    constexpr double pause = 0.03; // seconds: hosts do not draw more often
    if (!_listener || (_notified && secondsSince(_lastNotified) < pause)) return;
    _notified = true;
    _listener(*_film, progress());
    _lastNotified = Clock::now();
}

/// Tells the listener once more. What it throws now has nobody left to tell.
void RenderLoop::tellFailure(const RenderProgress& failed) {
    try {
        _listener(*_film, failed);
    } catch (const std::exception&) {
    }
}

/// The listener is notified of the end before progress() tells it.
void RenderLoop::finish(std::string failure, bool temporary) {
    RenderProgress last;
    try {
        last = progress();
    } catch (const std::bad_alloc&) {
        failure = "out of memory";
        temporary = true;
    }
    if (!failure.empty()) {
        last.failed = true;
        last.deviceFailed = _deviceFailed;
        last.temporary = temporary || _deviceFailed;
        last.error = std::move(failure);
    } else if (!_stop) {
        last.converged = true;
        last.fraction = 1.0;
        last.secondsLeft = 0.0;
    }
    if (_listener && (last.converged || last.failed)) {
        try {
            _listener(*_film, last);
        } catch (const std::exception& error) { // a host that copies the image, as a rule
            const bool memory = dynamic_cast<const std::bad_alloc*>(&error) != nullptr;
            last.converged = false;
            last.failed = true;
            last.temporary |= memory;
            last.error = memory ? "out of memory" : error.what();
            tellFailure(last);
        }
    }
    _film->endRender();
    {
        const std::lock_guard<std::mutex> lock(_mutex);
        _progress = std::move(last);
        _running = false;
        _idle = true;
    }
    _changed.notify_all();
}

bool RenderLoop::waitWhilePaused() {
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

bool RenderLoop::wantsCheckpoint() const {
    return !_settings.checkpointFile.empty() &&
           secondsSince(_lastCheckpoint) > _settings.checkpointSeconds;
}

void RenderLoop::maybeCheckpoint() {
    if (!wantsCheckpoint()) return;
    try {
        _film->saveCheckpoint(_settings.checkpointFile);
    } catch (const std::exception& e) { // a full disk: the render is worth more
        _scene->diagnostics().warn("", "", messages::checkpointNotWritten(e.what()));
    }
    _lastCheckpoint = Clock::now();
}

void RenderLoop::reportSamples(RenderProgress& progress, double taken, double needed,
                               int samplesDone) {
    progress.samplesMean = taken;
    progress.samplesDone = samplesDone;
    const double now = progress.secondsRendering = secondsSince(_sampling);
    _marks.push_back({now, taken});
    // Half of what this start has taken is enough to measure by.
    const double half = 0.5 * (_marks.front().samples + taken);
    const auto mark = std::find_if(_marks.rbegin(), _marks.rend(),
                                   [&](const Mark& m) { return m.samples <= half; });
    const double perSample = mark != _marks.rend() && taken > mark->samples
                                 ? (now - mark->seconds) / (taken - mark->samples)
                                 : 0.0;
    progress.fraction = taken > 0.0 ? taken / (taken + needed) : 0.0;
    progress.secondsLeft = perSample * needed;
    if (!(_settings.seconds > 0.0)) return;
    const double limit = std::max(0.0, _settings.seconds - secondsSince(_started));
    if (limit >= progress.secondsLeft) return;
    progress.secondsLeft = limit;
    progress.fraction = std::max(progress.fraction, 1.0 - limit / _settings.seconds);
}

} // namespace patina
