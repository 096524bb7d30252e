// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/film/lightPaths/lightPathAutomaton.h"

#include <map>
#include <stdexcept>

namespace patina {

namespace {

constexpr size_t maxNodes = 20000; // of the nondeterministic automaton
constexpr size_t maxStates = 2000; // before equal ones are merged

[[noreturn]] void tooLarge(const std::string& expression) {
    throw std::invalid_argument("light path expression '" + expression +
                                "': it needs too many states; fewer or smaller {n,m} need less");
}

/// All possible events: letters in the order of EventType and EventScatter.
bool happens(EventType type, EventScatter scatter) {
    switch (type) {
    case EventType::Reflect:
        return scatter != EventScatter::None && scatter != EventScatter::Straight;
    case EventType::Transmit: return scatter != EventScatter::None;
    case EventType::Volume: return scatter == EventScatter::Diffuse;
    case EventType::Camera:
    case EventType::Light:
    case EventType::Background:
    case EventType::Object: return scatter == EventScatter::None;
    }
    return false;
}

template <class Act> void eachEvent(const LightLabels& labels, const Act& act) {
    for (int type = 0; type < eventTypes; ++type)
        for (int scatter = 0; scatter < eventScatters; ++scatter)
            for (int label = LightEvent::noLabel; label < labels.count(); ++label)
                if (happens(EventType(type), EventScatter(scatter)))
                    act(LightEvent{EventType(type), EventScatter(scatter), label});
}

} // namespace

/// Thompson's construction: one node per event, and nodes that lead on without one.
class LightPathAutomaton::Nondeterministic {
public:
    struct State {
        const EventPattern* event = nullptr; ///< leads to `next` by it; null: `free` without any
        int next = -1;
        std::vector<int> free;
    };

    Nondeterministic(const LightPathNode& all, const std::string& expression)
        : _expression(expression) {
        const int begin = add();
        _end = build(all, begin);
    }

    const State& state(int i) const { return _states[size_t(i)]; }
    size_t size() const { return _states.size(); }
    int end() const { return _end; }

    /// Adds all that is reached without an event. @param set sorted on return
    void close(std::vector<int>& set) const {
        std::vector<bool> known(_states.size());
        std::vector<int> left = set;
        set.clear();
        while (!left.empty()) {
            const int i = left.back();
            left.pop_back();
            if (known[size_t(i)]) continue;
            known[size_t(i)] = true;
            left.insert(left.end(), state(i).free.begin(), state(i).free.end());
        }
        for (size_t i = 0; i < known.size(); ++i)
            if (known[i]) set.push_back(int(i));
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
            _states[size_t(step)].event = &node.event;
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

    const std::string& _expression;
    std::vector<State> _states;
    int _end = 0;
};

LightPathAutomaton::LightPathAutomaton(const std::string& expression, const LightLabels& labels) {
    const auto tree = parseLightPath(expression);
    _symbols = eventTypes * eventScatters * (labels.count() + 1);
    determinise(Nondeterministic(*tree, expression), labels, expression);
    merge();
    if (!fitsSomePath(labels))
        throw std::invalid_argument("light path expression '" + expression +
                                    "': no path fits it; one leads from C over R, T and V to L, B "
                                    "or O");
}

void LightPathAutomaton::determinise(const Nondeterministic& from, const LightLabels& labels,
                                     const std::string& expression) {
    std::map<std::vector<int>, int> numbers;
    std::vector<std::vector<int>> sets;
    const auto numberOf = [&](std::vector<int> set) {
        from.close(set);
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
    for (size_t i = 0; i < sets.size(); ++i) {
        _next.resize((i + 1) * size_t(_symbols), nothing);
        eachEvent(labels, [&](const LightEvent& event) {
            std::vector<int> reached;
            for (int state : sets[i]) {
                const Nondeterministic::State& s = from.state(state);
                if (s.event && s.event->matches(event, labels)) reached.push_back(s.next);
            }
            if (!reached.empty())
                _next[i * size_t(_symbols) + size_t(symbol(event, labels))] =
                    numberOf(std::move(reached));
        });
    }
}

/// Splits the states into classes until all of a class lead to the same classes.
void LightPathAutomaton::merge() {
    std::vector<int> classes(_accepts.begin(), _accepts.end());
    size_t count = 0;
    while (true) {
        std::map<std::vector<int>, int> known;
        std::vector<int> refined;
        for (int s = 0; s < size(); ++s) {
            std::vector<int> signature{classes[size_t(s)]};
            for (int a = 0; a < _symbols; ++a)
                signature.push_back(classes[size_t(next(s, a))]);
            refined.push_back(known.emplace(std::move(signature), int(known.size())).first->second);
        }
        classes = std::move(refined);
        if (known.size() == count) break;
        count = known.size();
    }
    // Classes are numbered by their first state, so that the start stays 0.
    std::vector<int> next(count * size_t(_symbols));
    std::vector<bool> accepts(count);
    for (int s = 0; s < size(); ++s) {
        const size_t c = size_t(classes[size_t(s)]);
        accepts[c] = _accepts[size_t(s)];
        for (int a = 0; a < _symbols; ++a)
            next[c * size_t(_symbols) + size_t(a)] = classes[size_t(this->next(s, a))];
    }
    _next = std::move(next);
    _accepts = std::move(accepts);
}

bool LightPathAutomaton::fitsSomePath(const LightLabels& labels) const {
    std::vector<bool> known(_accepts.size());
    std::vector<int> left;
    bool fits = false;
    const auto scatters = [](EventType type) {
        return type == EventType::Reflect || type == EventType::Transmit ||
               type == EventType::Volume;
    };
    eachEvent(labels, [&](const LightEvent& event) {
        if (event.type == EventType::Camera && event.label == LightEvent::noLabel)
            left.push_back(next(start(), symbol(event, labels)));
    });
    while (!left.empty()) {
        const int state = left.back();
        left.pop_back();
        if (known[size_t(state)]) continue;
        known[size_t(state)] = true;
        eachEvent(labels, [&](const LightEvent& event) {
            if (event.type == EventType::Camera) return;
            const int to = next(state, symbol(event, labels));
            if (scatters(event.type))
                left.push_back(to);
            else
                fits |= accepts(to);
        });
    }
    return fits;
}

namespace {

LightLabels labelsOf(const std::vector<std::string>& expressions) {
    std::vector<std::string> names;
    for (const std::string& expression : expressions)
        collectLabels(*parseLightPath(expression), names);
    return LightLabels(std::move(names));
}

} // namespace

LightPathSet::LightPathSet(const std::vector<std::string>& expressions)
    : _labels(labelsOf(expressions)) {
    for (const std::string& expression : expressions)
        _automata.emplace_back(expression, _labels);
}

} // namespace patina
