// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace patina {

/// An event of light at one point of its path, by the letters of OSL's light path expressions.
enum class EventType {
    Camera,     ///< C
    Reflect,    ///< R
    Transmit,   ///< T
    Volume,     ///< V, a medium or a volume scatters; always diffuse
    Light,      ///< L, a light of the scene but for domes
    Background, ///< B, a dome light; L means it too
    Object,     ///< O, a surface, a medium or a volume that glows by its material
};
constexpr int eventTypes = 7;

enum class EventScatter {
    None,     ///< x, of all that does not scatter
    Diffuse,  ///< D
    Glossy,   ///< G, a lobe of some width that is not diffuse
    Singular, ///< S, a mirror, or a clear pane
    Straight, ///< s; what presence lets through is no event, so that none has it
};
constexpr int eventScatters = 5;

struct LightEvent {
    static constexpr int noLabel = -1;

    EventType type = EventType::Object;
    EventScatter scatter = EventScatter::None;
    int label = noLabel; ///< index, see LightLabels
};

/// The labels that the expressions of a render name, and one for all others.
class LightLabels {
public:
    explicit LightLabels(std::vector<std::string> names) : _names(std::move(names)) {}

    int count() const { return int(_names.size()) + 1; } ///< the other one included
    /// @returns LightEvent::noLabel for an empty name
    int of(const std::string& name) const {
        if (name.empty()) return LightEvent::noLabel;
        for (size_t i = 0; i < _names.size(); ++i)
            if (_names[i] == name) return int(i);
        return int(_names.size());
    }
    /// @param label 0 to count() - 2
    const std::string& name(int label) const { return _names[size_t(label)]; }

private:
    std::vector<std::string> _names;
};

/// Whether some event has these two.
inline bool happens(EventType type, EventScatter scatter) {
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

/// Whether a path goes on from it.
inline bool scatters(EventType type) {
    return type == EventType::Reflect || type == EventType::Transmit || type == EventType::Volume;
}

/// Events of a render are numbered, from 0 on.
inline int symbolOf(const LightEvent& event, const LightLabels& labels) {
    const int kind = int(event.type) * eventScatters + int(event.scatter);
    return kind * (labels.count() + 1) + event.label + 1;
}
inline int symbolCount(const LightLabels& labels) {
    return eventTypes * eventScatters * (labels.count() + 1);
}

} // namespace patina
