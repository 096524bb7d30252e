// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/raster/gl/glContext.h"

#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace patina {

/// Compiles on threads with contexts of their own, which share programs with one context. The
/// thread of that context helps while it waits: where no other can be made, it does all.
class ProgramCompiler {
public:
    /// @param threads besides the caller's, at most
    ProgramCompiler(const GlContext& shared, int threads);
    ~ProgramCompiler(); ///< lets go of what has not begun, and waits for the rest

    /// Has a function run once, with a context current, about in the order of the calls. It throws
    /// nothing.
    void add(std::function<void()> work);
    /// Runs one function on this thread. @returns false when none waits
    bool help();
    /// Whether somebody but help() runs functions.
    bool hasThreads() {
        const std::lock_guard<std::mutex> lock(_mutex);
        return _living > 0;
    }
    /// Waits until some function has ended, or so long.
    void wait(std::chrono::milliseconds maximum);

private:
    void run(GlContext* context);
    void finished();

    const GlContext& _shared;
    int _maximum;
    std::mutex _mutex;
    std::condition_variable _changed, _ended;
    std::deque<std::function<void()>> _work;
    std::vector<std::thread> _threads;
    std::vector<std::unique_ptr<GlContext>> _contexts;
    int _idle = 0;
    int _living = 0;   ///< threads that have a context, or may have one
    size_t _count = 0; ///< that have ended
    bool _stop = false;
};

} // namespace patina
