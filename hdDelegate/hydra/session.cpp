// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/hydra/session.h"

#include "hdDelegate/backends/backends.h"
#include "hdDelegate/film/denoiser.h"
#include "hdDelegate/film/relativeError.h"
#include "materialNetwork/plan/methods.h"

#include <algorithm>
#include <chrono>
#include <stdexcept>

namespace patina {

namespace {

/// AOVs for the denoiser, as `patina record` asks for them: halves of the samples tell of
/// its error, unless they share photons or light.
std::vector<const char*> denoisingAovs(const RenderSettings& settings, const std::string& backend) {
    std::vector<const char*> aovs = {denoisingAlbedoAov, denoisingNormalAov};
    const bool shares = chosenMethod(settings.methods, "caustics") == "photons" ||
                        chosenMethod(settings.methods, "indirectLight") == "shared";
    if (settings.tolerance > 0.0 && backend == "embree" && !shares)
        aovs.insert(aovs.end(),
                    {denoisingHalfColorAov, denoisingHalfAlbedoAov, denoisingHalfNormalAov});
    return aovs;
}

/// Whether a finished image is nearer to its limit than the denoiser would bring it.
bool areMeansNearer(const Film& film, const RenderProgress& progress) {
    const auto told = progress.statistics.find("denoisedError");
    return told != progress.statistics.end() &&
           relativeError(film, 0, 0, film.width(), film.height()) < told->second;
}

} // namespace

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

Metadata HdPatinaSession::mattes() const {
    std::lock_guard<std::mutex> lock(_mutex);
    return _mattes;
}

RenderProgress HdPatinaSession::progress() const {
    const auto current = renderer();
    return current ? current->progress() : RenderProgress();
}

/// Frees a listener that waits, so that hosts do not wait for it.
void HdPatinaSession::stop() {
    const auto current = renderer();
    if (!current) return;
    {
        std::lock_guard<std::mutex> lock(_mutex);
        _stopping = true;
    }
    _taken.notify_all();
    current->stop();
    std::lock_guard<std::mutex> lock(_mutex);
    _stopping = false;
}

void HdPatinaSession::leaveDevice() {
    stop();
    std::shared_ptr<Renderer> last;
    std::shared_ptr<HdPatinaFrame> frame;
    std::vector<HdPatinaPixels> spare;
    std::lock_guard<std::mutex> lock(_mutex);
    if (!_device) return;
    std::swap(_renderer, last);
    _frame.swap(frame);
    _spare.swap(spare);
    _device.reset();
    _backend.clear();
}

void HdPatinaSession::start(const std::string& camera, const HdPatinaSettings& settings,
                            const std::vector<HdPatinaImageForm>& forms,
                            const std::shared_ptr<HostDevice>& device) {
    stop();
    const std::string backend = backendOf(settings);
    std::shared_ptr<Renderer> next =
        backend == _backend && device == _device ? renderer() : makeBackend(backend, device);
    uint64_t serial;
    {
        std::lock_guard<std::mutex> lock(_mutex);
        serial = ++_serial;
        _frame.reset();
        _shown = _shownOnDevice = 0;
        _camera = camera;
        _settings = settings;
        _forms = forms;
        std::swap(_renderer, next);
        _backend = backend;
        _device = device;
    }
    next.reset(); // frees the memory of the back end before
    const auto current = renderer();
    current->setListener([this, serial](const Film& film, const RenderProgress& progress) {
        present(film, progress, serial);
    });
    current->letImagesStay(settings.interactive);
    RenderSettings asked = settings;
    if (settings.denoise)
        for (const char* aov : denoisingAovs(settings, backend))
            if (std::find(asked.aovs.begin(), asked.aovs.end(), aov) == asked.aovs.end())
                asked.aovs.push_back(aov);
    try {
        current->start(_scene, camera, asked, _film);
    } catch (const std::exception& error) { // no thread is to be had
        RenderProgress failed;
        failed.failed = true;
        failed.error = error.what();
        return present(*_film, failed, serial);
    }
    if (_paused) current->pause();
}

/// @returns false, and says so once, where there is no denoiser
bool HdPatinaSession::denoiseCopy(const Film& film, Film& clean) {
    if (film.width() < 1 || film.height() < 1) return false;
    try {
        clean.copyFrom(film);
        denoise(clean, _settings.threads, _settings.denoiseAovs);
        return true;
    } catch (const std::runtime_error& error) {
        _scene->diagnostics().warn("", "denoise", messages::notDenoised(error.what()));
        return false;
    }
}

void HdPatinaSession::present(const Film& film, const RenderProgress& progress, uint64_t serial) {
    auto frame = std::make_shared<HdPatinaFrame>();
    frame->last = progress.converged || progress.failed;
    frame->error = progress.error;
    if (!progress.failed) {
        const int count = progress.samplesDone;
        if (_settings.denoise && !frame->last && (count & (count - 1)) != 0)
            return; // a noisy image between clean ones would flicker
        Film clean;
        // Blocks of a first pass stay as they are: no filter mends them.
        const bool denoised = _settings.denoise && count > 0 &&
                              !(frame->last && areMeansNearer(film, progress)) &&
                              denoiseCopy(film, clean);
        {
            const std::lock_guard<std::mutex> lock(_mutex);
            frame->images.swap(_spare);
        }
        frame->images.resize(_forms.size());
        for (size_t i = 0; i < _forms.size(); ++i)
            _forms[i].read(denoised ? clean : film, frame->images[i]);
        if (frame->last) frame->mattes = cryptomatteMetadata(film);
    }
    std::unique_lock<std::mutex> lock(_mutex);
    // Images that follow each other in small steps are a jump again where a host misses some.
    if (progress.mayWait)
        _taken.wait_for(lock, std::chrono::milliseconds(500), [&] { return !_frame || _stopping; });
    if (serial != _serial) return;
    _frame = std::move(frame);
}

void HdPatinaSession::giveBack(HdPatinaPixels&& image) {
    const std::lock_guard<std::mutex> lock(_mutex);
    _spare.push_back(std::move(image));
}

std::shared_ptr<HdPatinaFrame> HdPatinaSession::take() {
    std::shared_ptr<HdPatinaFrame> frame;
    {
        std::lock_guard<std::mutex> lock(_mutex);
        frame.swap(_frame);
        if (frame) _mattes = frame->mattes;
    }
    _taken.notify_all();
    return frame;
}

void HdPatinaSession::restart() {
    if (_serial == 0) return; // nothing was started yet
    const std::vector<HdPatinaImageForm> forms = _forms;
    const HdPatinaSettings settings = _settings;
    const std::string camera = _camera;
    start(camera, settings, forms, std::shared_ptr<HostDevice>(_device));
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
