// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/backends/interactiveRenderer.h"

#include "hdDelegate/backends/refine.h"
#include "hdDelegate/parallel.h"
#include "hdDelegate/renderer/startedThread.h"

#include <algorithm>
#include <new>

namespace patina {

namespace {

constexpr auto patience = std::chrono::milliseconds(200); ///< of the slow one with the quick one
constexpr int steps = 4, lastSteps = 8; ///< at least, to an image with more samples and to the last
constexpr auto tick = std::chrono::milliseconds(33); ///< between steps of the change-over

} // namespace

InteractiveRenderer::InteractiveRenderer(std::unique_ptr<Renderer> quick,
                                         std::unique_ptr<Renderer> slow)
    : _quick(std::move(quick)), _slow(std::move(slow)), _quickFilm(std::make_shared<Film>()) {
    _quick->setListener(
        [this](const Film& film, const RenderProgress& p) { onProgress(_fromQuick, film, p); });
    _quick->letImagesStay(true);
    _slow->setListener(
        [this](const Film& film, const RenderProgress& p) { onProgress(_fromSlow, film, p); });
}

void InteractiveRenderer::start(std::shared_ptr<Scene> scene, const std::string& camera,
                                const RenderSettings& settings, std::shared_ptr<Film> film) {
    stop();
    const std::lock_guard<std::mutex> control(_control);
    _scene = std::move(scene);
    _settings = settings;
    _settings.firstBlockSize = 1; // the rasterizer's image comes first
    _film = std::move(film);
    _fromQuick = Source();
    _fromSlow = Source();
    _last = RenderProgress();
    _quickShown = _copied = _quickEnded = _slowStarted = _pause = _stop = false;
    _running = true;
    const auto state = _scene->snapshot();
    const auto prim = state->cameras.find(camera);
    const bool drawn = prim == state->cameras.end() || !needsRays(*prim->second);
    // The rasterizer knows no other integrator, and not every camera. Without an audience there is
    // no hurry.
    if (_listener && !_quickLost && drawn && settings.integrator == "path") {
        RenderSettings quick = settings;
        quick.samples = std::min(settings.samples, quickSamples);
        quick.seconds = 0.0;
        quick.checkpointFile.clear();
        _quick->start(_scene, camera, quick, _quickFilm);
    } else {
        _quickEnded = true;
    }
    try {
        _thread = startedThread([this, camera] { run(camera); });
    } catch (const std::runtime_error&) {
        _quick->stop();
        end(RenderProgress());
        throw;
    }
}

void InteractiveRenderer::stop() {
    const std::lock_guard<std::mutex> control(_control);
    {
        const std::lock_guard<std::mutex> lock(_mutex);
        _stop = true;
    }
    _changed.notify_all();
    if (_thread.joinable()) _thread.join(); // first: it may be about to start the slow one
    _quick->stop();
    _slow->stop();
}

void InteractiveRenderer::pause() {
    {
        const std::lock_guard<std::mutex> lock(_mutex);
        _pause = true;
    }
    _quick->pause();
    _slow->pause();
}

void InteractiveRenderer::resume() {
    {
        const std::lock_guard<std::mutex> lock(_mutex);
        _pause = false;
    }
    _changed.notify_all();
    _quick->resume();
    _slow->resume();
}

void InteractiveRenderer::wait() {
    std::unique_lock<std::mutex> lock(_mutex);
    _changed.wait(lock, [&] { return !_running; });
}

RenderProgress InteractiveRenderer::progress() const {
    bool started;
    {
        const std::lock_guard<std::mutex> lock(_mutex);
        if (_last.converged || _last.failed) return _last;
        started = _slowStarted;
    }
    RenderProgress p = started ? _slow->progress() : RenderProgress();
    if (!started || (p.samplesDone == 0 && !_quickLost)) p.backend = _quick->progress().backend;
    p.converged = p.failed = false; // until the listener knows
    return p;
}

/// On the threads of either renderer: copies the film, so that they go on with their work. Of what
/// the quick one has on a device only what is mixed is copied, and its last image.
void InteractiveRenderer::onProgress(Source& source, const Film& film,
                                     const RenderProgress& progress) {
    const bool quick = &source == &_fromQuick;
    if (quick && film.source() && _imagesMayStay && _listener && !progress.failed) {
        bool alone;
        {
            const std::lock_guard<std::mutex> lock(_mutex);
            if (_stop) return;
            alone = !_copied;
            _quickShown |= alone;
        }
        if (alone) {
            RenderProgress shown = progress;
            shown.converged = false;
            _listener(film, shown);
            _changed.notify_all();
            if (!progress.converged) return;
        }
    }
    {
        const std::lock_guard<std::mutex> lock(_mutex);
        if (_stop) return;
        if (!progress.failed && _listener) source.film->copyFrom(film);
        _copied = true;
        source.progress = progress;
        source.news = true;
        if (quick) _quickEnded = source.ended();
    }
    _changed.notify_all();
}

/// With the mutex held.
bool InteractiveRenderer::fetch(Source& from, Source& to) {
    if (!from.news) return false;
    from.news = false;
    to.progress = from.progress;
    if (to.progress.failed || !_listener) return true;
    std::swap(from.film, to.film);
    to.picture = Picture();
    return true;
}

void InteractiveRenderer::checkFailure(const RenderProgress& quick) {
    if (!quick.failed || !quick.deviceFailed || _quickLost) return;
    _quickLost = true;
    _scene->diagnostics().warn("", "", messages::quickImageLost(quick.error));
}

/// With the mutex held: pause() and stop() see it started, or it is not.
void InteractiveRenderer::startSlow(const std::string& camera) {
    if (_slowStarted || _pause || _stop) return;
    _slowStarted = true;
    _slow->start(_scene, camera, _settings, _film);
}

/// Waits until there is something to do. @returns false when it has been stopped
bool InteractiveRenderer::awaitNews(const std::string& camera, Clock::time_point started,
                                    bool stepping, bool shown) {
    std::unique_lock<std::mutex> lock(_mutex);
    const auto news = [&] {
        return _stop || _pause || _fromQuick.news || _fromSlow.news ||
               ((_quickEnded || _quickShown) && !_slowStarted);
    };
    if (shown) {
        startSlow(camera);
        _changed.wait_for(lock, tick, [&] { return _stop; });
    }
    while (!_stop) {
        if (_pause) {
            _changed.wait(lock, [&] { return _stop || !_pause; });
            continue;
        }
        if (shown || _quickShown || _quickEnded || Clock::now() >= started + patience)
            startSlow(camera);
        if (stepping || _fromQuick.news || _fromSlow.news) break;
        if (_slowStarted)
            _changed.wait(lock, news);
        else
            _changed.wait_until(lock, started + patience, news);
    }
    return !_stop;
}

void InteractiveRenderer::run(std::string camera) {
    try {
        changeOver(camera);
    } catch (const std::exception& error) {
        _quick->stop(); // so that the film rests
        _slow->stop();
        const bool memory = dynamic_cast<const std::bad_alloc*>(&error) != nullptr;
        RenderProgress failed = progress();
        failed.failed = true;
        failed.temporary |= memory;
        failed.error = memory ? "out of memory" : error.what();
        try {
            if (_listener) _listener(*_film, failed);
        } catch (const std::exception&) { // nobody is left to tell
        }
        end(failed);
    }
}

void InteractiveRenderer::changeOver(const std::string& camera) {
    const Clock::time_point started = Clock::now();
    Arena arena(_settings.threads);
    Source quick, slow;
    Picture target, shown;
    bool stepping = false;
    int stepsLeft = 1; // at least, to the target
    while (awaitNews(camera, started, stepping, !shown.empty())) {
        bool news, onDevice;
        {
            const std::lock_guard<std::mutex> lock(_mutex);
            news = fetch(_fromQuick, quick);
            news |= fetch(_fromSlow, slow);
            onDevice = _quickShown;
        }
        checkFailure(quick.progress);
        if (slow.progress.failed || (slow.ended() && !_listener)) {
            _quick->stop();
            if (_listener) _listener(*_film, slow.progress);
            return end(slow.progress);
        }
        if (quick.picture.empty()) arena.execute([&] { quick.picture = pictureOf(*quick.film); });
        // What is mixed begins with what was seen, which comes with the quick one's next image.
        if (onDevice && !quick.hasImage() && !quick.ended()) continue;
        if (slow.ended() && news) _quick->stop();
        arena.execute([&] {
            if (slow.picture.empty()) {
                slow.picture = pictureOf(*slow.film);
                slow.noise = noiseOf(*slow.film);
            }
            if (news && slow.hasImage())
                target = slow.ended() || !quick.hasImage()
                             ? slow.picture
                             : refine(quick.picture, slow.picture, slow.noise,
                                      float(slow.progress.fraction));
            else if (news)
                target = quick.picture;
            stepping = false;
            if (target.empty()) return;
            if (news && slow.hasImage()) stepsLeft = slow.ended() ? lastSteps : steps;
            if (shown.empty() && onDevice) shown = quick.picture;
            if (shown.empty())
                shown = target;
            else
                stepping = !approach(shown, target, largestChange, 1.0f / float(stepsLeft));
            stepsLeft = std::max(1, stepsLeft - 1);
            if (slow.ended() && !stepping) return;
            writePicture(shown, slow.hasImage() ? *slow.film : *quick.film);
        });
        if (target.empty()) continue;
        if (slow.ended() && !stepping) {
            slow.progress.mayWait = true;
            _listener(*_film, slow.progress);
            return end(slow.progress);
        }
        RenderProgress shown = slow.hasImage() ? slow.progress : quick.progress;
        shown.converged = shown.failed = false;
        shown.mayWait = true;
        _listener(slow.hasImage() ? *slow.film : *quick.film, shown);
    }
    end(RenderProgress());
}

void InteractiveRenderer::end(const RenderProgress& last) {
    {
        const std::lock_guard<std::mutex> lock(_mutex);
        _last = last;
        _running = false;
    }
    _changed.notify_all();
}

} // namespace patina
