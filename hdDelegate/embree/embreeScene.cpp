#include "hdDelegate/embree/embreeScene.h"

#include "hdDelegate/embree/cameraRays.h"
#include "hdDelegate/embree/drawnPrims.h"
#include "hdDelegate/parallel.h"
#include "materialNetwork/material.h"

#include <algorithm>
#include <set>

namespace patina {

namespace {

void onEmbreeError(void* user, RTCError code, const char* text) {
    if (code != RTC_ERROR_NONE && code != RTC_ERROR_CANCELLED)
        static_cast<Diagnostics*>(user)->warn("Embree", "", text ? text : "unknown error");
}

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

} // namespace

EmbreeScene::EmbreeScene(Diagnostics& diagnostics) : _diagnostics(diagnostics) {
    _device = rtcNewDevice(nullptr);
    rtcSetDeviceErrorFunction(_device, onEmbreeError, &_diagnostics);
    rtcSetDeviceMemoryMonitorFunction(_device, onEmbreeMemory, &_embreeBytes);
}

EmbreeScene::~EmbreeScene() {
    _groups.clear();
    _surfaces.clear();
    _shapes.clear();
    rtcSetDeviceMemoryMonitorFunction(_device, nullptr, nullptr);
    rtcReleaseDevice(_device);
}

int EmbreeScene::intern(const std::string& category) {
    return _categoryIds.emplace(category, int(_categoryIds.size())).first->second;
}

std::vector<int> EmbreeScene::intern(const std::vector<std::string>& categories) {
    std::vector<int> ids;
    for (const std::string& name : categories)
        ids.push_back(intern(name));
    std::sort(ids.begin(), ids.end());
    return ids;
}

int EmbreeScene::category(const std::string& name) const {
    const auto found = _categoryIds.find(name);
    return found == _categoryIds.end() ? -1 : found->second;
}

void EmbreeScene::update(const SceneState& state, const Camera& camera, const RenderSettings& asked,
                         CompiledMaterials& materials, const std::atomic<bool>& stop,
                         const dvec3& origin) {
    RenderSettings settings = asked;
    const float open = float(camera.shutterOpen);
    const float close = settings.enableMotionBlur ? float(camera.shutterClose) : open;
    if (open != _shutterOpen || close != _shutterClose || origin != _origin) {
        _surfaces.clear();
        _nodes.clear();
    }
    _shutterOpen = open;
    _shutterClose = close;
    _origin = origin;
    _instancersOf.clear();
    _surfacesOf.clear();
    _finished.clear();
    _building.clear();
    _instanceCount = _trianglesStored = 0;

    _instancers.clear();
    for (const auto& item : state.instancers)
        if (isDrawn(*item.second, settings)) {
            _instancersOf[item.second->group].push_back(item.second);
            _instancers.push_back(item.second);
        }

    const CameraRays rays(camera, settings, origin);
    struct Work {
        std::shared_ptr<const Geometry> prim;
        CachedSurface* cached;
        float edge;
        int rank; ///< among all paths, drawn or not
        Programs displacers;
        std::optional<ShapeKey> key;
        std::shared_ptr<const SharedShape> shared = nullptr;
    };
    std::vector<Work> work;
    std::map<ShapeKey, int> uses;
    std::map<ShapeKey, const Implicit*> examples;
    std::set<std::string> meshLights;
    for (const auto& item : state.lights)
        if (item.second->type == LightType::Mesh) meshLights.insert(item.second->geometry);
    std::vector<std::shared_ptr<const Volume>> volumes;
    std::set<std::string> drawn;
    size_t primRank = 0;
    std::map<std::string, std::vector<mat4>> transformsOf;
    settings.edgeLength = planSubdivision(state, rays, settings, materials);
    for (const auto& item : state.geometry) {
        const auto& prim = item.second;
        const int rank = int(primRank++);
        if (!isDrawn(*prim, settings)) continue;
        if (prim->kind == GeometryKind::Volume) {
            volumes.push_back(std::static_pointer_cast<const Volume>(prim));
            continue;
        }
        drawn.insert(item.first);
        Programs moved = displacers(*prim, state, settings, materials);
        float edge = targetEdge(*prim, !moved.empty(), camera, rays, settings, transformsOf);
        std::optional<ShapeKey> key;
        // Prims of prototypes are shared already, and Embree may know a single level of instances.
        // Lights are made of the triangles that there are, and displacement of many.
        if (prim->kind == GeometryKind::Implicit && prim->group.empty() && moved.empty() &&
            !meshLights.count(item.first) && !glows(*prim, state, settings, materials)) {
            const Implicit& shape = static_cast<const Implicit&>(*prim);
            edge = roundEdge(shape, camera, rays);
            key = SharedShapes::keyOf(shape, edge);
            if (key) {
                ++uses[*key];
                examples[*key] = &shape;
            }
        }
        work.push_back({prim, &_surfaces[item.first], edge, rank, std::move(moved), key});
    }
    for (auto it = _surfaces.begin(); it != _surfaces.end();)
        it = drawn.count(it->first) ? std::next(it) : _surfaces.erase(it);
    for (auto it = _programs.begin(); it != _programs.end();)
        it = it->first.empty() || state.materials.count(it->first) ? std::next(it)
                                                                   : _programs.erase(it);

    _shapes.update(_device, uses, examples, _diagnostics);
    for (Work& item : work)
        if (item.key && (item.shared = _shapes.find(*item.key))) item.edge = 0.0f;
    parallelFor(size_t(0), work.size(), [&](size_t i) {
        if (stop) return;
        CachedSurface& cached = *work[i].cached;
        if (cached.prim == work[i].prim && cached.edgeLength == work[i].edge &&
            cached.displacers == work[i].displacers && cached.shared == work[i].shared &&
            cached.surface)
            return;
        updateSurface(cached, work[i].prim, work[i].edge, work[i].displacers, work[i].shared,
                      settings.interactive);
    });
    if (stop) return;

    _allOpaque = true;
    _hasMedia = false;
    for (const Work& item : work) {
        Surface& surface = *item.cached->surface;
        surface.primId = surface.prim->id >= 0 ? surface.prim->id : item.rank;
        surface.worldOrigin = vec3(origin);
        surface.categories = intern(surface.prim->categories);
        surface.materials.clear();
        surface.materials.push_back(
            makeSlot(surface, surface.prim->material, state, settings, materials));
        for (const GeomSubset& subset : surface.prim->subsets)
            surface.materials.push_back(makeSlot(
                surface, subset.material.empty() ? surface.prim->material : subset.material, state,
                settings, materials));
        for (const MaterialSlot& slot : surface.materials) {
            _allOpaque &= slot.opaque;
            _hasMedia |= slot.program->hasInterior();
        }
        _surfacesOf[surface.prim->group].push_back(item.cached->surface);
        _trianglesStored += surface.mesh.triangles.size();
    }
    _trianglesStored += _shapes.triangles();
    _world = buildGroup("", 0, settings, stop);
    if (stop) return;
    for (auto it = _groups.begin(); it != _groups.end();)
        it = _finished.count(it->first) ? std::next(it) : _groups.erase(it);
    for (auto it = _nodes.begin(); it != _nodes.end();)
        it = state.instancers.count(it->first) ? std::next(it) : _nodes.erase(it);

    RTCBounds bounds;
    rtcGetSceneBounds(_world->scene, &bounds);
    _boundsMin = vec3(bounds.lower_x, bounds.lower_y, bounds.lower_z);
    _boundsMax = vec3(bounds.upper_x, bounds.upper_y, bounds.upper_z);
    const auto volumeProgram = [&](const Volume& prim, const Network& plain) {
        if (!prim.material.empty()) {
            auto own = program(prim.material, prim.path, state, settings, materials);
            if (own->hasInterior()) return own;
            _diagnostics.warn(prim.path, "material:binding",
                              "the material is not a volume; a white one is shown");
        }
        if (!_plainVolume) _plainVolume = materials.compile(plain);
        return _plainVolume;
    };
    _volumes.update(
        volumes, volumeProgram, [&](const std::string& group) { return groupTransforms(group); },
        _shutterOpen, _origin, _diagnostics);
    if (!_volumes.empty()) {
        _boundsMin = glm::min(_boundsMin, _volumes.boundsMin());
        _boundsMax = glm::max(_boundsMax, _volumes.boundsMax());
    }
    collectEmissive();
}

void EmbreeScene::collectEmissive() {
    std::vector<std::shared_ptr<const void>> sources;
    bool inGroups = false;
    for (const auto& item : _surfaces) {
        const Surface& surface = *item.second.surface;
        if (!emits(surface)) continue;
        inGroups |= !surface.prim->group.empty();
        sources.push_back(item.second.surface);
        for (const MaterialSlot& slot : surface.materials)
            sources.push_back(slot.program);
    }
    if (inGroups) sources.insert(sources.end(), _instancers.begin(), _instancers.end());
    if (sources == _emissiveSources) return;
    _emissiveSources = std::move(sources);
    _emissive.clear();
    std::map<std::string, std::vector<mat4>> places;
    for (const auto& item : _surfaces) {
        const Surface& surface = *item.second.surface;
        if (!emits(surface)) continue;
        const std::string& group = surface.prim->group;
        if (!places.count(group)) places[group] = groupTransforms(group);
        for (const mat4& place : places[group])
            for (unsigned t = 0; t < surface.mesh.triangles.size(); ++t) {
                if (!surface.material(t).program->hasEmission()) continue;
                EmissiveTriangle triangle{&surface, t, {}, place, !group.empty()};
                for (int k = 0; k < 3; ++k)
                    triangle.vertices[k] =
                        vec3(place *
                             vec4(surface.mesh.positions[0][surface.mesh.triangles[t][k]], 1.0f));
                _emissive.push_back(triangle);
            }
    }
}

std::shared_ptr<const Surface> EmbreeScene::surfaceOf(const std::string& path) const {
    const auto found = _surfaces.find(path);
    return found == _surfaces.end() ? nullptr : found->second.surface;
}

ScenePlan EmbreeScene::plan() const {
    ScenePlan plan;
    for (const auto& item : _programs)
        plan.add(item.first, item.second.program->planned());
    plan.add(_subdivision);
    return plan;
}

std::map<const MaterialProgram*, std::string> EmbreeScene::materialNames() const {
    std::map<const MaterialProgram*, std::string> names;
    for (const auto& item : _programs)
        names[item.second.program.get()] = item.first;
    return names;
}

size_t EmbreeScene::bytes() const {
    size_t total = size_t(std::max<int64_t>(0, _embreeBytes)) + _shapes.bytes();
    for (const auto& item : _surfaces) {
        const Surface& s = *item.second.surface;
        const auto add = [&](const auto& steps) {
            for (const auto& step : steps)
                total += step.capacity() * sizeof(step[0]) * (item.second.rest ? 2 : 1);
        };
        add(s.mesh.positions);
        add(s.mesh.normals);
        add(s.curves.controlPoints);
        add(s.points.points);
        total += s.mesh.triangles.size() * sizeof(uvec3);
        for (const MeshAttribute& attribute : s.attributes())
            total += attribute.data.size() * sizeof(float);
    }
    return total;
}

} // namespace patina
