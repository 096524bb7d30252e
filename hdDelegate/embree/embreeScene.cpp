// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/embreeScene.h"

#include "hdDelegate/compiled/drawFilter.h"
#include "hdDelegate/embree/cameraRays.h"
#include "hdDelegate/film/aovTable.h"
#include "hdDelegate/parallel.h"
#include "hdDelegate/scene/primCompare.h"
#include "materialNetwork/material.h"

#include <algorithm>
#include <set>

namespace patina {

namespace {

bool onEmbreeMemory(void* user, ssize_t bytes, bool) {
    *static_cast<std::atomic<int64_t>*>(user) += bytes;
    return true;
}

/// Only triangles are lights.
bool emits(const Surface& surface) {
    return surface.shape == Surface::Shape::Triangles &&
           std::any_of(surface.materials.begin(), surface.materials.end(),
                       [](const auto& m) { return m.program->hasEmission(); });
}

/// @param keepsRest what is placed stands once more in the prim's own space
size_t bytesOf(const Surface& surface, bool keepsRest) {
    size_t total = trianglesOf(surface) * sizeof(uvec3);
    const auto add = [&](const auto& steps) {
        for (const auto& step : steps)
            total += step.capacity() * sizeof(step[0]) * (keepsRest ? 2 : 1);
    };
    add(surface.placed.positions);
    add(surface.placed.points);
    add(surface.placed.normals);
    add(surface.moments.positions);
    add(surface.moments.points);
    for (const MeshAttribute& attribute : surface.attributes())
        total += attribute.data.size() * sizeof(float);
    return total;
}

} // namespace

size_t trianglesOf(const Surface& surface) {
    return surface.rest ? surface.rest->mesh.triangles.size() : 0;
}

void EmbreeScene::onError(void* self, RTCError code, const char* text) {
    EmbreeScene& scene = *static_cast<EmbreeScene*>(self);
    if (code == RTC_ERROR_OUT_OF_MEMORY)
        scene._outOfMemory = true;
    else if (code != RTC_ERROR_NONE && code != RTC_ERROR_CANCELLED)
        scene._diagnostics.warn("Embree", "",
                                text ? messages::embreeError(text) : messages::embreeSilent());
}

EmbreeScene::EmbreeScene(CompiledScene& compiled)
    : _compiled(compiled), _diagnostics(compiled.scene()->diagnostics()) {
    _device = rtcNewDevice(nullptr);
    rtcSetDeviceErrorFunction(_device, onError, this);
    rtcSetDeviceMemoryMonitorFunction(_device, onEmbreeMemory, &_embreeBytes);
}

namespace {

bool anyHasPriority(const Placements& placements) {
    for (const auto& instancer : placements.drawn())
        for (const Marked& marks : instancer->marks)
            if (marks.dielectricPriority > 0) return true;
    return false;
}

} // namespace

EmbreeScene::~EmbreeScene() {
    _groups.clear();
    _surfaces.clear();
    _shapes.clear();
    rtcSetDeviceMemoryMonitorFunction(_device, nullptr, nullptr);
    rtcReleaseDevice(_device);
}

void EmbreeScene::update(const SceneState& state, const Camera& camera,
                         const RenderSettings& settings, const std::atomic<bool>& stop,
                         const dvec3& origin) {
    const CompiledState before = _parts;
    _parts = _compiled.compiled(state, settings);
    const bool sameView =
        _complete && origin == _origin && settings == _settings && sameCamera(camera, _camera);
    const bool sameParts = _parts.placements == before.placements && _parts.links == before.links &&
                           _parts.meshLights == before.meshLights;
    const auto edits = sameView && sameParts ? _compiled.editsSince(_version, state) : std::nullopt;
    _complete = false;
    _outOfMemory = false;
    _origin = origin;
    if (_parts.placements != before.placements) _instancesRank = anyHasPriority(*_parts.placements);
    const ScreenScale screen = screenScale(camera, settings, origin);
    View view{state, camera, settings, screen, stop, {}, nullptr};
    if (!edits || !updateTouched(view, *edits)) {
        _subdivision = _compiled.subdivision().of(state, *_parts.placements, camera, settings);
        updateAll(view);
        _lightsMayDiffer = true;
    }
    if (_outOfMemory.exchange(false)) { // Embree does not say which structures lack it
        _world = nullptr;
        _nodes.clear();
        _groups.clear();
        _surfacesOf.clear();
        _emitting.clear();
        _surfaces.clear();
        _shapes.clear();
        throw std::bad_alloc();
    }
    _ranksMedia = _instancesRank || _withPriority > 0;
    _complete = !stop;
    _version = state.version;
    _camera = camera;
    _settings = settings;
}

EmbreeScene::Work EmbreeScene::workOf(const std::shared_ptr<const Geometry>& prim,
                                      CachedSurface& cached, int rank, View& view) {
    Work work{prim, &cached, 0.0f, rank, displacers(*prim, view), std::nullopt};
    const bool displaced = !work.displacers.empty();
    work.edge = targetEdge(cached, prim, displaced, view);
    // Prims of prototypes are shared already, and Embree may know a single level of instances.
    // Lights are made of the triangles that there are, and displacement of many.
    if (prim->kind == GeometryKind::Implicit && prim->group.empty() && !displaced &&
        !_parts.meshLights->names(prim->path) && !glows(*prim, view)) {
        const Implicit& shape = static_cast<const Implicit&>(*prim);
        work.edge = roundEdge(shape, view);
        work.key = SharedShapes::keyOf(shape, work.edge);
    }
    return work;
}

void EmbreeScene::updateSurfaces(std::vector<Work>& work, const View& view) {
    for (Work& item : work)
        if (item.key && (item.shared = _shapes.find(*item.key))) item.edge = 0.0f;
    parallelFor(size_t(0), work.size(), [&](size_t i) {
        if (view.stop) return;
        const CachedSurface& cached = *work[i].cached;
        if (cached.prim == work[i].prim && cached.edgeLength == work[i].edge &&
            cached.displacers == work[i].displacers && cached.shared == work[i].shared &&
            cached.surface)
            return;
        updateSurface(work[i], view.settings.interactive);
    });
    if (view.stop) return;
    for (const Work& item : work) {
        item.cached->rank = item.rank;
        item.cached->key = item.key;
    }
}

void EmbreeScene::describe(CachedSurface& cached, const View& view) {
    Surface& surface = *cached.surface;
    const Geometry& prim = *surface.prim;
    surface.primId = prim.id >= 0 ? prim.id : cached.rank;
    surface.worldOrigin = vec3(_origin);
    surface.categories = _parts.links->of(prim.categories);
    surface.materials.clear();
    surface.materials.push_back(makeSlot(surface, prim.material, view));
    for (const GeomSubset& subset : prim.subsets)
        surface.materials.push_back(
            makeSlot(surface, subset.material.empty() ? prim.material : subset.material, view));
    cached.opaque = true;
    cached.hasMedia = false;
    cached.hasPriority = prim.dielectricPriority > 0;
    for (const MaterialSlot& slot : surface.materials) {
        cached.opaque &= slot.opaque;
        cached.hasMedia |= slot.program->hasInterior();
    }
    cached.emits = emits(surface);
    if (cached.emits)
        _emitting[prim.path] = &cached;
    else
        _emitting.erase(prim.path);
    cached.bytes = bytesOf(surface, cached.keepsRest);
    _translucent += cached.opaque ? 0 : 1;
    _withMedia += cached.hasMedia ? 1 : 0;
    _withPriority += cached.hasPriority ? 1 : 0;
    _surfaceBytes += cached.bytes;
    _trianglesStored += trianglesOf(surface);
}

void EmbreeScene::updateAll(View& view) {
    const SceneState& state = view.state;
    const vec2 shutter = shutterOf(view.camera, view.settings);
    const bool withMoments = tellMotion(view.settings.aovs);
    if (shutter != vec2(_shutterOpen, _shutterClose) || _origin != _builtFrom ||
        withMoments != _withMoments) {
        _surfaces.clear();
        _nodes.clear();
    }
    _shutterOpen = shutter.x;
    _shutterClose = shutter.y;
    _withMoments = withMoments;
    _builtFrom = _origin;
    _surfacesOf.clear();
    _emitting.clear();
    _finished.clear();
    _building.clear();
    _instanceCount = _trianglesStored = _translucent = _withMedia = _surfaceBytes = 0;
    _counts.looked += state.geometry.size();

    std::vector<Work> work;
    std::map<ShapeKey, int> uses;
    std::map<ShapeKey, const Implicit*> examples;
    std::vector<std::shared_ptr<const Volume>> volumes;
    std::set<std::string> drawn;
    int rank = 0;
    for (const auto& item : state.geometry) {
        const auto& prim = item.second;
        const int own = rank++;
        if (!isDrawn(*prim, view.settings)) continue;
        if (prim->kind == GeometryKind::Volume) {
            volumes.push_back(std::static_pointer_cast<const Volume>(prim));
            continue;
        }
        drawn.insert(item.first);
        work.push_back(workOf(prim, _surfaces[item.first], own, view));
        if (const auto& key = work.back().key) {
            ++uses[*key];
            examples[*key] = static_cast<const Implicit*>(prim.get());
        }
    }
    for (auto it = _surfaces.begin(); it != _surfaces.end();)
        it = drawn.count(it->first) ? std::next(it) : _surfaces.erase(it);
    for (auto it = _programs.begin(); it != _programs.end();)
        it = it->first.empty() || state.materials.count(it->first) ? std::next(it)
                                                                   : _programs.erase(it);

    _shapes.update(_device, uses, examples, _diagnostics);
    updateSurfaces(work, view);
    if (view.stop) return;
    for (const Work& item : work) {
        describe(*item.cached, view);
        auto& members = _surfacesOf[item.prim->group];
        item.cached->member = members.size();
        members.push_back(item.cached->surface);
    }
    _trianglesStored += _shapes.triangles();
    for (auto& item : _nodes) // light links may have other numbers
        for (size_t i = 0; i < item.second->categories.size(); ++i)
            item.second->categories[i] = _parts.links->of(item.second->prim->categories[i]);
    _world = buildGroup("", 0, view);
    if (view.stop) return;
    for (auto it = _groups.begin(); it != _groups.end();)
        it = _finished.count(it->first) ? std::next(it) : _groups.erase(it);
    for (auto it = _nodes.begin(); it != _nodes.end();)
        it = state.instancers.count(it->first) ? std::next(it) : _nodes.erase(it);
    for (const std::string& group : _finished)
        for (const auto& instancer : _parts.placements->in(group))
            _instanceCount += instancer->transforms.size();

    const auto mediumOf = [&](const std::shared_ptr<const Volume>& prim) {
        if (state.materials.count(prim->material)) program(prim->material, prim->path, view);
        return _compiled.volumes().medium(prim, state, view.settings);
    };
    _volumes.update(
        volumes, mediumOf, [&](const std::string& group) { return groupTransforms(group); },
        _shutterOpen, _origin, _diagnostics);
    takeBounds();
    collectEmissive();
}

void EmbreeScene::takeBounds() {
    RTCBounds bounds;
    rtcGetSceneBounds(_world->scene, &bounds);
    _boundsMin = vec3(bounds.lower_x, bounds.lower_y, bounds.lower_z);
    _boundsMax = vec3(bounds.upper_x, bounds.upper_y, bounds.upper_z);
    if (_volumes.empty()) return;
    _boundsMin = glm::min(_boundsMin, _volumes.boundsMin());
    _boundsMax = glm::max(_boundsMax, _volumes.boundsMax());
}

void EmbreeScene::collectEmissive() {
    _counts.looked += _emitting.size();
    _emissive.clear();
    _emissiveSources.clear();
    bool inGroups = false;
    for (const auto& item : _emitting) {
        const auto& surface = item.second->surface;
        inGroups |= !surface->prim->group.empty();
        _emissive.push_back(surface.get());
        _emissiveSources.push_back(surface);
        for (const MaterialSlot& slot : surface->materials)
            _emissiveSources.push_back(slot.program);
    }
    const auto& instancers = _parts.placements->drawn();
    if (inGroups)
        _emissiveSources.insert(_emissiveSources.end(), instancers.begin(), instancers.end());
}

std::shared_ptr<const Surface> EmbreeScene::surfaceOf(const std::string& path) const {
    const auto found = _surfaces.find(path);
    return found == _surfaces.end() ? nullptr : found->second.surface;
}

ScenePlan EmbreeScene::plan() const {
    ScenePlan plan;
    for (const auto& item : _programs)
        plan.add(item.first, item.second->planned());
    plan.add(_subdivision.method);
    return plan;
}

std::map<const MaterialProgram*, std::string> EmbreeScene::materialNames() const {
    std::map<const MaterialProgram*, std::string> names;
    for (const auto& item : _programs)
        names[item.second.get()] = item.first;
    return names;
}

size_t EmbreeScene::bytes() const {
    return size_t(std::max<int64_t>(0, _embreeBytes)) + _shapes.bytes() + _surfaceBytes;
}

} // namespace patina
