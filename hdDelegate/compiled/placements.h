// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/compiled/instanceValues.h"
#include "hdDelegate/scene/scene.h"
#include "hdDelegate/scene/settings.h"

#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace patina {

/// The instancers that are drawn, indexed by the group around them and by their prototypes. To find
/// the places of a prototype, a back end looks only at that prototype's instances. Immutable.
class Placements {
public:
    static constexpr int maxDepth = 8; ///< instancers around each other

    /// The instances of one prototype that an instancer makes.
    struct Use {
        std::shared_ptr<const Instancer> instancer;
        std::vector<uint32_t> instances;
    };
    using Instancers = std::vector<std::shared_ptr<const Instancer>>;

    /// Instancers that place more than Limit::instances are left out, those of most first.
    /// @param settings excludePaths counts
    /// @param before of an earlier state: values of instancers that stayed are taken from it; or
    /// null
    Placements(const SceneState& state, const RenderSettings& settings, Diagnostics& diagnostics,
               const Placements* before = nullptr);

    /// In the order of the groups that they stand in, then of their paths.
    const std::vector<Use>& of(const std::string& prototype) const;
    const Instancers& in(const std::string& group) const; ///< in the order of their paths
    const Instancers& drawn() const { return _drawn; }    ///< in the order of their paths
    /// Of an instancer that is drawn.
    std::shared_ptr<const InstanceValues> valuesOf(const Instancer& instancer) const;
    /// Whether any instance has a primvar of this name.
    bool haveValue(const std::string& name) const { return _valueNames.count(name) > 0; }

    /// How often forPlaces() visits a group; a double, since it may be more than integers hold.
    double count(const std::string& group) const;

    /// Visits every place of a group in the world, through all levels of instances.
    /// @param inner what stands for the group's own space
    /// @param step (instancer, instance, depth, place) takes a place into the group around by
    /// changing it; false leaves it out. Depth counts instancers passed, from 0
    /// @param visit (place) is called for each place in the world
    template <class Place, class Step, class Visit>
    void forPlaces(const std::string& group, const Place& inner, const Step& step,
                   const Visit& visit, int depth = 0) const {
        if (group.empty()) {
            visit(inner);
            return;
        }
        // Ways that do not come to the world would be followed in vain, and may be very many.
        const auto levels = _levels.find(group);
        if (levels == _levels.end() || depth + levels->second > maxDepth + 1) return;
        for (const Use& use : of(group))
            for (const uint32_t i : use.instances) {
                Place place = inner;
                if (step(*use.instancer, i, depth, place))
                    forPlaces(use.instancer->group, place, step, visit, depth + 1);
            }
    }

private:
    void keepWithinLimits(Diagnostics& diagnostics);
    void countLevels();

    Instancers _drawn;
    std::map<std::string, Instancers> _in;
    std::map<std::string, std::vector<Use>> _of;
    std::map<std::string, int> _levels; ///< group -> least instancers between it and the world
    std::map<const Instancer*, std::shared_ptr<const InstanceValues>> _values;
    std::set<std::string> _valueNames;
};

} // namespace patina
