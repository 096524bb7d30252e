// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace patina {

/// Splits the states of a deterministic automaton into classes until all of a class lead to the
/// same classes (Hopcroft 1971, An n log n Algorithm for Minimizing States in a Finite Automaton).
class StateClasses {
public:
    /// @param next by state, then by column
    StateClasses(const std::vector<int>& next, size_t columns, const std::vector<bool>& accepts)
        : _columns(columns), _states(accepts.size()), _class(_states), _place(_states) {
        for (const bool accepted : {false, true}) {
            const size_t begin = _order.size();
            for (size_t s = 0; s < _states; ++s)
                if (accepts[s] == accepted) put(s, _order.size(), _classes.size());
            if (_order.size() > begin) _classes.push_back({begin, _order.size(), begin});
        }
        collectSources(next);
        for (size_t c = 0; c < _classes.size(); ++c)
            _left.push_back(c);
        while (!_left.empty()) {
            const size_t by = _left.back();
            _left.pop_back();
            split(by);
        }
    }

    size_t count() const { return _classes.size(); }
    /// The class of each state, numbered by their first states.
    std::vector<int> numbered() const {
        std::vector<int> numbers(_classes.size(), -1), found;
        int known = 0;
        for (const size_t c : _class) {
            if (numbers[c] < 0) numbers[c] = known++;
            found.push_back(numbers[c]);
        }
        return found;
    }

private:
    struct Class {
        size_t begin, end; ///< in _order
        size_t met;        ///< where those end that lead to the class that splits
    };

    void put(size_t state, size_t place, size_t ofClass) {
        if (place == _order.size()) _order.push_back(state);
        _order[place] = state;
        _place[state] = place;
        _class[state] = ofClass;
    }

    /// By column and state those that lead to it, one after the other.
    void collectSources(const std::vector<int>& next) {
        _first.assign(_columns * _states + 1, 0);
        _sources.resize(_columns * _states);
        for (size_t i = 0; i < next.size(); ++i)
            ++_first[i % _columns * _states + size_t(next[i]) + 1];
        for (size_t i = 1; i < _first.size(); ++i)
            _first[i] += _first[i - 1];
        std::vector<unsigned> at(_first.begin(), _first.end() - 1);
        for (size_t i = 0; i < next.size(); ++i)
            _sources[at[i % _columns * _states + size_t(next[i])]++] = unsigned(i / _columns);
    }

    /// Parts each class by what leads to one of them.
    void split(size_t by) {
        const std::vector<size_t> members(_order.begin() + std::ptrdiff_t(_classes[by].begin),
                                          _order.begin() + std::ptrdiff_t(_classes[by].end));
        std::vector<size_t> met;
        for (size_t column = 0; column < _columns; ++column) {
            met.clear();
            for (const size_t member : members) {
                const size_t to = column * _states + member;
                for (unsigned i = _first[to]; i < _first[to + 1]; ++i) {
                    const size_t state = _sources[i], c = _class[state];
                    Class& of = _classes[c];
                    if (of.met == of.begin) met.push_back(c);
                    const size_t swapped = _order[of.met];
                    put(swapped, _place[state], c);
                    put(state, of.met++, c);
                }
            }
            for (const size_t c : met)
                part(c);
        }
    }

    void part(size_t c) {
        const size_t middle = std::exchange(_classes[c].met, _classes[c].begin);
        const size_t begin = _classes[c].begin, end = _classes[c].end;
        if (middle == end) return;
        // The smaller part is the new class. It alone has yet to split others, or the rest waits
        // for that already.
        const bool frontIsNew = middle - begin <= end - middle;
        const size_t from = frontIsNew ? begin : middle, to = frontIsNew ? middle : end;
        if (frontIsNew)
            _classes[c].begin = _classes[c].met = middle;
        else
            _classes[c].end = middle;
        for (size_t i = from; i < to; ++i)
            _class[_order[i]] = _classes.size();
        _left.push_back(_classes.size());
        _classes.push_back({from, to, from});
    }

    size_t _columns, _states;
    std::vector<size_t> _order; ///< the states, class by class
    std::vector<size_t> _class, _place;
    std::vector<Class> _classes;
    std::vector<unsigned> _first, _sources;
    std::vector<size_t> _left; ///< classes that have yet to split others
};

} // namespace patina
