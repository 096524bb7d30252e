// SPDX-License-Identifier: Apache-2.0
// Python hears a signal between two steps of its own: none while OpenUSD composes. The second one
// ends the process without Python.

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <atomic>
#include <csignal>
#include <cstdint>
#include <ctime>
#include <vector>

namespace py = pybind11;

namespace patina {

namespace {

struct sigaction pythons[NSIG];            // by number
std::atomic<int> met{0};                   // number of the first
std::atomic<int64_t> metAt{0}, oneSpan{0}; // nanoseconds
static_assert(std::atomic<int64_t>::is_always_lock_free, "a handler must not wait");

int64_t now() {
    timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return int64_t(time.tv_sec) * 1000000000 + time.tv_nsec;
}

void first(int number) {
    if (!met) {
        metAt = now();
        met = number;
        pythons[number].sa_handler(number);
    } else if (met != number || now() - metAt > oneSpan) {
        std::signal(number, SIG_DFL);
        std::raise(number); // comes when this handler has returned
    }
}

void endAtSecondSignal(const std::vector<int>& numbers, double seconds) {
    oneSpan = int64_t(seconds * 1e9);
    for (const int number : numbers) {
        struct sigaction found;
        if (number < 1 || number >= NSIG || sigaction(number, nullptr, &found) != 0) continue;
        if (found.sa_handler == SIG_DFL || found.sa_handler == SIG_IGN ||
            found.sa_handler == &first || (found.sa_flags & SA_SIGINFO) != 0)
            continue;
        pythons[number] = found;
        found.sa_handler = &first;
        met = 0;
        sigaction(number, &found, nullptr);
    }
}

} // namespace

void bindSignals(py::module_& m) {
    m.def(
        "end_at_second_signal", &endAtSecondSignal, py::arg("numbers"), py::arg("seconds"),
        "Of these signals, by number, the first goes to Python's handler, and the next of any "
        "does what it does by default, even where Python hears none. The first number counts once "
        "within so many seconds. To be called again after signal.signal(), which takes the signal "
        "back and begins to count anew. Signals that are ignored, or have no handler, stay so.");
}

} // namespace patina
