// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/lightPathRecord.h"

namespace patina {

namespace {

constexpr char beneathLabel[] = "subsurface"; // of aovs.def's expressions

} // namespace

std::vector<std::string> LightPathAovs::expressionsOf(const std::vector<AovSpec>& aovs) {
    std::vector<std::string> expressions;
    for (const AovSpec& aov : aovs)
        if (!aov.paths.empty()) expressions.push_back(aov.paths);
    return expressions;
}

LightPathAovs::LightPathAovs(const std::vector<AovSpec>& aovs) : _set(expressionsOf(aovs)) {
    for (size_t i = 0; i < aovs.size(); ++i) {
        if (!aovs[i].paths.empty()) _places.push_back(int(i));
        if (aovs[i].id == AovId::shadow) _shadow = int(i);
    }
}

void LightPathAovs::write(const LightPathRecord& record, const AovTarget& target,
                          float exposureScale, bool black) const {
    const auto put = [&](int place, const vec3& sum) {
        const vec3 value = black ? vec3(0.0f) : sum * exposureScale;
        target.film.addAov(place, target.x, target.y, &value.x, target.distance);
    };
    for (size_t i = 0; i < _places.size(); ++i)
        put(_places[i], record.sum(i));
    if (_shadow >= 0) put(_shadow, record.shadow);
}

LightPathRecord::LightPathRecord(const LightPathAovs& aovs)
    : _aovs(aovs), _sums(aovs.set().automata().size(), vec3(0.0f)) {
    for (const LightPathAutomaton& automaton : aovs.set().automata()) {
        const size_t first = _weights.size();
        _weights.resize(first + size_t(automaton.size()), vec3(0.0f));
        const int camera =
            automaton.next(automaton.start(), symbol(EventType::Camera, EventScatter::None));
        _weights[first + size_t(camera)] = vec3(1.0f);
    }
    _before = _weights;
}

void LightPathRecord::goBack(const LightPathRecord& event) {
    _weights = event._weights;
    _before = event._before;
    _lastDiffuse = event._lastDiffuse;
    _lastOther = event._lastOther;
    _lastShare = event._lastShare;
    beneath = event.beneath;
}

int LightPathRecord::symbol(EventType type, EventScatter scatter) const {
    const bool walked = beneath && type != EventType::Camera;
    return _aovs.set().symbol(
        {walked ? EventType::Transmit : type, scatter,
         walked ? _aovs.set().labels().of(beneathLabel) : LightEvent::noLabel});
}

void LightPathRecord::straight(const LightEvent& emitter) {
    _announced = Announced::Straight;
    _emitter = _aovs.set().symbol(emitter);
}

void LightPathRecord::found(const LightEvent& emitter, const vec3& radiance, float diffuse,
                            float specular) {
    _announced = Announced::Scattered;
    _emitter = _aovs.set().symbol(emitter);
    _from = &_before;
    _byDiffuse = _lastDiffuse;
    _byOther = _lastOther;
    _diffuse = _lastShare * radiance * diffuse;
    _other = (vec3(1.0f) - _lastShare) * radiance * specular;
}

void LightPathRecord::lit(EventType type, const vec3& diffuse, const vec3& glossy,
                          const LightEvent& emitter) {
    _announced = Announced::Scattered;
    _emitter = _aovs.set().symbol(emitter);
    _from = &_weights;
    _byDiffuse = symbol(type, EventScatter::Diffuse);
    _byOther = symbol(type, EventScatter::Glossy);
    _diffuse = diffuse;
    _other = glossy;
}

void LightPathRecord::add(const vec3& radiance, const vec3& factor) {
    if (_announced == Announced::Scattered) {
        addThrough(*_from, _byDiffuse, _emitter, factor * _diffuse);
        addThrough(*_from, _byOther, _emitter, factor * _other);
    } else if (_announced == Announced::Straight) {
        addThrough(_weights, -1, _emitter, factor * radiance);
    }
    _announced = Announced::Nothing;
}

/// @param event before the emitter, -1 for none
void LightPathRecord::addThrough(const Weights& weights, int event, int emitter,
                                 const vec3& value) {
    if (value == vec3(0.0f)) return;
    size_t first = 0;
    for (size_t a = 0; a < _sums.size(); ++a) {
        const LightPathAutomaton& automaton = _aovs.set().automata()[a];
        for (int s = 0; s < automaton.size(); ++s) {
            const vec3& weight = weights[first + size_t(s)];
            if (weight == vec3(0.0f)) continue;
            const int after = event < 0 ? s : automaton.next(s, event);
            if (automaton.accepts(automaton.next(after, emitter))) _sums[a] += weight * value;
        }
        first += size_t(automaton.size());
    }
}

void LightPathRecord::scatter(EventType type, bool singular, const vec3& diffuseShare) {
    _lastDiffuse = symbol(type, EventScatter::Diffuse);
    _lastOther = symbol(type, singular ? EventScatter::Singular : EventScatter::Glossy);
    _lastShare = diffuseShare;
    _before.swap(_weights);
    std::fill(_weights.begin(), _weights.end(), vec3(0.0f));
    size_t first = 0;
    for (const LightPathAutomaton& automaton : _aovs.set().automata()) {
        for (int s = 0; s < automaton.size(); ++s) {
            const vec3& weight = _before[first + size_t(s)];
            if (weight == vec3(0.0f)) continue;
            _weights[first + size_t(automaton.next(s, _lastDiffuse))] += weight * diffuseShare;
            _weights[first + size_t(automaton.next(s, _lastOther))] +=
                weight * (vec3(1.0f) - diffuseShare);
        }
        first += size_t(automaton.size());
    }
}

} // namespace patina
