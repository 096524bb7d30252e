// SPDX-License-Identifier: Apache-2.0
// Updates of EmbreeScene after edits of prims that stay where they are in the scene: only what the
// edits touch is looked at.

#include "hdDelegate/compiled/drawFilter.h"
#include "hdDelegate/embree/cameraRays.h"
#include "hdDelegate/embree/embreeScene.h"

#include <algorithm>

namespace patina {

namespace {

bool sameRays(const Visibility& a, const Visibility& b) {
    return a.mask() == b.mask();
}

} // namespace

void EmbreeScene::forget(const CachedSurface& cached) {
    _translucent -= cached.opaque ? 0 : 1;
    _withMedia -= cached.hasMedia ? 1 : 0;
    _withPriority -= cached.hasPriority ? 1 : 0;
    _surfaceBytes -= cached.bytes;
    _trianglesStored -= trianglesOf(*cached.surface);
}

/// @returns nothing where a prim is drawn that was not, the other way round, in another group, or
/// where what it shares with others changes
std::optional<std::vector<EmbreeScene::Work>> EmbreeScene::touchedWork(View& view,
                                                                       const SceneEdits& edits) {
    const SubdivisionPlan plan(_settings, ScreenScale());
    std::vector<Work> work;
    for (const std::string& path : edits.touched) {
        ++_counts.looked;
        const auto& prim = view.state.geometry.at(path);
        const bool draws = isDrawn(*prim, view.settings);
        const auto known = _surfaces.find(path);
        // Volumes are no surfaces: what is not drawn now may have been one.
        if (prim->kind == GeometryKind::Volume || (known == _surfaces.end() && !_volumes.empty()) ||
            draws != (known != _surfaces.end()))
            return std::nullopt;
        if (!draws) continue;
        CachedSurface& cached = known->second;
        if (cached.prim->group != prim->group) return std::nullopt;
        // How finely all subdivision surfaces are drawn depends on each of them.
        if (plan.isActive() && (subdivides(*prim) || subdivides(*cached.prim))) return std::nullopt;
        work.push_back(workOf(prim, cached, cached.rank, view));
        if (work.back().key != cached.key) return std::nullopt;
    }
    return work;
}

void EmbreeScene::rebuildGroups(const View& view) {
    const Members& changed = *view.changed;
    if (changed.size() == 1 && changed.begin()->first.empty()) {
        _world->replace(_device, changed.begin()->second, nullptr, view.stop);
        if (_world->changed) _world->version = ++_groupVersion;
        _counts.groups += _world->changed;
        return;
    }
    // Instances of what has changed are attached anew, up to the world.
    std::vector<std::string> left;
    for (const auto& item : changed)
        left.push_back(item.first);
    while (!left.empty()) {
        const std::string group = std::move(left.back());
        left.pop_back();
        if (_finished.erase(group) == 0) continue;
        for (const Placements::Use& use : _parts.placements->of(group))
            left.push_back(use.instancer->group);
    }
    _building.clear();
    if (EmbreeGroup* world = buildGroup("", 0, view)) _world = world;
}

bool EmbreeScene::updateTouched(View& view, const SceneEdits& edits) {
    const SceneDelta& delta = edits.delta;
    const bool inPlace =
        delta.instancers.empty() && onlySets(delta.geometry) &&
        std::none_of(delta.materials.begin(), delta.materials.end(),
                     [](const auto& item) { return item.second == PrimEdit::Removed; });
    if (!inPlace) return false;
    auto work = touchedWork(view, edits);
    if (!work) return false;
    _lightsMayDiffer = !delta.lights.empty();
    struct Before {
        std::shared_ptr<Surface> surface;
        Visibility visibility;
        bool emits;
    };
    std::vector<Before> before;
    for (const Work& item : *work) {
        const CachedSurface& cached = *item.cached;
        before.push_back({cached.surface, cached.surface->prim->visibility, cached.emits});
        forget(cached);
    }
    updateSurfaces(*work, view);
    if (view.stop) return true; // the next update looks at everything
    bool emissive = false;
    Members changed;
    for (size_t i = 0; i < work->size(); ++i) {
        CachedSurface& cached = *(*work)[i].cached;
        describe(cached, view);
        emissive |= before[i].emits || cached.emits;
        _lightsMayDiffer |= _parts.meshLights->names(cached.prim->path);
        if (cached.surface == before[i].surface &&
            sameRays(before[i].visibility, cached.prim->visibility))
            continue;
        _surfacesOf[cached.prim->group][cached.member] = cached.surface;
        changed[cached.prim->group].push_back(cached.surface);
    }
    if (!changed.empty()) {
        view.changed = &changed;
        rebuildGroups(view);
        if (view.stop) return true;
        takeBounds();
    }
    if (emissive) collectEmissive();
    _lightsMayDiffer |= emissive;
    return true;
}

} // namespace patina
