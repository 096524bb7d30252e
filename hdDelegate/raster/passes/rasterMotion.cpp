// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/passes/rasterMotion.h"

#include "hdDelegate/scene/lightUnits.h"

#include <algorithm>

namespace patina {

RasterMotion::RasterMotion(const RasterScene& scene, const RasterCamera& camera,
                           const std::vector<AovSpec>& aovs)
    : _screen(camera.camera(), camera.frame()) {
    if (std::none_of(aovs.begin(), aovs.end(), [](const AovSpec& aov) {
            return aov.id == AovId::motionForward || aov.id == AovId::motionBackward;
        }))
        return;
    const float seen = camera.timeCode(0.5f);
    for (const float time :
         {ScreenMotion::timeCode(ScreenMotion::Before), ScreenMotion::timeCode(ScreenMotion::Now),
          ScreenMotion::timeCode(ScreenMotion::After), seen})
        _instances.push_back(
            std::make_unique<RasterInstances>(scene.parts().placements, time, scene.origin()));
    for (const RasterDraw& draw : scene.draws()) {
        const auto [at, isNew] = _prims.try_emplace(draw.primId);
        if (!isNew) continue;
        Prim& prim = at->second;
        for (int m = 0; m < 3; ++m) {
            prim.toGroup[m] = exactTransformAt(draw.prim->transform,
                                               ScreenMotion::timeCode(ScreenMotion::Moment(m)));
            prim.places[m] = &_instances[size_t(m)]->places(draw.prim->group);
        }
        prim.fromWhereSeen = glm::inverse(exactTransformAt(draw.prim->transform, seen));
        prim.seen = &_instances[3]->places(draw.prim->group);
    }
}

bool RasterMotion::way(const int* ids, const vec3& position, ScreenMotion::Moment moment,
                       float out[2]) const {
    const auto known = _prims.find(ids[0]);
    if (known == _prims.end() || ids[3] < 0) return false;
    const Prim& prim = known->second;
    const size_t place = size_t(ids[3]);
    if (place >= prim.seen->size()) return false;
    const glm::dvec4 inPrim = prim.fromWhereSeen * glm::inverse((*prim.seen)[place].groupToWorld) *
                              glm::dvec4(dvec3(position), 1.0);
    const auto inWorld = [&](ScreenMotion::Moment m) {
        return dvec3((*prim.places[m])[place].groupToWorld * prim.toGroup[m] * inPrim);
    };
    if (place >= prim.places[ScreenMotion::Now]->size() || place >= prim.places[moment]->size())
        return false;
    return _screen.way(inWorld(ScreenMotion::Now), inWorld(moment), moment, out);
}

} // namespace patina
