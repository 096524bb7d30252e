#include "hdDelegate/embree/embreeScene.h"

#include "hdDelegate/embree/cameraRays.h"
#include "hdDelegate/scene/displace.h"
#include "hdDelegate/scene/splitTriangles.h"
#include "hdDelegate/scene/tessellate.h"
#include "materialNetwork/material.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

void onEmbreeError(void* user, RTCError code, const char* text) {
    if (code != RTC_ERROR_NONE)
        static_cast<Diagnostics*>(user)->warn("Embree", "", text ? text : "unknown error");
}

/// A motion transform at uniform steps over the shutter.
std::vector<mat4> resample(const MotionTransform& transform, float open, float close) {
    size_t inside = 0;
    for (float t : transform.times)
        inside += t > open && t < close;
    const bool moves = transform.moves() && close > open;
    const int steps = moves ? int(std::min<size_t>(8, 2 + inside)) : 1;
    std::vector<mat4> result(steps);
    for (int i = 0; i < steps; ++i)
        result[i] =
            interpolate(transform, steps == 1 ? 0.0f : open + (close - open) * i / (steps - 1));
    return result;
}

/// Position of step `step` of `count` among `size` uniform samples: index and fraction.
std::pair<size_t, float> locate(int step, int count, size_t size) {
    if (size < 2 || count < 2) return {0, 0.0f};
    const float x = float(step) * float(size - 1) / float(count - 1);
    const size_t i = std::min(size_t(x), size - 2);
    return {i, x - float(i)};
}

mat4 transformAtStep(const std::vector<mat4>& transforms, int step, int count) {
    const auto [i, f] = locate(step, count, transforms.size());
    return f == 0.0f ? transforms[i] : transforms[i] * (1.0f - f) + transforms[i + 1] * f;
}

template <class T>
std::vector<T> valuesAtStep(const std::vector<std::vector<T>>& steps, int step, int count) {
    const auto [i, f] = locate(step, count, steps.size());
    if (f == 0.0f) return steps[i];
    std::vector<T> result(steps[i].size());
    for (size_t k = 0; k < result.size(); ++k)
        result[k] = steps[i][k] * (1.0f - f) + steps[i + 1][k] * f;
    return result;
}

float maxScale(const mat4& m) {
    return std::max({glm::length(vec3(m[0])), glm::length(vec3(m[1])), glm::length(vec3(m[2]))});
}

/// Moves positions and normals into the group's space, at every time step.
void bake(Surface& surface, const std::vector<mat4>& transforms) {
    const auto bakePositions = [&](auto& steps, const auto& apply) {
        if (steps.empty()) return;
        const int count = int(std::max(steps.size(), transforms.size()));
        std::remove_reference_t<decltype(steps)> result(count);
        for (int s = 0; s < count; ++s) {
            result[s] = valuesAtStep(steps, s, count);
            const mat4 m = transformAtStep(transforms, s, count);
            for (auto& value : result[s])
                value = apply(m, value);
            result[s].reserve(result[s].size() + 1); // Embree reads 16 bytes of the last element
        }
        steps = std::move(result);
    };
    const auto point = [](const mat4& m, const vec3& p) { return vec3(m * vec4(p, 1.0f)); };
    const auto sphere = [](const mat4& m, const vec4& p) {
        const float scale = std::cbrt(std::abs(glm::determinant(mat3(m))));
        return vec4(vec3(m * vec4(vec3(p), 1.0f)), p.w * scale);
    };
    const auto normal = [](const mat4& m, const vec3& n) {
        const vec3 t = glm::transpose(glm::inverse(mat3(m))) * n;
        const float length = glm::length(t);
        return length > 0.0f ? t / length : vec3(0, 0, 1);
    };
    bakePositions(surface.mesh.positions, point);
    bakePositions(surface.mesh.normals, normal);
    bakePositions(surface.curves.controlPoints, sphere);
    bakePositions(surface.curves.normals, normal);
    bakePositions(surface.points.points, sphere);
    bakePositions(surface.points.normals, normal);
    surface.flipNormals = glm::determinant(mat3(transforms[0])) < 0.0f;
    surface.groupToObject = glm::inverse(transforms[transforms.size() / 2]);
}

} // namespace

