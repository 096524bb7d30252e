// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>

namespace patina {

/// Measures what happens between its calls.
class Clock {
public:
    double lap() {
        const auto now = std::chrono::steady_clock::now();
        const double seconds = std::chrono::duration<double>(now - _last).count();
        _last = now;
        return seconds;
    }

private:
    std::chrono::steady_clock::time_point _last = std::chrono::steady_clock::now();
};

} // namespace patina
