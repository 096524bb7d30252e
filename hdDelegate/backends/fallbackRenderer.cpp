// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/backends/fallbackRenderer.h"

namespace patina {

FallbackRenderer::FallbackRenderer(std::unique_ptr<Renderer> first, std::string reason,
                                   std::unique_ptr<Renderer> second)
    : _first(std::move(first)), _second(std::move(second)), _reason(std::move(reason)),
      _onSecond(!_first) {
    if (_first)
        _first->setListener(
            [this](const Film& film, const RenderProgress& p) { onProgress(film, p); });
}

void FallbackRenderer::warn(Scene& scene) {
    const std::shared_ptr<Scene> warned = _warned.lock();
    if (warned.get() == &scene) return;
    scene.diagnostics().warn("", "", messages::pathTracerInstead(_reason));
}

void FallbackRenderer::start(std::shared_ptr<Scene> scene, const std::string& camera,
                             const RenderSettings& settings, std::shared_ptr<Film> film) {
    const std::lock_guard<std::mutex> control(_control);
    {
        const std::lock_guard<std::mutex> lock(_mutex);
        _stopped = true; // of the render that runs
    }
    if (_first) _first->stop();
    _second->stop();
    _second->setListener(_listener);
    _stopped = false;
    _scene = std::move(scene);
    _camera = camera;
    _settings = settings;
    _film = std::move(film);
    if (!_onSecond) return _first->start(_scene, _camera, _settings, _film);
    warn(*_scene); // what failed once is not asked again
    _warned = _scene;
    _second->start(_scene, _camera, _settings, _film);
}

/// On the first one's thread.
void FallbackRenderer::onProgress(const Film& film, const RenderProgress& progress) {
    if (progress.failed && progress.deviceFailed) {
        const std::lock_guard<std::mutex> lock(_mutex);
        if (_stopped) return;
        _reason = progress.error;
        warn(*_scene);
        _warned = _scene;
        // Samples of different back ends are never mixed, nor continued by the other one.
        _film->reset(0, 0, {});
        const size_t name = _film->resumeToken.find(':');
        if (name != std::string::npos)
            _film->resumeToken.replace(0, name, _second->progress().backend);
        _second->start(_scene, _camera, _settings, _film);
        _onSecond = true;
    } else if (_listener) {
        _listener(film, progress);
    }
}

void FallbackRenderer::stop() {
    const std::lock_guard<std::mutex> control(_control);
    {
        const std::lock_guard<std::mutex> lock(_mutex);
        _stopped = true;
    }
    if (_first) _first->stop();
    _second->stop();
}

void FallbackRenderer::pause() {
    if (_first) _first->pause();
    if (_onSecond) _second->pause();
}

void FallbackRenderer::resume() {
    if (_first) _first->resume();
    if (_onSecond) _second->resume();
}

bool FallbackRenderer::isRunning() const {
    // In this order: the second is started before the first ends.
    const bool first = _first && _first->isRunning();
    return _onSecond ? _second->isRunning() : first;
}

void FallbackRenderer::wait() {
    if (_first) _first->wait();
    if (_onSecond) _second->wait();
}

RenderProgress FallbackRenderer::progress() const {
    if (!_onSecond) {
        const RenderProgress first = _first->progress();
        if (!_onSecond) return first;
    }
    return _second->progress();
}

} // namespace patina
