// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/renderer/renderer.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

namespace patina {

/// The loop of every back end around its samples: a thread that renders one state of the scene, and
/// is stopped, paused and asked for its progress by others; a listener; checkpoints; a time limit.
///
/// A back end overrides render(), and calls stop() first in its destructor.
///
/// One thread renders all states, one after another: libraries keep a record of every thread that
/// has called them, and a viewport's session starts a render with each edit.
class RenderLoop : public Renderer {
public:
    ~RenderLoop() override;
    void start(std::shared_ptr<Scene> scene, const std::string& camera,
               const RenderSettings& settings, std::shared_ptr<Film> film) final;
    void stop() final;
    void pause() final;
    void resume() final;
    bool isRunning() const final { return _running; }
    void wait() final;
    RenderProgress progress() const final;
    void setListener(FilmListener listener) final { _listener = std::move(listener); }
    void letImagesStay(bool stay) final { _imagesMayStay = stay; }

protected:
    using Clock = std::chrono::steady_clock;
    static double secondsSince(Clock::time_point start) {
        return std::chrono::duration<double>(Clock::now() - start).count();
    }

    /// @param backend as RenderProgress::backend names it
    explicit RenderLoop(std::string backend);

    /// Renders until all is done, the time is out or stopped() is true. On the render thread.
    /// @throws std::exception with what failed, in one line
    virtual void render(const SceneState& state, const Camera& camera) = 0;
    /// Around render(), on the same thread: for what a back end needs before it can begin.
    /// @throws as render() does, and where the camera or the image's size allow no render
    virtual void prepareAndRender(const SceneState& state, const std::string& camera);
    /// Called by an override before it throws: RenderProgress::deviceFailed.
    void blameDevice() { _deviceFailed = true; }

    bool stopped() const { return _stop; }
    /// Becomes true as soon as the render is stopped, and when anything is to happen between two
    /// passes: cuts a pass short.
    bool interrupted() const { return _interrupt; }
    void interrupt() { _interrupt = true; }
    const std::atomic<bool>& stopFlag() const { return _stop; } ///< for builds that poll it

    /// Between passes. @returns false when the render is stopped
    bool waitWhilePaused();
    bool wantsCheckpoint() const;
    void maybeCheckpoint();
    bool outOfTime() const { ///< RenderSettings::seconds are over
        return _settings.seconds > 0.0 && secondsSince(_started) > _settings.seconds;
    }
    /// Building is over: checkpoints count their time from here on.
    /// @param taken samples of a pixel that a checkpoint held, mean over the image
    void beginSampling(double taken) {
        _sampling = _lastCheckpoint = Clock::now();
        _marks = {{0.0, taken}};
    }
    /// Changes what progress() tells, under the lock.
    template <class Change> void report(const Change& change) {
        const std::lock_guard<std::mutex> lock(_mutex);
        change(_progress);
    }
    /// Between passes: the samples of a pixel, means over the image. Fraction and times follow from
    /// them. The time left is that of samples as dear as the latest ones: those of noisy tiles are.
    void reportSamples(RenderProgress& progress, double taken, double needed, int samplesDone);
    /// Notifies the listener of the film, unless it did just now.
    void notify();
    double secondsSinceStart() const { return secondsSince(_started); }

    std::shared_ptr<Scene> _scene;
    std::shared_ptr<Film> _film;
    RenderSettings _settings;
    FilmListener _listener;
    bool _imagesMayStay = false; ///< see letImagesStay()

private:
    struct Job {
        std::shared_ptr<const SceneState> state;
        std::string camera;
    };

    void work(); ///< all that the thread does
    void run(const Job& job);
    void finish(std::string failure, bool temporary);
    void tellFailure(const RenderProgress& failed);

    std::thread _thread; ///< from the first start on
    std::mutex _control; ///< start, stop and wait exclude each other
    mutable std::mutex _mutex;
    std::condition_variable _changed;
    RenderProgress _progress; ///< guarded by _mutex
    std::atomic<bool> _running{false}, _stop{false}, _interrupt{false}, _pause{false};
    std::optional<Job> _job;              ///< that the thread has not begun; guarded by _mutex
    bool _working = false, _quit = false; ///< the thread has a job; shall end; guarded by _mutex
    bool _idle = true;                    ///< no thread touches the film; guarded by _mutex
    bool _deviceFailed = false;
    bool _notified = false; ///< the listener knows of this render
    Clock::time_point _started, _sampling, _lastCheckpoint, _lastNotified;
    struct Mark {
        double seconds, samples;
    };
    std::vector<Mark> _marks; ///< since sampling began, as reportSamples() was told
};

} // namespace patina
