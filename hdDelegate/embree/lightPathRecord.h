// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/embree/aovWriter.h"
#include "hdDelegate/film/lightPaths/lightPathAutomaton.h"
#include "base/maths.h"

namespace patina {

/// The AOVs of light paths that a render writes.
class LightPathAovs {
public:
    explicit LightPathAovs(const std::vector<AovSpec>& aovs);

    bool empty() const { return _set.automata().empty() && _shadow < 0; }
    bool hasShadow() const { return _shadow >= 0; }
    const LightPathSet& set() const { return _set; }

    /// Adds the sums of a sample to the film, before its colour.
    /// @param black the film drops the sample's colour
    void write(const class LightPathRecord& record, const AovTarget& target, float exposureScale,
               bool black) const;

private:
    static std::vector<std::string> expressionsOf(const std::vector<AovSpec>& aovs);

    LightPathSet _set;
    std::vector<int> _places; ///< in the film, of each expression
    int _shadow = -1;         ///< place in the film, or -1
};

/// Divides the light of one path among the AOVs that its events match.
///
/// If diffuse and glossy lobes both send light along a path, its throughput is the sum of both. The
/// drawn lobe decides densities, not light. So a path is in several states of each automaton, with
/// weights that sum to 1, and each AOV gets exactly the share of its lobes. The AOVs of a partition
/// sum to the colour.
///
/// Each contribution is announced by straight(), found() or lit(), and counts once add() gives the
/// light that is added to the path's radiance.
class LightPathRecord {
public:
    explicit LightPathRecord(const LightPathAovs& aovs);

    const LightPathAovs& aovs() const { return _aovs; }
    const vec3& sum(size_t expression) const { return _sums[expression]; }

    /// Light arrives by the path as it is.
    void straight(const LightEvent& emitter);
    /// The same, of a light that the camera sees. @param radiance that is added
    void see(const LightEvent& emitter, const vec3& radiance) {
        straight(emitter);
        add(radiance, vec3(1.0f));
    }
    /// Light is found by a ray that scatter() has told of.
    /// @param radiance without the factors of the light for diffuse and other lobes
    void found(const LightEvent& emitter, const vec3& radiance, float diffuse, float specular);
    /// Light scatters once more. Parts are of diffuse and of glossy lobes.
    void lit(EventType type, const vec3& diffuse, const vec3& glossy, const LightEvent& emitter);
    /// @param radiance that arrives; @param factor of what was announced, throughput and clamp
    void add(const vec3& radiance, const vec3& factor);

    /// The path goes on from a surface or a medium.
    /// @param diffuseShare of the throughput's last factor; the rest is that of glossy lobes, or of
    ///        the singular one
    void scatter(EventType type, bool singular, const vec3& diffuseShare);

    /// Goes back to an event of the path, from where it is followed once more. What was added
    /// stays.
    void goBack(const LightPathRecord& event);

    vec3 shadow{0.0f};
    bool beneath = false; ///< what scatters is where a walk beneath a surface ends

private:
    enum class Announced { Nothing, Straight, Scattered };
    using Weights = std::vector<vec3>; ///< of the states of all automata, one after the other

    int symbol(EventType type, EventScatter scatter) const;
    void addThrough(const Weights& weights, int event, int emitter, const vec3& value);

    const LightPathAovs& _aovs;
    Weights _weights, _before; ///< now, and before the last event
    std::vector<vec3> _sums;
    int _lastDiffuse = 0, _lastOther = 0; ///< symbols of the last event
    vec3 _lastShare{1.0f};                ///< of _lastDiffuse

    Announced _announced = Announced::Nothing;
    const Weights* _from = nullptr; ///< that the announced light scatters after
    int _emitter = 0, _byDiffuse = 0, _byOther = 0;
    vec3 _diffuse{0.0f}, _other{0.0f};
};

} // namespace patina
