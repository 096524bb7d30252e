// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/embree/media/splatScene.h"
#include "hdDelegate/embree/sceneView.h"

#include <functional>

namespace patina {

/// Where a group is in the space that rays are traced in.
struct GroupPlace {
    mat4 toWorld{1.0f};
    std::vector<InstanceStep> steps; ///< from the outermost instance inwards
};

/// All places of groups in the world, through all levels of instances.
class GroupPlaces {
public:
    GroupPlaces() = default;
    GroupPlaces(std::shared_ptr<const Placements> placements, const TracedSpace& space)
        : _placements(std::move(placements)), _space(space) {}

    /// What the values of places() live as long as.
    const std::shared_ptr<const Placements>& placements() const { return _placements; }
    double count(const std::string& group) const { return _placements->count(group); }

    /// Visits one after the other, from the group to the world.
    void each(const std::string& group, const std::function<void(const mat4&)>& visit) const;
    std::vector<mat4> transforms(const std::string& group) const;
    /// The same with the instances around.
    std::vector<GroupPlace> places(const std::string& group) const;
    /// The same over the shutter, with what instances say of who sees them.
    std::vector<MovingPlace> moving(const std::string& group) const;

private:
    std::shared_ptr<const Placements> _placements;
    TracedSpace _space;
};

} // namespace patina
