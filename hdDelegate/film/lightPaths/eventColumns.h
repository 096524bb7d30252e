// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/film/lightPaths/eventPattern.h"

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace patina {

/// Events that the same patterns of an expression match lead to the same states, so that they share
/// a column of its table: few, however many labels the other expressions of a render name.
class EventColumns {
public:
    static constexpr int unmatched = 0; ///< of events that no pattern matches

    struct Holds { ///< what is among a column's events
        bool camera = false;
        bool scattering = false;
        bool emitter = false;
    };

    /// Columns are in the order of their first events.
    /// @param patterns of an expression
    /// @param names all labels of theirs
    EventColumns(const std::vector<const EventPattern*>& patterns,
                 const std::vector<std::string>& names, const LightLabels& labels)
        : _ofSymbol(size_t(symbolCount(labels)), unmatched), _ofPattern(patterns.size()) {
        std::map<std::vector<bool>, int> known;
        known.emplace(std::vector<bool>(patterns.size()), int(unmatched));
        _holds.emplace_back();
        const auto columnOf = [&](const LightEvent& event) {
            std::vector<bool> matching(patterns.size());
            for (size_t i = 0; i < patterns.size(); ++i)
                matching[i] = patterns[i]->matches(event, labels);
            const auto [place, isNew] = known.emplace(std::move(matching), int(known.size()));
            if (isNew) {
                _holds.emplace_back();
                for (size_t i = 0; i < patterns.size(); ++i)
                    if (place->first[i]) _ofPattern[i].push_back(place->second);
            }
            return place->second;
        };
        std::vector<bool> named(size_t(labels.count()));
        for (const std::string& name : names)
            named[size_t(labels.of(name))] = true;
        for (int type = 0; type < eventTypes; ++type)
            for (int scatter = 0; scatter < eventScatters; ++scatter) {
                LightEvent event{EventType(type), EventScatter(scatter), LightEvent::noLabel};
                if (!happens(event.type, event.scatter)) continue;
                int other = -1; // of every label that the expression does not name
                for (; event.label < labels.count(); ++event.label) {
                    const bool own = event.label < 0 || named[size_t(event.label)];
                    const int column = own || other < 0 ? columnOf(event) : other;
                    if (!own) other = column;
                    _ofSymbol[size_t(symbolOf(event, labels))] = uint16_t(column);
                    Holds& holds = _holds[size_t(column)];
                    if (event.type == EventType::Camera)
                        holds.camera |= event.label == LightEvent::noLabel;
                    else
                        (scatters(event.type) ? holds.scattering : holds.emitter) = true;
                }
            }
    }

    int count() const { return int(_holds.size()); }
    const Holds& holds(int column) const { return _holds[size_t(column)]; }
    const std::vector<int>& ofPattern(size_t pattern) const { return _ofPattern[pattern]; }
    std::vector<uint16_t> takeSymbols() { return std::move(_ofSymbol); }

private:
    std::vector<uint16_t> _ofSymbol;
    std::vector<std::vector<int>> _ofPattern; ///< the columns that a pattern matches
    std::vector<Holds> _holds;
};

} // namespace patina
