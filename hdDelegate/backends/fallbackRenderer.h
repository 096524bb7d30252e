// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/renderer/renderer.h"

#include <atomic>
#include <mutex>

namespace patina {

/// A renderer that may lose its device, and one that takes over then and keeps the work: a failure
/// with RenderProgress::deviceFailed starts the same render again with the second one. Listeners
/// are not notified of it; the scene's diagnostics do, once a scene.
class FallbackRenderer : public Renderer {
public:
    /// @param first may be null: `reason` says why, and the second renders from the start
    FallbackRenderer(std::unique_ptr<Renderer> first, std::string reason,
                     std::unique_ptr<Renderer> second);
    ~FallbackRenderer() override { stop(); }

    void start(std::shared_ptr<Scene> scene, const std::string& camera,
               const RenderSettings& settings, std::shared_ptr<Film> film) override;
    void stop() override;
    void pause() override;
    void resume() override;
    bool isRunning() const override;
    void wait() override;
    RenderProgress progress() const override;
    void setListener(FilmListener listener) override { _listener = std::move(listener); }
    void letImagesStay(bool stay) override {
        if (_first) _first->letImagesStay(stay);
    }

private:
    void onProgress(const Film& film, const RenderProgress& progress);
    void warn(Scene& scene);

    std::unique_ptr<Renderer> _first, _second;
    std::string _reason; ///< why the second renders; empty: the first does
    std::weak_ptr<Scene> _warned;
    FilmListener _listener;

    std::mutex _control; ///< start and stop exclude each other
    std::mutex _mutex;   ///< of the change from one to the other
    std::atomic<bool> _onSecond{false};
    bool _stopped = false;
    std::shared_ptr<Scene> _scene;
    std::string _camera;
    RenderSettings _settings;
    std::shared_ptr<Film> _film;
};

} // namespace patina
