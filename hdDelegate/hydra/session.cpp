#include "hdDelegate/hydra/session.h"

#include "hdDelegate/backends/backends.h"

namespace patina {

HdPatinaSession::HdPatinaSession(std::shared_ptr<Scene> scene)
    : _scene(std::move(scene)), _film(std::make_shared<Film>()) {}

HdPatinaSession::~HdPatinaSession() {
    stop();
}

std::shared_ptr<Renderer> HdPatinaSession::renderer() const {
    std::lock_guard<std::mutex> lock(_mutex);
    return _renderer;
}

bool HdPatinaSession::isRunning() const {
    const auto current = renderer();
    return current && current->isRunning();
}

RenderProgress HdPatinaSession::progress() const {
    const auto current = renderer();
    return current ? current->progress() : RenderProgress();
}

void HdPatinaSession::start(const std::string& camera, const HdPatinaSettings& settings,
                            const std::vector<std::string>& aovs) {
    if (const auto current = renderer()) current->stop();
    const std::string backend = backendOf(settings);
    std::shared_ptr<Renderer> next = backend == _backend ? renderer() : makeBackend(backend);
    uint64_t serial;
    {
        std::lock_guard<std::mutex> lock(_mutex);
        serial = ++_serial;
        _frame.reset();
        _camera = camera;
        _settings = settings;
        _aovs = aovs;
        _stopped = false;
        std::swap(_renderer, next);
        _backend = backend;
    }
    next.reset(); // frees the memory of the back end before
    const auto current = renderer();
    current->setListener([this, serial](const Film& film, const RenderProgress& progress) {
        present(film, progress, serial);
    });
    current->start(_scene, camera, settings, _film);
    if (_paused) current->pause();
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
    if (const auto current = renderer()) current->stop();
    _stopped = true;
}

void HdPatinaSession::restart() {
    if (_serial == 0) return; // nothing was started yet
    const std::vector<std::string> aovs = _aovs;
    const HdPatinaSettings settings = _settings;
    const std::string camera = _camera;
    start(camera, settings, aovs);
}

void HdPatinaSession::pause() {
    _paused = true;
    if (const auto current = renderer()) current->pause();
}

void HdPatinaSession::resume() {
    _paused = false;
    if (const auto current = renderer()) current->resume();
}

} // namespace patina