EmbreeScene::EmbreeScene(Diagnostics& diagnostics) : _diagnostics(diagnostics) {
    _device = rtcNewDevice(nullptr);
    rtcSetDeviceErrorFunction(_device, onEmbreeError, &_diagnostics);
}

EmbreeScene::~EmbreeScene() {
    _groups.clear();
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
    const auto transforms = resample(prim->transform, _shutterOpen, _shutterClose);
    if (!displacers.empty() && surface->shape == Surface::Shape::Triangles) {
        splitTriangles(surface->mesh, edgeLength, options.triangleBudget);
        displace(surface->mesh, displacers, transforms[transforms.size() / 2]);
    }
    bake(*surface, transforms);
    surface->stAttribute = surface->findAttribute("st");
    return surface;
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
    if (!cached.program || cached.prim != prim || cached.methods != settings.methods) {
        cached.prim = prim;
        cached.methods = settings.methods;
        cached.program = compileMaterial(prim && !prim->network.empty() ? prim->network
                                                                        : makeDisplayColorNetwork(),
                                         textures, _diagnostics, settings.methods);
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
            const float determinant = glm::determinant(mat3(m));
            usable &= std::isfinite(determinant) && determinant != 0.0f;
        }
        const int prototype = i < prim->prototypeIndices.size() ? prim->prototypeIndices[i] : -1;
        if (prototype < 0 || size_t(prototype) >= prim->prototypes.size()) {
            _diagnostics.warn(prim->path, "protoIndices",
                              "index out of range; the instance is not drawn");
            continue;
        }
        if (!usable) {
            _diagnostics.warn(prim->path, "transform",
                              "an instance has a singular transform and is not drawn");
            continue;
        }
        const auto target = _groups.find(prim->prototypes[prototype]);
        result->targets[i] = target == _groups.end() ? nullptr : target->second.get();
    }
    for (const auto& names : prim->categories)
        result->categories.push_back(intern(names));
    return result;
}

EmbreeGroup* EmbreeScene::buildGroup(const std::string& name, int depth) {
    if (_groups.count(name)) return _groups[name].get();
    if (depth > TraceContext::maxDepth || _building[name]) {
        _diagnostics.warn(name, "prototypes",
                          "instances are nested in themselves or deeper than 8; left out");
        return nullptr;
    }
    _building[name] = true;
    for (const auto& instancer : _instancersOf[name])
        for (const std::string& prototype : instancer->prototypes)
            buildGroup(prototype, depth + 1);
    auto group = std::make_unique<EmbreeGroup>();
    group->name = name;
    group->surfaces = _surfacesOf[name];
    for (const auto& instancer : _instancersOf[name]) {
        group->nodes.push_back(node(instancer));
        _instanceCount += instancer->transforms.size();
    }
    group->build(_device);
    _building[name] = false;
    return (_groups[name] = std::move(group)).get();
}

