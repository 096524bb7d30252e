// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/cpu/materialProgram.h"

#include <chrono>
#include <cstdint>
#include <utility>
#include <vector>

namespace patina {

/// Where one thread's time goes, by material. From a hit on all time is that of the material that
/// was hit: its patterns and lobes, the light samples there with their shadow rays, walks beneath
/// it, and the ray that leaves, until this hits something else. The time before the first hit of
/// a path is the camera's.
class MaterialClock {
public:
    using Clock = std::chrono::steady_clock;
    using Spent = std::vector<std::pair<const MaterialProgram*, uint64_t>>;

    void start() { _last = Clock::now(), _on = true; }
    /// @param program null: the camera
    void enter(const MaterialProgram* program) {
        if (_on) change(program);
    }
    /// @returns nanoseconds by material
    const Spent& stop() {
        enter(nullptr);
        _on = false;
        return _spent;
    }

private:
    void change(const MaterialProgram* program) {
        const Clock::time_point now = Clock::now();
        place() +=
            uint64_t(std::chrono::duration_cast<std::chrono::nanoseconds>(now - _last).count());
        _last = now;
        _current = program;
    }
    uint64_t& place() {
        for (auto& item : _spent) // few materials meet in one tile
            if (item.first == _current) return item.second;
        return _spent.emplace_back(_current, 0).second;
    }

    Spent _spent;
    const MaterialProgram* _current = nullptr;
    Clock::time_point _last;
    bool _on = false;
};

} // namespace patina
