// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/film/lightPaths/lightPathAutomaton.h"

#include "hdDelegate/film/lightPaths/eventColumns.h"
#include "hdDelegate/film/lightPaths/stateClasses.h"

#include <map>
#include <stdexcept>
#include <utility>

namespace patina {

namespace {

constexpr size_t maxNodes = 20000;             // of the nondeterministic automaton
constexpr size_t maxStates = 2000;             // before equal ones are merged
constexpr size_t maxEntries = size_t(1) << 20; // of its table: states by columns
constexpr size_t maxSteps = 100'000'000;       // some seconds at most

// Of all expressions of a render. Light groups with ten expressions each have four states or so in
// each of them.
constexpr size_t maxExpressions = 256;
constexpr size_t maxLabels = 1024;
constexpr size_t maxStatesOfAll = 32768;

[[noreturn]] void tooLarge(const std::string& expression) {
    throw std::invalid_argument("light path expression '" + expression +
                                "': it needs too many states; fewer or smaller {n,m} need less");
}

} // namespace

/// Thompson's construction: one node per event, and nodes that lead on without one.
class LightPathAutomaton::Nondeterministic {
public:
    struct State {
        int pattern = -1; ///< leads to `next` by it; -1: `free` without any
        int next = -1;
        std::vector<int> free;
    };

    Nondeterministic(const LightPathNode& all, const std::string& expression)
        : _expression(expression) {
        const int begin = add();
        _end = build(all, begin);
        _known.resize(_states.size());
    }

    const State& state(int i) const { return _states[size_t(i)]; }
    const std::vector<const EventPattern*>& patterns() const { return _patterns; }
    int end() const { return _end; }

    /// Adds all that is reached without an event, and leaves those that neither have one nor end.
    /// @param set sorted on return
    /// @returns how many nodes it met
    size_t close(std::vector<int>& set) const {
        std::vector<int> left = std::exchange(set, {}), met;
        while (!left.empty()) {
            const int i = left.back();
            left.pop_back();
            if (_known[size_t(i)]) continue;
            _known[size_t(i)] = true;
            met.push_back(i);
            if (state(i).pattern >= 0 || i == _end) set.push_back(i);
            left.insert(left.end(), state(i).free.begin(), state(i).free.end());
        }
        for (const int i : met)
            _known[size_t(i)] = false;
        std::sort(set.begin(), set.end());
        return met.size();
    }

private:
    int add() {
        if (_states.size() >= maxNodes) tooLarge(_expression);
        _states.emplace_back();
        return int(_states.size()) - 1;
    }
    void link(int from, int to) { _states[size_t(from)].free.push_back(to); }

    /// @returns the node that is reached from `from` by what the part of the expression fits
    int build(const LightPathNode& node, int from) {
        switch (node.kind) {
        case LightPathNode::Kind::Event: {
            const int step = add(), to = add();
            link(from, step);
            _states[size_t(step)].pattern = numberOf(node.event);
            _states[size_t(step)].next = to;
            return to;
        }
        case LightPathNode::Kind::Sequence: {
            int at = from;
            for (const auto& part : node.parts)
                at = build(*part, at);
            return at;
        }
        case LightPathNode::Kind::Either: {
            const int to = add();
            for (const auto& part : node.parts) {
                const int begin = add();
                link(from, begin);
                link(build(*part, begin), to);
            }
            return to;
        }
        case LightPathNode::Kind::Repeat: return buildRepeat(node, from);
        }
        return from;
    }

    int buildRepeat(const LightPathNode& node, int from) {
        int at = from;
        for (int i = 0; i < node.least; ++i)
            at = build(*node.parts[0], at);
        const int to = add();
        if (node.most == LightPathNode::endless) {
            const int loop = add();
            link(at, loop);
            link(build(*node.parts[0], loop), loop);
            link(loop, to);
            return to;
        }
        for (int i = node.least; i < node.most; ++i) {
            link(at, to);
            at = build(*node.parts[0], at);
        }
        link(at, to);
        return to;
    }

    int numberOf(const EventPattern& pattern) {
        const auto [place, isNew] = _numbers.emplace(&pattern, int(_patterns.size()));
        if (isNew) _patterns.push_back(&pattern);
        return place->second;
    }

