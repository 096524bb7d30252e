#include "hdDelegate/embree/embreeScene.h"

#include "hdDelegate/embree/cameraRays.h"
#include "hdDelegate/embree/drawnPrims.h"
#include "hdDelegate/scene/primCompare.h"
#include "hdDelegate/embree/surfaceSpace.h"
#include "hdDelegate/parallel.h"
#include "hdDelegate/scene/displace.h"
#include "hdDelegate/scene/splitTriangles.h"
#include "hdDelegate/scene/tessellate.h"
#include "materialNetwork/material.h"

#include <algorithm>
#include <cmath>
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

float maxScale(const mat4& m) {
    return std::max({glm::length(vec3(m[0])), glm::length(vec3(m[1])), glm::length(vec3(m[2]))});
}

bool hasInverse(const mat4& m) {
    const mat4 inverse = glm::inverse(m);
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            if (!std::isfinite(m[column][row]) || !std::isfinite(inverse[column][row]))
                return false;
    const float determinant = glm::determinant(mat3(m));
    return std::isfinite(determinant) && determinant != 0.0f;
}

} // namespace

EmbreeScene::EmbreeScene(Diagnostics& diagnostics) : _diagnostics(diagnostics) {
    _device = rtcNewDevice(nullptr);
    rtcSetDeviceErrorFunction(_device, onEmbreeError, &_diagnostics);
    rtcSetDeviceMemoryMonitorFunction(_device, onEmbreeMemory, &_embreeBytes);
}

