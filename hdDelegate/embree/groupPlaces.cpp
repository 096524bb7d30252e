// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/groupPlaces.h"

namespace patina {

void GroupPlaces::each(const std::string& group,
                       const std::function<void(const mat4&)>& visit) const {
    _placements->forPlaces(
        group, mat4(1.0f),
        [&](const Instancer& instancer, uint32_t i, int, mat4& place) {
            place = _space.still(instancer.transforms[i], instancer.group) * place;
            return true;
        },
        visit);
}

std::vector<mat4> GroupPlaces::transforms(const std::string& group) const {
    std::vector<mat4> result;
    each(group, [&](const mat4& place) { result.push_back(place); });
    return result;
}

std::vector<GroupPlace> GroupPlaces::places(const std::string& group) const {
    std::vector<GroupPlace> result;
    _placements->forPlaces(
        group, GroupPlace(),
        [&](const Instancer& instancer, uint32_t i, int, GroupPlace& place) {
            place.toWorld = _space.still(instancer.transforms[i], instancer.group) * place.toWorld;
            place.steps.insert(place.steps.begin(),
                               {_placements->valuesOf(instancer).get(), int(i)});
            return true;
        },
        [&](const GroupPlace& place) { result.push_back(place); });
    return result;
}

std::vector<MovingPlace> GroupPlaces::moving(const std::string& group) const {
    std::vector<MovingPlace> result;
    _placements->forPlaces(
        group, MovingPlace(),
        [&](const Instancer& instancer, uint32_t i, int, MovingPlace& place) {
            place.enter(_space.steps(instancer.transforms[i], instancer.group));
            place.mask &= instancer.visibility.mask();
            if (instancer.marks.empty()) return true;
            place.mask &= instancer.marks[i].visibility.mask();
            place.matte |= instancer.marks[i].catching.matte;
            return true;
        },
        [&](const MovingPlace& place) { result.push_back(place); });
    return result;
}

} // namespace patina
