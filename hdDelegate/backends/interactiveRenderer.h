// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/backends/picture.h"
#include "hdDelegate/renderer/renderer.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

namespace patina {

/// Shows a quick renderer's image at once and refines it by a slow one, without a jump between
/// them.
///
/// Both render at the same time. The slow one starts, into the host's film, when the quick one has
/// shown an image (or after a fifth of a second). Until the end the listener gets another film:
/// first the quick renderer's, then refine() of both. Between two calls largestStep() is never
/// above `largestChange`, but for images of the quick one that stay on its device: these are shown
/// as they are, until there is a sample of the slow one. The last call has the host's film, which
/// is the slow renderer's alone.
/// AOVs other than colour are the quick renderer's until the slow one has taken a sample of every
/// pixel.
///
/// If the quick renderer loses its device, the scene's diagnostics say so, and it is not used
/// again. Without a listener only the slow renderer runs.
class InteractiveRenderer : public Renderer {
public:
    static constexpr float largestChange = 0.04f; ///< of what eyes see, see toEye()
    static constexpr int quickSamples = 16;       ///< per pixel, of the quick renderer

    InteractiveRenderer(std::unique_ptr<Renderer> quick, std::unique_ptr<Renderer> slow);
    ~InteractiveRenderer() override { stop(); }

    void start(std::shared_ptr<Scene> scene, const std::string& camera,
               const RenderSettings& settings, std::shared_ptr<Film> film) override;
    void stop() override;
    void pause() override;
    void resume() override;
    bool isRunning() const override { return _running; }
    void wait() override;
    RenderProgress progress() const override;
    void setListener(FilmListener listener) override { _listener = std::move(listener); }
    void letImagesStay(bool stay) override { _imagesMayStay = stay; }

private:
    using Clock = std::chrono::steady_clock;

    /// The state of one of the two.
    struct Source {
        std::unique_ptr<Film> film = std::make_unique<Film>(); ///< a copy, to be overwritten
        RenderProgress progress;                               ///< at that time
        bool news = false;                                     ///< since it was last looked at
        Picture picture;                                       ///< of the film
        Picture noise; ///< of the film, when it is the slow one's

        bool hasImage() const { return !picture.empty(); }
        bool ended() const { return progress.converged || progress.failed; }
    };

    void onProgress(Source& source, const Film& film, const RenderProgress& progress);
    void run(std::string camera);
    void changeOver(const std::string& camera);
    bool awaitNews(const std::string& camera, Clock::time_point started, bool stepping, bool shown);
    void startSlow(const std::string& camera);
    bool fetch(Source& from, Source& to);
    void checkFailure(const RenderProgress& quick);
    void end(const RenderProgress& last);

    std::unique_ptr<Renderer> _quick, _slow;
    FilmListener _listener;
    std::atomic<bool> _quickLost{false};
    bool _imagesMayStay = false;

    std::shared_ptr<Scene> _scene;
    RenderSettings _settings;
    std::shared_ptr<Film> _film, _quickFilm;

    std::thread _thread; ///< calls the listener
    std::mutex _control; ///< start and stop exclude each other
    mutable std::mutex _mutex;
    std::condition_variable _changed;
    Source _fromQuick, _fromSlow; ///< guarded by _mutex
    RenderProgress _last;         ///< of a render that has ended
    bool _quickShown = false;     ///< an image that stays on its device
    bool _copied = false;         ///< something that the thread shows
    bool _quickEnded = false, _slowStarted = false, _pause = false, _stop = false;
    std::atomic<bool> _running{false};
};

} // namespace patina