EmbreeScene::~EmbreeScene() {
    _groups.clear();
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

std::shared_ptr<Surface> EmbreeScene::shape(const std::shared_ptr<const Geometry>& prim,
                                            float edgeLength, const Programs& displacers) const {
    auto surface = std::make_shared<Surface>();
    surface->prim = prim;
    TessellationOptions options;
    options.shutterOpen = _shutterOpen;
    options.shutterClose = _shutterClose;
    options.targetEdge = edgeLength;
    switch (prim->kind) {
    case GeometryKind::Mesh:
        surface->mesh = tessellate(static_cast<const Mesh&>(*prim), options, _diagnostics);
        break;
    case GeometryKind::Implicit:
        surface->mesh = tessellate(static_cast<const Implicit&>(*prim), options, _diagnostics);
        break;
    case GeometryKind::Curves:
        surface->shape = Surface::Shape::Curves;
        surface->curves = buildCurves(static_cast<const Curves&>(*prim), options, _diagnostics);
        break;
    case GeometryKind::Points:
        surface->shape = Surface::Shape::Points;
        surface->points = buildPoints(static_cast<const Points&>(*prim), options, _diagnostics);
        break;
    case GeometryKind::Volume: break; // no surface, see VolumeScene
    }
    if (!displacers.empty() && surface->shape == Surface::Shape::Triangles) {
        const auto transforms = resample(prim->transform, _shutterOpen, _shutterClose);
        splitTriangles(surface->mesh, edgeLength, options.triangleBudget);
        displace(surface->mesh, displacers, transforms[transforms.size() / 2]);
    }
    surface->stAttribute = surface->findAttribute("st");
    return surface;
}

void EmbreeScene::updateSurface(CachedSurface& cached, const std::shared_ptr<const Geometry>& prim,
                                float edgeLength, const Programs& displacers, bool keepRest) {
    const bool moved = cached.prim && !sameTransform(cached.prim->transform, prim->transform);
    // Displacement reads the world.
    const bool reshape = !cached.surface || cached.edgeLength != edgeLength ||
                         cached.displacers != displacers || (moved && !displacers.empty()) ||
                         !sameShape(*cached.prim, *prim);
    if (!reshape && !moved) {
        cached.prim = cached.surface->prim = prim;
        return;
    }
    std::shared_ptr<Surface> surface;
    if (reshape || !cached.rest) {
        surface = shape(prim, edgeLength, displacers);
        cached.rest = keepRest ? std::make_shared<const RestShape>(restOf(*surface)) : nullptr;
        ++_counts.tessellated;
    } else {
        surface = std::make_shared<Surface>(*cached.surface);
        surface->prim = prim;
        restore(*cached.rest, *surface);
    }
    bake(*surface, resample(prim->transform, _shutterOpen, _shutterClose));
    ++_counts.surfaces;
    cached.surface = std::move(surface);
    cached.edgeLength = edgeLength;
    cached.displacers = displacers;
    cached.prim = prim;
}

std::shared_ptr<const MaterialProgram>
EmbreeScene::program(const std::string& path, const std::string& user, const SceneState& state,
                     const RenderSettings& settings, TextureSource& textures) {
    std::shared_ptr<const MaterialPrim> prim;
    if (!path.empty() && settings.enableSceneMaterials) {
        const auto found = state.materials.find(path);
        if (found != state.materials.end())
            prim = found->second;
        else
            _diagnostics.warn(user, "material:binding",
                              "material " + path + " does not exist; displayColor is shown");
    }
    const std::string key = prim ? path : std::string();
    CachedProgram& cached = _programs[key];
    if (!cached.program || cached.prim != prim || cached.methods != settings.methods ||
        cached.tolerance != settings.tolerance) {
        cached.prim = prim;
        cached.tolerance = settings.tolerance;
        cached.methods = settings.methods;
        ++_counts.programs;
        cached.program = compileMaterial(
            prim && !prim->network.empty() ? prim->network : makeDisplayColorNetwork(), textures,
            _diagnostics, settings.methods, settings.tolerance);
    }
    return cached.program;
}

EmbreeScene::Programs EmbreeScene::displacers(const Geometry& prim, const SceneState& state,
                                              const RenderSettings& settings,
                                              TextureSource& textures) {
    if (prim.kind != GeometryKind::Mesh && prim.kind != GeometryKind::Implicit) return {};
    const auto mayDisplace = [&](const std::string& path) {
        const auto found = state.materials.find(path);
        return settings.enableSceneMaterials && found != state.materials.end() &&
               found->second->network.terminals.count("displacement") > 0;
    };
    bool any = false;
    Programs result;
    const auto add = [&](const std::string& path) {
        result.push_back(mayDisplace(path) ? program(path, prim.path, state, settings, textures)
                                           : nullptr);
        any |= result.back() && result.back()->hasDisplacement();
    };
    add(prim.material);
    for (const GeomSubset& subset : prim.subsets)
        add(subset.material.empty() ? prim.material : subset.material);
    return any ? result : Programs();
}

MaterialSlot EmbreeScene::makeSlot(const Surface& surface, const std::string& materialPath,
                                   const SceneState& state, const RenderSettings& settings,
                                   TextureSource& textures) {
    MaterialSlot slot;
    slot.program = program(materialPath, surface.prim->path, state, settings, textures);
    for (const auto& primvar : slot.program->primvars())
        slot.attributes.push_back(surface.findAttribute(primvar.name));
    slot.opaque = slot.program->isOpaqueWith(slot.attributes);
    return slot;
}

std::shared_ptr<InstancerNode> EmbreeScene::node(const std::shared_ptr<const Instancer>& prim) {
    auto result = std::make_shared<InstancerNode>();
    result->prim = prim;
    std::vector<std::vector<mat4>> sampled(prim->transforms.size());
    for (size_t i = 0; i < sampled.size(); ++i) {
        sampled[i] = resample(prim->transforms[i], _shutterOpen, _shutterClose);
        result->steps = std::max(result->steps, int(sampled[i].size()));
    }
    result->transforms.resize(sampled.size() * result->steps);
    result->targets.assign(sampled.size(), nullptr);
    for (size_t i = 0; i < sampled.size(); ++i) {
        bool usable = true;
        for (int s = 0; s < result->steps; ++s) {
            const mat4 m = transformAtStep(sampled[i], s, result->steps);
            result->transforms[i * result->steps + s] = m;
            usable &= hasInverse(m);
        }
        const int prototype = i < prim->prototypeIndices.size() ? prim->prototypeIndices[i] : -1;
        if (prototype < 0 || size_t(prototype) >= prim->prototypes.size()) {
            _diagnostics.warn(prim->path, "protoIndices",
                              "index out of range; the instance is not drawn");
            continue;
        }
        if (!usable) {
            _diagnostics.warn(prim->path, "transform",
                              "an instance has a transform without an inverse and is not drawn");
            continue;
        }
        result->targets[i] = finishedGroup(prim->prototypes[prototype]);
    }
    for (const auto& names : prim->categories)
        result->categories.push_back(intern(names));
    return result;
}

EmbreeGroup* EmbreeScene::finishedGroup(const std::string& name) const {
    return _finished.count(name) ? _groups.at(name).get() : nullptr;
}

std::shared_ptr<InstancerNode>
EmbreeScene::currentNode(const std::shared_ptr<const Instancer>& prim) {
    std::vector<uint64_t> versions;
    for (const std::string& name : prim->prototypes) {
        const EmbreeGroup* target = finishedGroup(name);
        versions.push_back(target ? target->version : 0);
    }
    std::shared_ptr<InstancerNode>& cached = _nodes[prim->path];
    if (!cached || cached->prim != prim || cached->versions != versions) {
        cached = node(prim);
        cached->versions = std::move(versions);
    }
    return cached;
}

EmbreeGroup* EmbreeScene::buildGroup(const std::string& name, int depth,
                                     const RenderSettings& settings,
                                     const std::atomic<bool>& stop) {
    if (EmbreeGroup* finished = finishedGroup(name)) return finished;
    if (depth > TraceContext::maxDepth || _building[name]) {
        _diagnostics.warn(name, "prototypes",
                          "instances are nested in themselves or deeper than 8; left out");
        return nullptr;
    }
    _building[name] = true;
    for (const auto& instancer : _instancersOf[name])
        for (const std::string& prototype : instancer->prototypes)
            buildGroup(prototype, depth + 1, settings, stop);
    if (stop) return nullptr; // versions tell the next update what this one did not reach
    std::vector<std::shared_ptr<InstancerNode>> nodes;
    for (const auto& instancer : _instancersOf[name]) {
        nodes.push_back(currentNode(instancer));
        _instanceCount += instancer->transforms.size();
    }
    auto& group = _groups[name];
    if (!group) group = std::make_unique<EmbreeGroup>();
    group->name = name;
    group->update(_device, _surfacesOf[name], nodes, settings.interactive, stop);
    if (group->changed) group->version = ++_groupVersion;
    _counts.groups += group->changed;
    _building[name] = false;
    _finished.insert(name);
    return group.get();
}

void EmbreeScene::update(const SceneState& state, const Camera& camera,
                         const RenderSettings& settings, TextureSource& textures,
                         const std::atomic<bool>& stop) {
    const float open = float(camera.shutterOpen);
    const float close = settings.enableMotionBlur ? float(camera.shutterClose) : open;
    if (open != _shutterOpen || close != _shutterClose) {
        _surfaces.clear();
        _nodes.clear();
    }
    _shutterOpen = open;
    _shutterClose = close;
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

    // The refinement that each prim needs, rounded to powers of two so that small moves of the
    // camera change nothing.
    const CameraRays rays(camera, settings);
    const vec3 eye = vec3(glm::inverse(rays.worldToCamera())[3]);
    struct Work {
        std::shared_ptr<const Geometry> prim;
        CachedSurface* cached;
        float edge;
        int rank; ///< among all paths, drawn or not
        Programs displacers;
    };
    std::vector<Work> work;
    std::vector<std::shared_ptr<const Volume>> volumes;
    std::set<std::string> drawn;
    size_t primRank = 0;
    std::map<std::string, std::vector<mat4>> transformsOf;
    for (const auto& item : state.geometry) {
        const auto& prim = item.second;
        const int rank = int(primRank++);
        if (!isDrawn(*prim, settings)) continue;
        if (prim->kind == GeometryKind::Volume) {
            volumes.push_back(std::static_pointer_cast<const Volume>(prim));
            continue;
        }
        drawn.insert(item.first);
        float edge = 0.0f;
        Programs moved = displacers(*prim, state, settings, textures);
        if ((!moved.empty() ||
             (prim->kind == GeometryKind::Mesh &&
              static_cast<const Mesh&>(*prim).scheme != SubdivisionScheme::None)) &&
            settings.edgeLength > 0.0f) {
            vec3 lower(INFINITY), upper(-INFINITY);
            if (prim->kind == GeometryKind::Implicit) {
                const Implicit& shape = static_cast<const Implicit&>(*prim);
                upper = vec3(0.5f * std::max({2.0f * shape.radius, 2.0f * shape.radiusTop,
                                              shape.height, shape.size}));
                lower = -upper;
            } else if (const Mesh& mesh = static_cast<const Mesh&>(*prim); !mesh.points.empty()) {
                for (const vec3& p : mesh.points.first())
                    if (std::isfinite(p.x + p.y + p.z)) {
                        lower = glm::min(lower, p);
                        upper = glm::max(upper, p);
                    }
            }
            auto places = transformsOf.find(prim->group);
            if (places == transformsOf.end()) {
                std::vector<mat4> list;
                gatherTransforms(prim->group, mat4(1.0f), 0, list);
                places = transformsOf.emplace(prim->group, std::move(list)).first;
            }
            for (const mat4& place : places->second) {
                const mat4 m = place * interpolate(prim->transform, 0.0f);
                const float scale = maxScale(m);
                const vec3 center = vec3(m * vec4(0.5f * (lower + upper), 1.0f));
                const float radius = 0.5f * glm::length(upper - lower) * scale;
                const float distance =
                    rays.orthographic()
                        ? 1.0f
                        : std::max(camera.clipNear, glm::length(center - eye) - radius);
                const float wanted = settings.edgeLength * rays.pixelSpread() * distance / scale;
                if (std::isfinite(wanted) && wanted > 0.0f)
                    edge = edge > 0.0f ? std::min(edge, wanted) : wanted;
            }
            if (edge > 0.0f) edge = std::exp2(std::floor(std::log2(edge)));
        }
        work.push_back({prim, &_surfaces[item.first], edge, rank, std::move(moved)});
    }
    for (auto it = _surfaces.begin(); it != _surfaces.end();)
        it = drawn.count(it->first) ? std::next(it) : _surfaces.erase(it);
    for (auto it = _programs.begin(); it != _programs.end();)
        it = it->first.empty() || state.materials.count(it->first) ? std::next(it)
                                                                   : _programs.erase(it);

    parallelFor(size_t(0), work.size(), [&](size_t i) {
        if (stop) return;
        CachedSurface& cached = *work[i].cached;
        if (cached.prim == work[i].prim && cached.edgeLength == work[i].edge &&
            cached.displacers == work[i].displacers && cached.surface)
            return;
        updateSurface(cached, work[i].prim, work[i].edge, work[i].displacers, settings.interactive);
    });
    if (stop) return;

    _allOpaque = true;
    _hasMedia = false;
    for (const Work& item : work) {
        Surface& surface = *item.cached->surface;
        surface.primId = surface.prim->id >= 0 ? surface.prim->id : item.rank;
        surface.categories = intern(surface.prim->categories);
        surface.materials.clear();
        surface.materials.push_back(
            makeSlot(surface, surface.prim->material, state, settings, textures));
        for (const GeomSubset& subset : surface.prim->subsets)
            surface.materials.push_back(makeSlot(
                surface, subset.material.empty() ? surface.prim->material : subset.material, state,
                settings, textures));
        for (const MaterialSlot& slot : surface.materials) {
            _allOpaque &= slot.opaque;
            _hasMedia |= slot.program->hasInterior();
        }
        _surfacesOf[surface.prim->group].push_back(item.cached->surface);
        _trianglesStored += surface.mesh.triangles.size();
    }
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
            auto own = program(prim.material, prim.path, state, settings, textures);
            if (own->hasInterior()) return own;
            _diagnostics.warn(prim.path, "material:binding",
                              "the material is not a volume; a white one is shown");
        }
        if (!_plainVolume) _plainVolume = compileMaterial(plain, textures, _diagnostics);
        return _plainVolume;
    };
    _volumes.update(
        volumes, volumeProgram, [&](const std::string& group) { return groupTransforms(group); },
        _shutterOpen, _diagnostics);
    if (!_volumes.empty()) {
        _boundsMin = glm::min(_boundsMin, _volumes.boundsMin());
        _boundsMax = glm::max(_boundsMax, _volumes.boundsMax());
    }
    collectEmissive();
}

