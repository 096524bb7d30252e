// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/embree/embreeScene.h"
#include "hdDelegate/lights/lightSet.h"

#include <functional>
#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace patina {

/// The triangles of surfaces that glow, at each place of these: what a LightSet chooses among.
/// Places are counted as in LightSetInput::glowing.
class GlowingSurfaces {
public:
    /// The radiance of a surface at one of its places towards its viewer.
    using Emission = std::function<vec3(const SurfacePoint&, size_t place)>;

    /// @param placements that the places of surfaces stand in
    explicit GlowingSurfaces(std::shared_ptr<const Placements> placements)
        : _placements(std::move(placements)) {}

    /// @param info of the light that it is, for infoOf()
    /// @param isMeshLight triangles are lights also where their material does not glow
    /// @param alike whether materials alone tell places apart
    void add(const Surface& surface, std::vector<GroupPlace> places, int info, bool isMeshLight,
             bool alike, const Emission& emission, LightSetInput& input);

    /// @returns the place of a hit, and which of the triangles of that place it is; -1 where it
    ///     does not glow
    std::pair<int, int> find(const Hit& hit) const;
    /// The place of a hit, from the surface's first one.
    int placeFromFirst(const Hit& hit) const;
    Hit hit(int place, int triangle, const vec2& barycentrics) const;

    const Surface* surface(int place) const { return _sources[size_t(place)].surface; }
    int infoOf(int place) const { return _sources[size_t(place)].info; }

private:
    /// A surface wherever it is placed.
    struct Emitting {
        std::vector<int> slots;           ///< per primitive: which of those that glow it is, or -1
        std::vector<unsigned> primitives; ///< per slot
        int firstPlace = 0;               ///< the others follow
        std::vector<int> places;          ///< these, in the order of the instances around them
    };
    /// Of a place.
    struct Source {
        const Surface* surface;
        const Emitting* emitting;
        int info;
    };

    int placeOf(const Emitting& emitting, const Hit& hit) const;

    std::shared_ptr<const Placements> _placements; ///< keeps what _places points to
    std::vector<Source> _sources;
    std::vector<GroupPlace> _places;
    std::map<const Surface*, Emitting> _emitting;
};

} // namespace patina
