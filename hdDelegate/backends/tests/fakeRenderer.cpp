// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/backends/tests/fakeRenderer.h"

#include "hdDelegate/film/filmSource.h"

namespace patina {

namespace {

/// A film that stands for a device.
struct FromFilm : FilmSource {
    explicit FromFilm(const Film& film) : film(film) {}
    bool has(AovId aov) const override { return aov == AovId::color || aov == AovId::alpha; }
    bool read(AovId aov, const PixelForm& form, void* bytes) const override {
        const bool color = aov == AovId::color;
        const std::vector<float> values = film.resolve(color ? "color" : "alpha");
        const int own = color ? 3 : 1;
        auto* to = static_cast<float*>(bytes);
        for (size_t i = 0; i < values.size() / size_t(own); ++i)
            for (int k = 0; k < form.components; ++k)
                *to++ = k < own ? values[i * size_t(own) + size_t(k)] : 1.0f;
        return true;
    }
    const Film& film;
};

} // namespace

void FakeRenderer::start(std::shared_ptr<Scene>, const std::string&, const RenderSettings& settings,
                         std::shared_ptr<Film> film) {
    stop();
    ++starts;
    _settings = settings;
    _film = std::move(film);
    _stop = _pause = false;
    {
        const std::lock_guard<std::mutex> lock(_mutex);
        _progress = RenderProgress();
        _progress.backend = _plan.backend;
    }
    _running = true;
    _thread = std::thread(&FakeRenderer::run, this);
}

void FakeRenderer::run() {
    std::vector<AovSpec> aovs;
    for (const std::string& name : _settings.aovs)
        aovs.push_back(standardAov(name));
    _film->reset(_settings.width, _settings.height, aovs, !_film->resumeToken.empty());
    std::mt19937 random(1);
    for (int pass = 1; !_stop; ++pass) {
        std::this_thread::sleep_for(std::chrono::milliseconds(_plan.millisecondsPerPass));
        RenderProgress p = progress();
        if (pass - 1 == _plan.failAfter) {
            p.failed = true;
            p.deviceFailed = _plan.deviceFails;
            p.error = "the " + _plan.backend + " broke";
        } else {
            for (int y = 0; y < _settings.height; ++y)
                for (int x = 0; x < _settings.width; ++x) {
                    _film->addColor(x, y, _plan.shade(x, y, random), 1.0f);
                    const float depth = _plan.backend == "slow" ? 2.0f : 1.0f;
                    for (size_t a = 0; a < aovs.size(); ++a)
                        _film->addAov(int(a), x, y, &depth, 0.0f);
                }
            p.samplesDone = pass;
            p.converged = pass >= _settings.samples;
        }
        Film device;
        const FromFilm source(*_film);
        if (_plan.onDevice) device.resetTo(&source, _settings.width, _settings.height, aovs);
        if (_listener) _listener(_plan.onDevice ? device : *_film, p);
        std::unique_lock<std::mutex> lock(_mutex);
        _progress = p;
        _changed.wait(lock, [&] { return !_pause || _stop; });
        if (p.converged || p.failed) break;
    }
    {
        const std::lock_guard<std::mutex> lock(_mutex);
        _running = false;
    }
    _changed.notify_all();
}

void FakeRenderer::stop() {
    {
        const std::lock_guard<std::mutex> lock(_mutex);
        _stop = true;
    }
    _changed.notify_all();
    if (_thread.joinable()) _thread.join();
}

void FakeRenderer::pause() {
    const std::lock_guard<std::mutex> lock(_mutex);
    _pause = true;
}

void FakeRenderer::resume() {
    {
        const std::lock_guard<std::mutex> lock(_mutex);
        _pause = false;
    }
    _changed.notify_all();
}

void FakeRenderer::wait() {
    std::unique_lock<std::mutex> lock(_mutex);
    _changed.wait(lock, [&] { return !_running; });
}

RenderProgress FakeRenderer::progress() const {
    const std::lock_guard<std::mutex> lock(_mutex);
    return _progress;
}

} // namespace patina
