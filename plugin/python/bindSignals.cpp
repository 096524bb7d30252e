// SPDX-License-Identifier: Apache-2.0
// Python hears a signal between two steps of its own: none while OpenUSD composes. The second one
// ends the process without Python.

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <csignal>
#include <vector>

namespace py = pybind11;

namespace patina {

namespace {

struct sigaction pythons[NSIG]; // by number
volatile std::sig_atomic_t met = 0;

void first(int number) {
    if (met) {
        std::signal(number, SIG_DFL);
        std::raise(number); // comes when this handler has returned
        return;
    }
    met = 1;
    pythons[number].sa_handler(number);
}

void endAtSecondSignal(const std::vector<int>& numbers) {
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
    m.def("end_at_second_signal", &endAtSecondSignal, py::arg("numbers"),
          "Of these signals, by number, the first goes to Python's handler, and the next of any "
          "does what it does by default, even where Python hears none. To be called again after "
          "signal.signal(), which takes the signal back and begins to count anew. Signals that are "
          "ignored, or have no handler, stay so.");
}

} // namespace patina
