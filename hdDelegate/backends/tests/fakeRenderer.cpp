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

void FakeRenderer::prepareAndRender(const SceneState&, const std::string&) {
    ++starts;
    std::vector<AovSpec> aovs;
    for (const std::string& name : _settings.aovs)
        aovs.push_back(standardAov(name));
    _film->reset(_settings.width, _settings.height, aovs, !_film->resumeToken.empty());
    std::mt19937 random(1);
    const float depth = _plan.backend == "slow" ? 2.0f : 1.0f;
    for (int pass = 1; pass <= _settings.samples && waitWhilePaused(); ++pass) {
        std::this_thread::sleep_for(std::chrono::milliseconds(_plan.millisecondsPerPass));
        if (pass - 1 == _plan.failAfter) {
            if (_plan.deviceFails) blameDevice();
            throw std::runtime_error("the " + _plan.backend + " broke");
        }
        for (int y = 0; y < _settings.height; ++y)
            for (int x = 0; x < _settings.width; ++x) {
                _film->addColor(x, y, _plan.shade(x, y, random), 1.0f);
                for (size_t a = 0; a < aovs.size(); ++a)
                    _film->addAov(int(a), x, y, &depth, 0.0f);
            }
        report([&](RenderProgress& progress) { progress.samplesDone = pass; });
        if (pass == _settings.samples || !_listener) continue; // the end is told by itself
        Film device;
        const FromFilm source(*_film);
        if (_plan.onDevice) device.resetTo(&source, _settings.width, _settings.height, aovs);
        _listener(_plan.onDevice ? device : *_film, progress());
    }
}

} // namespace patina
