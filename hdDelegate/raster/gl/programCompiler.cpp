// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/gl/programCompiler.h"

#include "hdDelegate/raster/gl/glFunctions.h"

#include <algorithm>
#include <string>

namespace patina {

ProgramCompiler::ProgramCompiler(const GlContext& shared, int threads)
    : _shared(shared), _maximum(std::max(threads, 0)) {}

ProgramCompiler::~ProgramCompiler() {
    {
        const std::lock_guard<std::mutex> lock(_mutex);
        _stop = true;
        _work.clear();
    }
    _changed.notify_all();
    for (std::thread& thread : _threads)
        thread.join();
}

void ProgramCompiler::add(std::function<void()> work) {
    const std::lock_guard<std::mutex> lock(_mutex);
    _work.push_back(std::move(work));
    if (_idle < int(_work.size()) && int(_threads.size()) < _maximum) {
        std::string error;
        if (auto context = GlContext::sharing(_shared, error)) {
            _contexts.push_back(std::move(context));
            ++_idle; // what the thread subtracts when it begins
            ++_living;
            try {
                _threads.emplace_back(&ProgramCompiler::run, this, _contexts.back().get());
            } catch (const std::exception&) { // no thread can be had: help() does it
                --_idle;
                --_living;
                _maximum = int(_threads.size());
            }
        } else {
            _maximum = 0;
        }
    }
    _changed.notify_one();
}

bool ProgramCompiler::help() {
    std::function<void()> work;
    {
        const std::lock_guard<std::mutex> lock(_mutex);
        if (_work.empty()) return false;
        work = std::move(_work.front());
        _work.pop_front();
    }
    work();
    finished();
    return true;
}

void ProgramCompiler::wait(std::chrono::milliseconds maximum) {
    std::unique_lock<std::mutex> lock(_mutex);
    const size_t before = _count;
    _ended.wait_for(lock, maximum, [&] { return _count != before; });
}

void ProgramCompiler::finished() {
    {
        const std::lock_guard<std::mutex> lock(_mutex);
        ++_count;
    }
    _ended.notify_all();
}

void ProgramCompiler::run(GlContext* context) {
    const GlContext::Use use(*context);
    std::unique_lock<std::mutex> lock(_mutex);
    while (use.ok()) {
        _changed.wait(lock, [&] { return _stop || !_work.empty(); });
        if (_stop) return;
        --_idle;
        std::function<void()> work = std::move(_work.front());
        _work.pop_front();
        lock.unlock();
        work();
        work = nullptr; // what it holds goes while the context is there
        // Others see what is new for sure. Of programs that others have deleted, Mesa keeps a part
        // in the context that made them until that is flushed.
        gl.Flush();
        finished();
        lock.lock();
        ++_idle;
    }
    // Its context does not become current: help() does what it was to do.
    --_idle;
    --_living;
    _maximum = 0;
    lock.unlock();
    finished();
}

} // namespace patina
