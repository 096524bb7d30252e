// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/film/lightPaths/lightPathExpression.h"

namespace patina {

/// The smallest deterministic automaton of a light path expression: of nondeterministic ones by
/// Thompson (1968, Regular Expression Search Algorithm) the one whose states are their sets (Rabin
/// and Scott 1959, Finite Automata and Their Decision Problems), with equal states merged (Moore
/// 1956, Gedanken-Experiments on Sequential Machines). Immutable, so threads share it.
class LightPathAutomaton {
public:
    /// @throws std::invalid_argument where the expression is none, needs too many states, or fits
    /// no path from the camera to something that gives light
    LightPathAutomaton(const std::string& expression, const LightLabels& labels);

    int size() const { return int(_accepts.size()); }
    int start() const { return 0; }
    int next(int state, int symbol) const {
        return _next[size_t(state) * size_t(_symbols) + size_t(symbol)];
    }
    bool accepts(int state) const { return _accepts[size_t(state)]; }

    /// Number of an event, for next(). @param labels the constructor's
    static int symbol(const LightEvent& event, const LightLabels& labels) {
        const int kind = int(event.type) * eventScatters + int(event.scatter);
        return kind * (labels.count() + 1) + event.label + 1;
    }

private:
    class Nondeterministic;
    void determinise(const Nondeterministic& from, const LightLabels& labels,
                     const std::string& expression);
    void merge();
    bool fitsSomePath(const LightLabels& labels) const;

    int _symbols = 0;
    std::vector<int> _next; ///< by state, then by symbol
    std::vector<bool> _accepts;
};

/// The expressions of a render with one set of labels.
class LightPathSet {
public:
    explicit LightPathSet(const std::vector<std::string>& expressions);

    const LightLabels& labels() const { return _labels; }
    const std::vector<LightPathAutomaton>& automata() const { return _automata; }
    int symbol(const LightEvent& event) const { return LightPathAutomaton::symbol(event, _labels); }

private:
    LightLabels _labels;
    std::vector<LightPathAutomaton> _automata;
};

} // namespace patina
