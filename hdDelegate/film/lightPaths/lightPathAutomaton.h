// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/film/lightPaths/lightPathExpression.h"

#include <cstdint>

namespace patina {

class EventColumns;

/// The smallest deterministic automaton of a light path expression: of nondeterministic ones by
/// Thompson (1968, Regular Expression Search Algorithm) the one whose states are their sets (Rabin
/// and Scott 1959, Finite Automata and Their Decision Problems), with equal states merged (see
/// StateClasses). Immutable, so threads share it.
class LightPathAutomaton {
public:
    /// @throws std::invalid_argument where the expression is none, needs too many states, or fits
    /// no path from the camera to something that gives light
    LightPathAutomaton(const std::string& expression, const LightLabels& labels);

    int size() const { return int(_accepts.size()); }
    int start() const { return 0; }
    /// @param symbol symbolOf() an event, with the constructor's labels
    int next(int state, int symbol) const {
        return _next[size_t(state) * _columns + _columnOf[size_t(symbol)]];
    }
    bool accepts(int state) const { return _accepts[size_t(state)]; }

private:
    class Nondeterministic;
    void determinise(const Nondeterministic& from, const EventColumns& columns,
                     const std::string& expression);
    void merge();
    bool fitsSomePath(const EventColumns& columns) const;

    size_t _columns = 0;
    std::vector<uint16_t> _columnOf; ///< by symbol
    std::vector<int> _next;          ///< by state, then by column
    std::vector<bool> _accepts;
};

/// What the expressions of a render take together is bounded. A path has a weight for each state of
/// each of them, and each event is looked up by its label.
class LightPathRoom {
public:
    /// @throws std::invalid_argument where there is no room for an expression beside those before,
    /// which then do not count it; or where it is wrong
    void add(const std::string& expression);

private:
    friend class LightPathSet;
    /// @throws std::invalid_argument
    void addLabels(const std::string& expression);
    void addStates(const std::string& expression, const LightPathAutomaton& automaton);

    std::vector<std::string> _labels;
    size_t _expressions = 0, _states = 0;
};

/// The expressions of a render with one set of labels.
class LightPathSet {
public:
    /// @throws std::invalid_argument as LightPathRoom
    explicit LightPathSet(const std::vector<std::string>& expressions);

    const LightLabels& labels() const { return _labels; }
    const std::vector<LightPathAutomaton>& automata() const { return _automata; }
    int symbol(const LightEvent& event) const { return symbolOf(event, _labels); }

private:
    LightLabels _labels;
    std::vector<LightPathAutomaton> _automata;
};

} // namespace patina