void EmbreeScene::update(const SceneState& state, const Camera& camera,
                         const RenderSettings& settings, TextureSource& textures,
                         const std::atomic<bool>& stop) {
    const float open = float(camera.shutterOpen);
    const float close = settings.enableMotionBlur ? float(camera.shutterClose) : open;
    if (open != _shutterOpen || close != _shutterClose) _surfaces.clear();
    _shutterOpen = open;
    _shutterClose = close;
    _categoryIds.clear();
    _instancersOf.clear();
    _surfacesOf.clear();
    _groups.clear();
    _building.clear();
    _instanceCount = _trianglesStored = 0;

    for (const auto& item : state.instancers)
        _instancersOf[item.second->group].push_back(item.second);

    // The refinement that each prim needs, rounded to powers of two so that small moves of the
    // camera change nothing.
    const CameraRays rays(camera, settings);
    const vec3 eye = vec3(glm::inverse(rays.worldToCamera())[3]);
    struct Work {
        std::shared_ptr<const Geometry> prim;
        CachedSurface* cached;
        float edge;
        Programs displacers;
    };
    std::vector<Work> work;
    std::vector<std::shared_ptr<const Volume>> volumes;
    std::map<std::string, std::vector<mat4>> transformsOf;
    for (const auto& item : state.geometry) {
        const auto& prim = item.second;
        if (prim->kind == GeometryKind::Volume) {
            volumes.push_back(std::static_pointer_cast<const Volume>(prim));
            continue;
        }
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
        work.push_back({prim, &_surfaces[item.first], edge, std::move(moved)});
    }
    for (auto it = _surfaces.begin(); it != _surfaces.end();)
        it = state.geometry.count(it->first) ? std::next(it) : _surfaces.erase(it);
    for (auto it = _programs.begin(); it != _programs.end();)
        it = it->first.empty() || state.materials.count(it->first) ? std::next(it)
                                                                   : _programs.erase(it);

    tbb::parallel_for(size_t(0), work.size(), [&](size_t i) {
        if (stop) return;
        CachedSurface& cached = *work[i].cached;
        if (cached.prim == work[i].prim && cached.edgeLength == work[i].edge &&
            cached.displacers == work[i].displacers && cached.surface)
            return;
        cached = {work[i].prim, work[i].edge, work[i].displacers,
                  shape(work[i].prim, work[i].edge, work[i].displacers)};
    });
    if (stop) return;

    _allOpaque = true;
    _hasMedia = false;
    int primId = 0;
    for (const Work& item : work) {
        Surface& surface = *item.cached->surface;
        surface.primId = primId++;
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
    _world = buildGroup("", 0);

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

const Surface* EmbreeScene::surfaceOf(const std::string& path) const {
    const auto found = _surfaces.find(path);
    return found == _surfaces.end() ? nullptr : found->second.surface.get();
}

bool EmbreeScene::finishHit(const RTCRayHit& rayHit, const TraceContext& context, Hit& hit) const {
    if (rayHit.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
    hit.time = rayHit.ray.time;
    hit.primitive = rayHit.hit.primID;
    hit.u = rayHit.hit.u;
    hit.v = rayHit.hit.v;
    hit.distance = rayHit.ray.tfar;
    hit.groupNormal = vec3(rayHit.hit.Ng_x, rayHit.hit.Ng_y, rayHit.hit.Ng_z);
    hit.instanced = false;
    hit.groupToWorld = mat4(1.0f);
    hit.instanceId = -1;
    hit.instanceCategories = nullptr;

    const EmbreeGroup* group = _world;
    unsigned native = rayHit.hit.instID[0];
    const auto enter = [&](const InstancerNode& node, int instance) {
        hit.instanced = true;
        hit.groupToWorld = hit.groupToWorld * node.transformAt(instance, hit.time);
        hit.instanceId = node.id(instance);
        if (size_t(instance) < node.categories.size())
            hit.instanceCategories = &node.categories[instance];
    };
    if (native == throughUserGeometry) {
        for (int i = 0; i < context.hitDepth; ++i)
            enter(*context.hitChain[i].record->node, context.hitChain[i].instance);
        group = context.hitGroup;
        native = context.hitNative;
    }
    if (native != RTC_INVALID_GEOMETRY_ID) {
        const GroupRecord& record = *group->records[native];
        enter(*record.node, record.instance);
        group = record.node->targets[record.instance];
    }
    hit.surface = group->records[rayHit.hit.geomID]->surface;
    return hit.surface != nullptr;
}

bool EmbreeScene::intersect(const vec3& origin, const vec3& direction, float near, float far,
                            float time, unsigned mask, Hit& hit) const {
    TraceContext context;
    initContext(&context.base);
    context.group = _world;
    RTCRayHit rayHit;
    rayHit.ray = {origin.x,    origin.y, origin.z, near, direction.x, direction.y,
                  direction.z, time,     far,      mask, 0,           0};
    rayHit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rayHit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    embreeIntersect(_world->scene, &context.base, &rayHit);
    return finishHit(rayHit, context, hit);
}

bool EmbreeScene::occluded(const vec3& origin, const vec3& direction, float near, float far,
                           float time, unsigned mask) const {
    TraceContext context;
    initContext(&context.base);
    context.group = _world;
    RTCRay ray = {origin.x,    origin.y, origin.z, near, direction.x, direction.y,
                  direction.z, time,     far,      mask, 0,           0};
    embreeOccluded(_world->scene, &context.base, &ray);
    return ray.tfar < 0.0f;
}

} // namespace patina