void EmbreeScene::gatherTransforms(const std::string& group, const mat4& tail, int depth,
                                   std::vector<mat4>& out) const {
    if (group.empty()) {
        out.push_back(tail);
        return;
    }
    if (depth > TraceContext::maxDepth) return;
    for (const auto& item : _instancersOf)
        for (const auto& instancer : item.second)
            for (size_t i = 0; i < instancer->transforms.size(); ++i) {
                const int prototype =
                    i < instancer->prototypeIndices.size() ? instancer->prototypeIndices[i] : -1;
                if (prototype >= 0 && size_t(prototype) < instancer->prototypes.size() &&
                    instancer->prototypes[prototype] == group)
                    gatherTransforms(item.first, interpolate(instancer->transforms[i], 0.0f) * tail,
                                     depth + 1, out);
            }
}

std::vector<mat4> EmbreeScene::groupTransforms(const std::string& group) const {
    std::vector<mat4> result;
    gatherTransforms(group, mat4(1.0f), 0, result);
    return result;
}

void EmbreeScene::collectEmissive() {
    std::vector<std::shared_ptr<const void>> sources;
    bool inGroups = false;
    for (const auto& item : _surfaces) {
        const Surface& surface = *item.second.surface;
        const bool emits = std::any_of(surface.materials.begin(), surface.materials.end(),
                                       [](const auto& m) { return m.program->hasEmission(); });
        if (!emits || surface.shape != Surface::Shape::Triangles) continue;
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
        const bool emits = std::any_of(surface.materials.begin(), surface.materials.end(),
                                       [](const auto& m) { return m.program->hasEmission(); });
        if (!emits || surface.shape != Surface::Shape::Triangles) continue;
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
    return plan;
}

size_t EmbreeScene::bytes() const {
    size_t total = size_t(std::max<int64_t>(0, _embreeBytes));
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
