// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/compiled/subdivision.h"

#include "hdDelegate/compiled/cameraFrame.h"
#include "hdDelegate/compiled/drawFilter.h"
#include "hdDelegate/scene/lightUnits.h"
#include "hdDelegate/scene/primCompare.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace patina {

namespace {

/// Where a group stands in the world at the frame.
struct SampledPlaces {
    std::vector<dmat4> toWorld;
    double each = 1.0; ///< places that one of them stands for
};

/// Everywhere, or where there are more than a million places, every so many of them.
SampledPlaces placesOf(const Placements& placements, const std::string& group) {
    constexpr double most = 1 << 20;
    SampledPlaces places;
    places.each = std::max(1.0, std::ceil(placements.count(group) / most));
    const size_t every = size_t(places.each);
    size_t number = 0;
    placements.forPlaces(
        group, dmat4(1.0),
        [](const Instancer& instancer, uint32_t i, int, dmat4& place) {
            place = exactTransformAt(instancer.transforms[i], 0.0f) * place;
            return true;
        },
        [&](const dmat4& place) {
            if (number++ % every == 0) places.toWorld.push_back(place);
        });
    return places;
}

/// Back ends of one scene differ in samples and the like, which decide nothing here.
bool decideAlike(const RenderSettings& a, const RenderSettings& b) {
    const auto all = [](const RenderSettings& s) {
        return std::tie(s.width, s.height, s.frameWindow, s.pixelAspectRatio,
                        s.aspectRatioConformPolicy, s.tolerance, s.edgeLength, s.methods,
                        s.enableMotionBlur, s.enableSceneMaterials, s.renderTags, s.rootPaths,
                        s.excludePaths);
    };
    return all(a) == all(b);
}

} // namespace

float Subdivision::edgeOf(bool displaced) const {
    return displaced && !method.forced && !method.point.empty()
               ? std::min(edgeLength, SubdivisionPlan::standardEdge)
               : edgeLength;
}

Subdivision SubdivisionChoice::plan(const SceneState& state, const Placements& placements,
                                    const Camera& camera, const RenderSettings& settings) {
    // Seen from the camera's own place, numbers of 32 bits are fine enough anywhere.
    const dvec3 eye = cameraPlace(camera, settings);
    SubdivisionPlan plan(settings, screenScale(camera, settings, eye));
    std::vector<std::shared_ptr<const void>> held;
    if (plan.isActive()) {
        std::map<std::string, SampledPlaces> places;
        for (const auto& item : state.geometry) {
            const auto& prim = item.second;
            if (!subdivides(*prim) || !isDrawn(*prim, settings)) continue;
            auto known = places.find(prim->group);
            if (known == places.end())
                known = places.emplace(prim->group, placesOf(placements, prim->group)).first;
            std::vector<mat4> toEye;
            for (const dmat4& place : known->second.toWorld)
                toEye.push_back(seenFrom(eye, place * exactTransformAt(prim->transform, 0.0f)));
            const auto material = _materials.find(prim->material, prim->path, state, settings);
            const auto program = _materials.program(material, settings.methods, settings.tolerance);
            const auto extent = _extents.of(prim);
            plan.add(*extent, toEye, program->planned(), known->second.each);
            held.insert(held.end(), {extent, program});
        }
    }
    _held = std::move(held);
    return {plan.chosen(), plan.edgeLength()};
}

Subdivision SubdivisionChoice::of(const SceneState& state, const Placements& placements,
                                  const Camera& camera, const RenderSettings& settings) {
    const std::lock_guard<std::mutex> lock(_mutex);
    if (_planned > 0 && _version == state.version && sameCamera(_camera, camera) &&
        decideAlike(_settings, settings))
        return _last;
    _last = plan(state, placements, camera, settings);
    ++_planned;
    _version = state.version;
    _camera = camera;
    _settings = settings;
    return _last;
}

size_t SubdivisionChoice::planned() const {
    const std::lock_guard<std::mutex> lock(_mutex);
    return _planned;
}

} // namespace patina
