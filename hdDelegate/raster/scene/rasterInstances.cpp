// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/scene/rasterInstances.h"

#include "hdDelegate/compiled/drawFilter.h"
#include "hdDelegate/scene/lightUnits.h"

#include <cmath>

namespace patina {

namespace {

bool usable(const mat4& m) {
    const float volume = glm::determinant(mat3(m));
    float sum = 0.0f;
    for (int i = 0; i < 4; ++i)
        sum += m[i].x + m[i].y + m[i].z + m[i].w;
    return std::isfinite(sum) && std::isfinite(volume) && volume != 0.0f;
}

} // namespace

bool isDrawnInRaster(const Geometry& prim, const RenderSettings& settings) {
    return prim.visibility.camera && isDrawn(prim, settings);
}

std::optional<Message> notShownInRaster(const Marked& prim) {
    const Visibility& v = prim.visibility;
    if (!v.camera && !v.shadow) return {};
    if (!v.camera) return messages::hiddenWithoutShadow;
    if (prim.catching.any()) return messages::catchersShown;
    if (prim.dielectricPriority > 0) return messages::prioritiesNotRanked;
    const unsigned seenBy = v.mask() & RayIndirect;
    if (seenBy != RayIndirect && seenBy != 0u) return messages::raysNotToldApart;
    return {};
}

RasterInstances::RasterInstances(std::shared_ptr<const Placements> placements, float timeCode,
                                 const vec3& origin)
    : _placements(std::move(placements)), _time(timeCode), _origin(origin) {
    _places[""] = {RasterPlace()};
    _places[""][0].groupToWorld[3] -= glm::dvec4(origin, 0.0);
}

const std::vector<RasterPlace>& RasterInstances::places(const std::string& group) {
    const auto known = _places.find(group);
    if (known != _places.end()) return known->second;
    std::vector<RasterPlace> list;
    const auto step = [this](const Instancer& instancer, uint32_t i, int depth,
                             RasterPlace& place) {
        if (!instancer.visibility.camera) return false;
        if (i < instancer.marks.size()) {
            if (!instancer.marks[i].visibility.camera) return false;
            place.matte |= instancer.marks[i].catching.matte;
        }
        place.groupToWorld = exactTransformAt(instancer.transforms[i], _time) * place.groupToWorld;
        const int own = i < instancer.ids.size() ? instancer.ids[i] : int(i);
        const size_t prototype = size_t(instancer.prototypeIndices[i]);
        if (depth == 0)
            place.id = own;
        else if (prototype < instancer.idCounts.size())
            place.id += own * instancer.idCounts[prototype];
        place.steps.insert(place.steps.begin(), {_placements->valuesOf(instancer).get(), int(i)});
        if (i < instancer.categories.size())
            place.categories.insert(place.categories.end(), instancer.categories[i].begin(),
                                    instancer.categories[i].end());
        return true;
    };
    _placements->forPlaces(group, RasterPlace(), step, [&](const RasterPlace& place) {
        if (!usable(place.groupToWorld)) return;
        list.push_back(place);
        list.back().groupToWorld[3] -= glm::dvec4(_origin, 0.0);
    });
    return _places[group] = std::move(list);
}

} // namespace patina
