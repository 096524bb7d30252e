// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/film/lightPaths/lightEvent.h"

#include <algorithm>
#include <string>
#include <vector>

namespace patina {

/// One event of an expression: all events that it may be.
struct EventPattern {
    static constexpr unsigned any = ~0u;

    unsigned types = any;    ///< bits of EventType
    unsigned scatters = any; ///< bits of EventScatter

    /// The labels that one place of a pattern takes.
    struct Labels {
        std::vector<std::string> names;
        bool none = false;    ///< also an event without a label
        bool negated = false; ///< all but these
    };
    /// Events have one label at most: a pattern of more has no event.
    std::vector<Labels> labels;

    bool matches(const LightEvent& event, const LightLabels& known) const {
        if (!(types & (1u << int(event.type))) || !(scatters & (1u << int(event.scatter))))
            return false;
        if (labels.empty()) return true;
        if (labels.size() > 1) return false;
        return holds(labels[0], event.label, known) != labels[0].negated;
    }

private:
    static bool holds(const Labels& l, int label, const LightLabels& known) {
        if (label == LightEvent::noLabel) return l.none;
        return label < known.count() - 1 &&
               std::find(l.names.begin(), l.names.end(), known.name(label)) != l.names.end();
    }
};

} // namespace patina