    const std::string& _expression;
    std::vector<State> _states;
    std::vector<const EventPattern*> _patterns;
    std::map<const EventPattern*, int> _numbers;
    mutable std::vector<char> _known; ///< of close(): bytes are faster than bits
    int _end = 0;
};

LightPathAutomaton::LightPathAutomaton(const std::string& expression, const LightLabels& labels) {
    const auto tree = parseLightPath(expression);
    const Nondeterministic all(*tree, expression);
    std::vector<std::string> names;
    collectLabels(*tree, names);
    EventColumns columns(all.patterns(), names, labels);
    _columns = size_t(columns.count());
    _columnOf = columns.takeSymbols();
    determinise(all, columns, expression);
    merge();
    if (!fitsSomePath(columns))
        throw std::invalid_argument("light path expression '" + expression +
                                    "': no path fits it; one leads from C over R, T and V to L, B "
                                    "or O");
}

void LightPathAutomaton::determinise(const Nondeterministic& from, const EventColumns& columns,
                                     const std::string& expression) {
    std::map<std::vector<int>, int> numbers;
    std::vector<std::vector<int>> sets;
    size_t steps = 0;
    const auto numberOf = [&](std::vector<int> set) {
        steps += from.close(set);
        if (steps > maxSteps) tooLarge(expression);
        const auto [place, isNew] = numbers.emplace(set, int(sets.size()));
        if (isNew) {
            if (sets.size() >= maxStates) tooLarge(expression);
            _accepts.push_back(std::binary_search(set.begin(), set.end(), from.end()));
            sets.push_back(std::move(set));
        }
        return place->second;
    };
    numberOf({0});
    const int nothing = numberOf({}); // no path that gets here fits any more
    std::vector<std::vector<int>> reached(_columns);
    for (size_t i = 0; i < sets.size(); ++i) {
        if ((i + 1) * _columns > maxEntries) tooLarge(expression);
        _next.resize((i + 1) * _columns, nothing);
        for (const int state : sets[i]) {
            const Nondeterministic::State& s = from.state(state);
            if (s.pattern < 0) continue;
            for (const int column : columns.ofPattern(size_t(s.pattern)))
                reached[size_t(column)].push_back(s.next);
        }
        for (size_t column = 0; column < _columns; ++column)
            if (!reached[column].empty())
                _next[i * _columns + column] =
                    numberOf(std::exchange(reached[column], std::vector<int>()));
    }
}

void LightPathAutomaton::merge() {
    const StateClasses merged(_next, _columns, _accepts);
    const std::vector<int> classes = merged.numbered(); // the start stays 0
    std::vector<int> next(merged.count() * _columns);
    std::vector<bool> accepts(merged.count());
    for (size_t s = 0; s < classes.size(); ++s) {
        const size_t c = size_t(classes[s]);
        accepts[c] = _accepts[s];
        for (size_t a = 0; a < _columns; ++a)
            next[c * _columns + a] = classes[size_t(_next[s * _columns + a])];
    }
    _next = std::move(next);
    _accepts = std::move(accepts);
}

bool LightPathAutomaton::fitsSomePath(const EventColumns& columns) const {
    std::vector<bool> known(_accepts.size());
    std::vector<int> left;
    const auto to = [&](int state, int column) {
        return _next[size_t(state) * _columns + size_t(column)];
    };
    for (int column = 0; column < columns.count(); ++column)
        if (columns.holds(column).camera) left.push_back(to(start(), column));
    while (!left.empty()) {
        const int state = left.back();
        left.pop_back();
        if (known[size_t(state)]) continue;
        known[size_t(state)] = true;
        for (int column = 0; column < columns.count(); ++column) {
            if (columns.holds(column).emitter && accepts(to(state, column))) return true;
            if (columns.holds(column).scattering) left.push_back(to(state, column));
        }
    }
    return false;
}

void LightPathRoom::addLabels(const std::string& expression) {
    if (_expressions >= maxExpressions)
        throw std::invalid_argument("light path expression '" + expression +
                                    "': a render has at most " + std::to_string(maxExpressions) +
                                    " of them");
    std::vector<std::string> labels = _labels;
    collectLabels(*parseLightPath(expression), labels);
    if (labels.size() > maxLabels)
        throw std::invalid_argument("light path expression '" + expression +
                                    "': those of a render name at most " +
                                    std::to_string(maxLabels) + " labels");
    _labels = std::move(labels);
    ++_expressions;
}

void LightPathRoom::addStates(const std::string& expression, const LightPathAutomaton& automaton) {
    if (_states + size_t(automaton.size()) > maxStatesOfAll)
        throw std::invalid_argument("light path expression '" + expression +
                                    "': those of a render need too many states");
    _states += size_t(automaton.size());
}

void LightPathRoom::add(const std::string& expression) {
    LightPathRoom more = *this;
    more.addLabels(expression);
    // Its states do not depend on what other expressions name.
    std::vector<std::string> labels;
    collectLabels(*parseLightPath(expression), labels);
    more.addStates(expression, LightPathAutomaton(expression, LightLabels(std::move(labels))));
    *this = std::move(more);
}

LightPathSet::LightPathSet(const std::vector<std::string>& expressions) : _labels({}) {
    LightPathRoom room;
    for (const std::string& expression : expressions)
        room.addLabels(expression);
    _labels = LightLabels(room._labels);
    for (const std::string& expression : expressions) {
        _automata.emplace_back(expression, _labels);
        room.addStates(expression, _automata.back());
    }
}

} // namespace patina
