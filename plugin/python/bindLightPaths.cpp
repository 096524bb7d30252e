// SPDX-License-Identifier: Apache-2.0
// Light path expressions, and the AOVs that they make.

#include "hdDelegate/film/film.h"
#include "hdDelegate/film/lightPaths/lightPathAutomaton.h"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cstring>

namespace py = pybind11;

namespace patina {

namespace {

/// One event as tests write it: type, scattering (x where it has none), label.
using EventText = std::tuple<char, char, std::string>;

LightEvent eventFrom(const EventText& text, const LightLabels& labels) {
    const auto& [type, scatter, label] = text;
    constexpr char types[] = "CRTVLBO", scatters[] = "xDGSs";
    const char* t = type ? std::strchr(types, type) : nullptr;
    const char* s = scatter ? std::strchr(scatters, scatter) : nullptr;
    if (!t || !s) throw py::value_error("an event is a type of CRTVLBO and one of xDGSs");
    return {EventType(t - types), EventScatter(s - scatters), labels.of(label)};
}

std::vector<bool> accepts(const std::string& expression,
                          const std::vector<std::vector<EventText>>& paths) {
    const LightPathSet set({expression});
    const LightPathAutomaton& automaton = set.automata()[0];
    std::vector<bool> accepted;
    for (const auto& path : paths) {
        int state = automaton.start();
        for (const EventText& event : path)
            state = automaton.next(state, set.symbol(eventFrom(event, set.labels())));
        accepted.push_back(automaton.accepts(state));
    }
    return accepted;
}

} // namespace

void bindLightPaths(py::module_& m) {
    m.def("light_path_accepts", &accepts, py::arg("expression"), py::arg("paths"),
          "Which paths fit a light path expression. A path is a list of events (type, scattering, "
          "label), such as [('C', 'x', ''), ('R', 'D', ''), ('L', 'x', 'key')]. ValueError says "
          "what is wrong with the expression, and where.");
    m.def(
        "light_path_states",
        [](const std::string& expression) {
            return LightPathSet({expression}).automata()[0].size();
        },
        py::arg("expression"), "States of the smallest automaton of a light path expression.");
    m.def(
        "channels_of_aov",
        [](const std::string& aov) { return channelsOfAov(standardAov(aov).name); }, py::arg("aov"),
        "The prefix of an AOV's channels in files; ValueError says why there is no such AOV.");
}

} // namespace patina
