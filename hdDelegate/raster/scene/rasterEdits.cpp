// SPDX-License-Identifier: Apache-2.0
// Updates of RasterScene after edits of prims that stay where they are in the scene: only what the
// edits touch is looked at.

#include "hdDelegate/raster/scene/rasterScene.h"

#include <algorithm>
#include <cstring>

namespace patina {

namespace {

/// Whether a box may be what makes bounds as wide as they are.
bool reaches(const RasterBox& box, const vec3& low, const vec3& high) {
    return glm::any(glm::lessThanEqual(box.center - box.half, low)) ||
           glm::any(glm::greaterThanEqual(box.center + box.half, high));
}

} // namespace

RasterScene::Sizes RasterScene::sizes() const {
    return {_groups.size(), _draws.size(), _instances.size(), _triangles, _trianglesDrawn};
}

void RasterScene::cutTo(const Sizes& sizes) {
    _groups.resize(sizes.groups);
    _draws.resize(sizes.draws);
    _instances.resize(sizes.instances);
    _boxes.resize(sizes.instances);
    _triangles = sizes.triangles;
    _trianglesDrawn = sizes.trianglesDrawn;
}

void RasterScene::findBounds() {
    _boundsMin = vec3(INFINITY);
    _boundsMax = vec3(-INFINITY);
    for (const RasterBox& box : _boxes) {
        _boundsMin = glm::min(_boundsMin, box.center - box.half);
        _boundsMax = glm::max(_boundsMax, box.center + box.half);
    }
}

void RasterScene::addResized(const SceneState& state, const RasterCamera& camera,
                             const std::atomic<bool>& stop, SceneEdits& edits) {
    RasterInstances places(_parts.placements, camera.timeCode(0.5f), _origin);
    for (const auto& [path, span] : _spans) {
        if (span.byEdge.empty()) continue;
        const auto prim = state.geometry.find(path);
        if (prim == state.geometry.end()) continue; // an edit tells
        const RasterDetail detail(*prim->second, *span.extent, camera, _settings,
                                  _subdivision.edgeOf(span.displaced), span.displaced, span.emits);
        const auto& where = places.places(prim->second->group);
        bool same = true;
        for (const auto& [edge, list] : span.byEdge)
            for (size_t i = 0; same && !stop && i < list.size(); ++i)
                same = list[i] < where.size() && detail.edgeAt(where[list[i]]) == edge;
        if (stop) return; // the next update looks at everything
        if (same) continue;
        edits.delta.geometry.emplace(path, PrimEdit::Set);
        edits.touched.insert(path);
    }
}

/// Draws a prim as it is now, in the place of what it was.
/// @returns false where that takes more or less room, or gives light
bool RasterScene::redraw(const std::shared_ptr<const Geometry>& prim, const SceneState& state,
                         const RasterCamera& camera, RasterInstances& places) {
    const auto known = _spans.find(prim->path);
    if (places.places(prim->group).empty()) return known == _spans.end();
    if (isDrawnInRaster(*prim, _settings) != (known != _spans.end())) return false;
    if (known == _spans.end()) return true;
    const Span old = known->second;
    if (old.emits || !isSurface(prim->kind)) return false;
    const Sizes before = sizes();
    Sizes after = before;
    bool wide = false;
    for (size_t d = old.firstDraw; d < old.firstDraw + old.draws; ++d) {
        const size_t triangles = _draws[d].surface->triangles;
        after.triangles -= triangles;
        after.trianglesDrawn -= triangles * _groups[size_t(_draws[d].group)].places.size();
    }
    addPrim(prim, old.rank, state, camera, places);
    const Span added = _spans.at(prim->path);
    bool fits = !added.emits && !_moves && added.groups == old.groups && added.draws == old.draws;
    for (size_t g = 0; fits && g < old.groups; ++g)
        fits = _groups[old.firstGroup + g].prim->group == prim->group &&
               _groups[old.firstGroup + g].places == _groups[added.firstGroup + g].places;
    if (!fits) return false;
    for (size_t d = 0; d < old.draws; ++d) {
        RasterDraw& draw = _draws[old.firstDraw + d];
        draw = _draws[added.firstDraw + d];
        draw.group -= int(added.firstGroup - old.firstGroup);
    }
    after.triangles += _triangles - before.triangles;
    after.trianglesDrawn += _trianglesDrawn - before.trianglesDrawn;
    for (size_t g = 0; g < old.groups; ++g) {
        RasterGroup& group = _groups[old.firstGroup + g];
        const int first = group.firstInstance;
        group = _groups[added.firstGroup + g];
        const auto count = std::ptrdiff_t(group.places.size());
        for (std::ptrdiff_t i = first; i < first + count; ++i)
            wide |= reaches(_boxes[size_t(i)], _boundsMin, _boundsMax);
        std::copy_n(_instances.begin() + group.firstInstance, count, _instances.begin() + first);
        std::copy_n(_boxes.begin() + group.firstInstance, count, _boxes.begin() + first);
        group.firstInstance = first;
    }
    cutTo(after);
    Span& kept = _spans[prim->path];
    kept = added;
    kept.firstGroup = old.firstGroup;
    kept.firstDraw = old.firstDraw;
    if (wide) findBounds();
    return true;
}

/// Gives the draws of a prim the materials that there are now.
void RasterScene::showMaterials(const Geometry& prim, const SceneState& state) {
    const auto known = _spans.find(prim.path);
    if (known == _spans.end()) return;
    for (size_t d = known->second.firstDraw; d < known->second.firstDraw + known->second.draws;
         ++d) {
        RasterDraw& draw = _draws[d];
        const std::string& own =
            draw.subset > 0 ? prim.subsets[size_t(draw.subset) - 1].material : prim.material;
        draw.material =
            &_materials.get(own.empty() ? prim.material : own, prim.path, state, _settings);
    }
}

bool RasterScene::showsInstances(const std::string& path) const {
    const auto known = _spans.find(path);
    if (known == _spans.end()) return false;
    const auto first = _draws.begin() + std::ptrdiff_t(known->second.firstDraw);
    return std::any_of(first, first + std::ptrdiff_t(known->second.draws),
                       [this](const RasterDraw& draw) { return readsInstances(draw); });
}

void RasterScene::uploadTouched(const Span& span) {
    for (size_t g = span.firstGroup; g < span.firstGroup + span.groups; ++g) {
        const size_t first = size_t(_groups[g].firstInstance);
        const size_t size = _groups[g].places.size() * sizeof(GpuInstance);
        if (std::memcmp(&_instances[first], &_written[first], size) == 0) continue;
        _instanceBuffer.write(&_instances[first], size, first * sizeof(GpuInstance));
        std::memcpy(&_written[first], &_instances[first], size);
        _instancesDiffer = true;
    }
}

bool RasterScene::updateTouched(const SceneEdits& edits, const SceneState& state,
                                const RasterCamera& camera, const std::atomic<bool>& stop,
                                const Compiling& compiling) {
    const SceneDelta& delta = edits.delta;
    // Moving prims stand where they were at the time of the last sample.
    if (_moves || !delta.instancers.empty() || !onlySets(delta.geometry) ||
        !onlySets(delta.materials))
        return false;
    if (!delta.geometry.empty() && !(_volumes.placed().empty() && _splats.empty())) return false;
    _looked += edits.touched.size();
    for (const std::string& path : edits.touched)
        if (!isSurface(state.geometry.at(path)->kind) || showsInstances(path)) return false;
    if (!_materials.edit(delta.materials, state, _settings)) return false;
    finishPrograms(stop, compiling);
    if (stop) return true; // the next update looks at everything
    if (!_materials.areShown(delta.materials)) return false;
    const size_t linkRows = _linkRows.size();
    _instancesDiffer = false;
    RasterInstances places(_parts.placements, camera.timeCode(0.5f), _origin);
    for (const std::string& path : edits.touched) {
        const auto& prim = state.geometry.at(path);
        if (delta.geometry.count(path) == 0)
            showMaterials(*prim, state);
        else if (!redraw(prim, state, camera, places))
            return false;
        if (showsInstances(path)) return false;
    }
    for (const auto& item : delta.geometry)
        if (const auto span = _spans.find(item.first); span != _spans.end())
            uploadTouched(span->second);
    _shapes.forgetReplaced();
    if (_instancesDiffer) ++_instancesWritten;
    if (_linkRows.size() != linkRows) _linkBuffer = GlBuffer(_links);
    return true;
}

} // namespace patina
