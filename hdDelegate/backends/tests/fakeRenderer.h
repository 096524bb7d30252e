// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/renderer/renderer.h"

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <random>
#include <thread>

namespace patina {

/// Renders what a function says, pixel by pixel, and does as told: a renderer without a scene.
class FakeRenderer : public Renderer {
public:
    using Shade = std::function<glm::vec3(int x, int y, std::mt19937& random)>;

    struct Plan {
        std::string backend;
        Shade shade;
        int failAfter = -1; ///< passes; -1: never
        bool deviceFails = true;
        int millisecondsPerPass = 0;
        bool onDevice = false; ///< the listener's film has a source
    };

    explicit FakeRenderer(Plan plan) : _plan(std::move(plan)) { _progress.backend = _plan.backend; }
    ~FakeRenderer() override { stop(); }

    void start(std::shared_ptr<Scene> scene, const std::string& camera,
               const RenderSettings& settings, std::shared_ptr<Film> film) override;
    void stop() override;
    void pause() override;
    void resume() override;
    bool isRunning() const override { return _running; }
    void wait() override;
    RenderProgress progress() const override;
    void setListener(FilmListener listener) override { _listener = std::move(listener); }

    std::atomic<int> starts{0};

private:
    void run();

    Plan _plan;
    RenderSettings _settings;
    std::shared_ptr<Film> _film;
    FilmListener _listener;
    std::thread _thread;
    mutable std::mutex _mutex;
    std::condition_variable _changed;
    RenderProgress _progress;
    std::atomic<bool> _running{false}, _stop{false}, _pause{false};
};

} // namespace patina
