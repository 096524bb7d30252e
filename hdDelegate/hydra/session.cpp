#include "hdDelegate/hydra/session.h"

namespace patina {

HdPatinaSession::HdPatinaSession(std::shared_ptr<Scene> scene)
    : _scene(std::move(scene)), _film(std::make_shared<Film>()), _renderer(makeRenderer("embree")) {
}

HdPatinaSession::~HdPatinaSession() {
    _renderer->stop();
}

void HdPatinaSession::start(const std::string& camera, const RenderSettings& settings,
                            const std::vector<std::string>& aovs) {
    _renderer->stop();
    uint64_t serial;
    {
        std::lock_guard<std::mutex> lock(_mutex);
        serial = ++_serial;
        _frame.reset();
        _camera = camera;
        _settings = settings;
        _aovs = aovs;
        _stopped = false;
    }
    _renderer->setListener([this, serial](const Film& film, const RenderProgress& progress) {
        present(film, progress, serial);
    });
    _renderer->start(_scene, camera, settings, _film);
    if (_paused) _renderer->pause();
}

void HdPatinaSession::present(const Film& film, const RenderProgress& progress, uint64_t serial) {
    auto frame = std::make_shared<HdPatinaFrame>();
    frame->last = progress.converged || progress.failed;
    frame->error = progress.error;
    if (!progress.failed) {
        frame->width = film.width();
        frame->height = film.height();
        for (const std::string& name : _aovs)
            frame->aovs[name] = film.resolve(name);
    }
    {
        std::lock_guard<std::mutex> lock(_mutex);
        if (serial != _serial) return;
        _frame = std::move(frame);
    }
    _arrived.notify_all();
}

std::shared_ptr<const HdPatinaFrame> HdPatinaSession::take() {
    std::lock_guard<std::mutex> lock(_mutex);
    return std::move(_frame);
}

std::shared_ptr<const HdPatinaFrame> HdPatinaSession::finish() {
    std::unique_lock<std::mutex> lock(_mutex);
    _arrived.wait(lock, [&] { return _frame && _frame->last; });
    return std::move(_frame);
}

void HdPatinaSession::stop() {
    _renderer->stop();
    _stopped = true;
}

void HdPatinaSession::restart() {
    if (_serial == 0) return; // nothing was started yet
    const std::vector<std::string> aovs = _aovs;
    const RenderSettings settings = _settings;
    const std::string camera = _camera;
    start(camera, settings, aovs);
}

void HdPatinaSession::pause() {
    _paused = true;
    _renderer->pause();
}

void HdPatinaSession::resume() {
    _paused = false;
    _renderer->resume();
}

} // namespace patina
