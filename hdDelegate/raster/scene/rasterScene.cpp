#include "hdDelegate/raster/scene/rasterScene.h"

#include "hdDelegate/scene/instancerCheck.h"
#include "hdDelegate/scene/lightUnits.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>

namespace patina {

namespace {

float areaOf(const TriangleMesh& mesh, const mat4& toWorld) {
    double area = 0.0;
    for (const uvec3& t : mesh.triangles) {
        vec3 p[3];
        for (int k = 0; k < 3; ++k)
            p[k] = vec3(toWorld * vec4(mesh.positions[0][t[k]], 1.0f));
        area += 0.5 * glm::length(glm::cross(p[1] - p[0], p[2] - p[0]));
    }
    return float(area);
}

constexpr size_t maxUnsortedPlaces = 32; // are drawn in the order that they have

bool deforms(const Geometry& prim) {
    switch (prim.kind) {
    case GeometryKind::Mesh: return static_cast<const Mesh&>(prim).points.moves();
    case GeometryKind::Curves: return static_cast<const Curves&>(prim).points.moves();
    case GeometryKind::Points: return static_cast<const Points&>(prim).points.moves();
    default: return false;
    }
}

} // namespace

void RasterScene::collectCategories(const SceneState& state) {
    _categories.clear();
    for (const auto& item : state.lights)
        for (const std::string& link : {item.second->lightLink, item.second->shadowLink})
            if (!link.empty()) _categories.emplace(link, int(_categories.size()));
    _links = {(int(_categories.size()) + 31) / 32};
    _linkRows.clear();
}

void RasterScene::collectMeshLights(const SceneState& state, const RenderSettings& settings) {
    _meshLights.clear();
    for (const auto& item : state.lights)
        if (item.second->type == LightType::Mesh && item.second->visible &&
            settings.enableSceneLights)
            _meshLights[item.second->geometry] = item.second;
}

/// @returns the row of bits of a prim in a place
int RasterScene::linksOf(const std::vector<std::string>& prim,
                         const std::vector<std::string>& place) {
    std::vector<int> row(size_t(_links[0]), 0);
    for (const auto* names : {&prim, &place})
        for (const std::string& name : *names) {
            const auto found = _categories.find(name);
            if (found != _categories.end())
                row[size_t(found->second / 32)] |= int(1u << (found->second % 32));
        }
    const auto known = _linkRows.emplace(row, int(_linkRows.size()));
    if (known.second) _links.insert(_links.end(), row.begin(), row.end());
    return known.first->second;
}

void RasterScene::GpuInstance::place(const mat4& toWorld) {
    const mat3 linear(toWorld), forNormals = glm::transpose(glm::inverse(linear));
    for (int i = 0; i < 4; ++i)
        columns[i] = vec4(vec3(toWorld[i]), 0.0f);
    for (int i = 0; i < 3; ++i)
        normals[i] = vec4(forNormals[i], 0.0f);
    columns[0].w = std::cbrt(std::fabs(glm::determinant(linear)));
}

void RasterScene::addGroup(RasterGroup group, const std::vector<RasterPlace>& places,
                           const dmat4& toGroup) {
    if (group.places.size() > maxUnsortedPlaces) {
        std::vector<vec3> centers;
        for (const uint32_t i : group.places)
            centers.emplace_back(places[i].groupToWorld[3]);
        std::vector<uint32_t> ordered;
        for (const uint32_t i : mortonOrder(centers))
            ordered.push_back(group.places[i]);
        group.places = std::move(ordered);
    }
    group.firstInstance = int(_instances.size());
    for (const uint32_t i : group.places) {
        GpuInstance instance;
        const mat4 toWorld(places[i].groupToWorld * toGroup);
        instance.place(toWorld);
        instance.ids[0] = places[i].id;
        instance.ids[1] = linksOf(group.prim->categories, places[i].categories);
        _instances.push_back(instance);
        const RasterBox box =
            RasterBox::around(group.shape->boundsMin, group.shape->boundsMax, toWorld);
        _boundsMin = glm::min(_boundsMin, box.center - box.half);
        _boundsMax = glm::max(_boundsMax, box.center + box.half);
        _boxes.push_back(box);
    }
    _groups.push_back(std::move(group));
}

void RasterScene::addPrim(const std::shared_ptr<const Geometry>& prim, int rank,
                          const SceneState& state, const RasterCamera& camera,
                          const RenderSettings& settings, RasterInstances& places) {
    const auto& where = places.places(prim->group);
    if (where.empty()) return;
    std::vector<const RasterMaterial*> materials = {
        &_materials.get(prim->material, prim->path, state, settings)};
    for (const GeomSubset& subset : prim->subsets)
        materials.push_back(
            &_materials.get(subset.material.empty() ? prim->material : subset.material, prim->path,
                            state, settings));
    const dmat4 toGroup = exactTransformAt(prim->transform, camera.timeCode(0.5f));
    RasterShapeCache::Request request;
    request.prim = prim;
    request.timeCode = camera.timeCode(0.5f);
    request.toWorld = mat4(where[0].groupToWorld * toGroup);
    request.toWorld[3] += vec4(_origin, 0.0f);
    request.needsMesh = _meshLights.count(prim->path) != 0;
    for (const RasterMaterial* material : materials) {
        const MaterialProgram& program = *material->program;
        request.primvars.push_back(material->primvars);
        const bool bends = program.hasDisplacement() && (prim->kind == GeometryKind::Mesh ||
                                                         prim->kind == GeometryKind::Implicit);
        request.displacers.push_back(bends ? material->program : nullptr);
        request.needsMesh |= settings.enableSceneLights && program.hasEmission();
    }
    request.strips = !request.needsMesh;
    // Places that are equally far away share a tessellation.
    const bool displaced =
        std::any_of(request.displacers.begin(), request.displacers.end(),
                    [](const std::shared_ptr<const MaterialProgram>& p) { return p != nullptr; });
    auto& [measured, extent] = _extents[prim->path];
    if (measured != prim) {
        measured = prim;
        extent = RasterExtent(*prim);
    }
    RenderSettings fine = settings;
    // Displacement shows more of itself on shorter edges, which no row of the table is of.
    if (displaced && !_subdivision.forced && !_subdivision.point.empty())
        fine.edgeLength = std::min(fine.edgeLength, SubdivisionPlan::standardEdge);
    const RasterDetail detail(extent, prim->transform, camera, fine, displaced, request.needsMesh);
    std::map<float, std::vector<uint32_t>> byEdge;
    for (size_t i = 0; i < where.size(); ++i)
        byEdge[detail.edgeAt(where[i])].push_back(uint32_t(i));
    const size_t firstGroup = _groups.size();
    for (auto& [edge, list] : byEdge) {
        request.edge = edge;
        request.edgeBudget = detail.trianglesFor(edge);
        RasterGroup group;
        group.prim = prim;
        group.shape = _shapes.get(request);
        if (deforms(*prim) && _shutterClose > _shutterOpen) {
            auto still = std::make_shared<RasterShapeCache::Request>(request);
            still->needsMesh = false; // lights stay where they are in the middle of the shutter
            group.deforms = std::move(still);
            _moves = true;
        }
        group.places = std::move(list);
        if (group.shape->triangles > 0) addGroup(std::move(group), where, toGroup);
    }
    _moves |= prim->transform.moves();
    addDraws(prim, rank, materials, firstGroup, where, toGroup, settings);
}

void RasterScene::addDraws(const std::shared_ptr<const Geometry>& prim, int rank,
                           const std::vector<const RasterMaterial*>& materials, size_t firstGroup,
                           const std::vector<RasterPlace>& places, const dmat4& toGroup,
                           const RenderSettings& settings) {
    if (firstGroup == _groups.size()) return;
    RasterDraw draw;
    draw.prim = prim;
    draw.primId = prim->id >= 0 ? prim->id : rank;
    int lit = -1;
    const auto meshLight = _meshLights.find(prim->path);
    if (meshLight != _meshLights.end()) {
        const Light& light = *meshLight->second;
        draw.meshLight.radiance = glm::max(lightBaseRadiance(light), vec3(0.0f));
        draw.meshLight.mode =
            light.materialSyncMode == "noMaterialResponse"       ? RasterMeshLight::Alone
            : light.materialSyncMode == "materialGlowTintsLight" ? RasterMeshLight::Tints
                                                                 : RasterMeshLight::Adds;
        if (light.normalize)
            draw.meshLight.radiance /= std::max(
                areaOf(*_groups[firstGroup].shape->mesh, mat4(places[0].groupToWorld * toGroup)),
                1e-30f);
        const auto category = _categories.find(light.lightLink);
        if (category != _categories.end()) lit = category->second;
    }
    for (size_t g = firstGroup; g < _groups.size(); ++g) {
        const RasterGroup& group = _groups[g];
        draw.group = int(g);
        draw.flags = group.shape->flags;
        for (size_t subset = 0; subset < materials.size(); ++subset) {
            draw.material = materials[subset];
            if (!draw.material->programs) continue;
            if (settings.enableSceneLights && group.shape->mesh)
                for (const uint32_t i : group.places)
                    _emitters.add(group.shape->mesh, subset, draw.material->program, draw.meshLight,
                                  mat4(places[i].groupToWorld * toGroup), lit,
                                  (draw.flags & RasterShape::tube) != 0, _origin);
            draw.subset = int(subset);
            draw.show(*group.shape);
            if (draw.surface->triangles == 0) continue;
            _triangles += draw.surface->triangles;
            _draws.push_back(draw);
        }
    }
}

float RasterScene::planSubdivision(const SceneState& state, const RasterCamera& camera,
                                   const RenderSettings& settings, RasterInstances& places) {
    const RasterView view = camera.view(vec2(0.0f), vec2(0.0f), 0.5f, vec3(-1.0f), vec3(1.0f));
    const ScreenScale screen{view.eye, view.perspective, view.pixelSpread, camera.camera().clipNear,
                             double(settings.width) * settings.height};
    SubdivisionPlan plan(settings, screen);
    for (const auto& item : state.geometry) {
        const Geometry& prim = *item.second;
        if (!plan.isActive() || !subdivides(prim) || !isDrawnInRaster(prim, settings)) continue;
        const dmat4 toGroup = exactTransformAt(prim.transform, camera.timeCode(0.5f));
        std::vector<mat4> toWorld;
        for (const RasterPlace& place : places.places(prim.group))
            toWorld.push_back(mat4(place.groupToWorld * toGroup));
        plan.add(CageSize(static_cast<const Mesh&>(prim)), toWorld,
                 _materials.planned(prim.material, prim.path, state, settings));
    }
    _subdivision = plan.chosen();
    return plan.edgeLength();
}

/// Asks for all programs before the first is waited for.
void RasterScene::prepareMaterials(const SceneState& state, const RenderSettings& settings,
                                   RasterInstances& places) {
    for (const auto& item : state.geometry) {
        const Geometry& prim = *item.second;
        if (prim.kind == GeometryKind::Volume || !isDrawnInRaster(prim, settings) ||
            places.places(prim.group).empty())
            continue;
        _materials.prepare(prim.material, state, settings);
        for (const GeomSubset& subset : prim.subsets)
            if (!subset.material.empty()) _materials.prepare(subset.material, state, settings);
    }
}

void RasterScene::update(const SceneState& state, const vec3& origin, const RasterCamera& camera,
                         const RenderSettings& asked, const RasterLightPlan& lights,
                         const std::atomic<bool>& stop,
                         const std::function<void(const RasterMaterials::Ready&)>& compiling) {
    RenderSettings settings = asked;
    _draws.clear();
    _groups.clear();
    _instances.clear();
    _boxes.clear();
    _triangles = 0;
    _moves = false;
    _origin = origin;
    _shutterOpen = camera.timeCode(0.0f);
    _shutterClose = camera.timeCode(1.0f);
    _boundsMin = vec3(INFINITY);
    _boundsMax = vec3(-INFINITY);
    _materials.update(state, settings, lights);
    collectCategories(state);
    collectMeshLights(state, settings);
    _emitters.clear();
    _volumes.begin();
    RasterInstances places(state, settings, camera.timeCode(0.5f), origin);
    settings.edgeLength = planSubdivision(state, camera, settings, places);
    prepareMaterials(state, settings, places);
    _materials.showStandIns(!compiling);
    if (compiling) _materials.finish(stop, compiling);
    for (const auto& item : state.instancers) {
        warnOfInstancePrimvars(*item.second, _diagnostics);
        warnOfInstances(*item.second, camera.timeCode(0.5f), _diagnostics);
        for (const MotionTransform& transform : item.second->transforms)
            _moves |= transform.moves();
    }
    int rank = 0;
    for (const auto& item : state.geometry) {
        if (stop) return;
        const int own = rank++;
        if (!isDrawnInRaster(*item.second, settings)) continue;
        if (item.second->kind == GeometryKind::Volume) {
            const auto volume = std::static_pointer_cast<const Volume>(item.second);
            const dmat4 toGroup = exactTransformAt(volume->transform, camera.timeCode(0.0f));
            std::vector<mat4> toWorld;
            for (const RasterPlace& place : places.places(volume->group))
                toWorld.push_back(mat4(place.groupToWorld * toGroup));
            _volumes.add(volume, state, settings, toWorld, _boundsMin, _boundsMax);
            continue;
        }
        addPrim(item.second, own, state, camera, settings, places);
    }
    _shapes.forgetUnused();
    for (auto it = _extents.begin(); it != _extents.end();)
        it = state.geometry.count(it->first) ? std::next(it) : _extents.erase(it);
    _volumes.end();
    if (_draws.empty() && _volumes.placed().empty()) _boundsMin = _boundsMax = vec3(0.0f);
    _linkBuffer = GlBuffer(_links);
    upload();
}

/// Writes the instances unless the buffer holds them.
void RasterScene::upload() {
    const size_t size = _instances.size() * sizeof(GpuInstance);
    if (_instances.size() == _written.size() && _instanceBuffer.id() &&
        (size == 0 || std::memcmp(_instances.data(), _written.data(), size) == 0))
        return;
    if (_instanceBuffer.size() < size || !_instanceBuffer.id())
        _instanceBuffer = GlBuffer(_instances);
    else
        _instanceBuffer.write(_instances.data(), size);
    _written = _instances;
    ++_instancesWritten;
}

/// Shapes of every step are kept between passes.
void RasterScene::deform(float timeCode) {
    const float length = _shutterClose - _shutterOpen;
    if (!(length > 0.0f)) return;
    const float at = (timeCode - _shutterOpen) / length * float(deformationSteps);
    const float step = std::clamp(std::floor(at), 0.0f, float(deformationSteps - 1));
    const float time = _shutterOpen + (step + 0.5f) / float(deformationSteps) * length;
    for (RasterGroup& group : _groups) {
        if (!group.deforms) continue;
        RasterShapeCache::Request request = *group.deforms;
        request.timeCode = time;
        const auto shape = _shapes.get(request);
        if (shape->surfaces.size() == group.shape->surfaces.size() &&
            shape->flags == group.shape->flags)
            group.shape = shape;
    }
    for (RasterDraw& draw : _draws) {
        const RasterGroup& group = _groups[size_t(draw.group)];
        if (group.deforms) draw.show(*group.shape);
    }
}

bool RasterScene::moveTo(const SceneState& state, const RenderSettings& settings, float timeCode) {
    if (!_moves) return false;
    deform(timeCode);
    RasterInstances places(state, settings, timeCode, _origin);
    for (const RasterGroup& group : _groups) {
        const auto& where = places.places(group.prim->group);
        const dmat4 toGroup = exactTransformAt(group.prim->transform, timeCode);
        for (size_t i = 0; i < group.places.size(); ++i) {
            if (group.places[i] >= where.size()) continue;
            const mat4 toWorld(where[group.places[i]].groupToWorld * toGroup);
            const size_t at = size_t(group.firstInstance) + i;
            _instances[at].place(toWorld);
            _boxes[at] = RasterBox::around(group.shape->boundsMin, group.shape->boundsMax, toWorld);
        }
    }
    upload();
    return true;
}

RasterVisible RasterScene::visible(const mat4& worldToClip, bool clampsNear) const {
    const RasterFrustum frustum(worldToClip, clampsNear);
    RasterVisible found;
    for (const RasterGroup& group : _groups) {
        const size_t before = found.runs.size();
        // A call costs about as much as so many triangles.
        const int gap = int(64 / std::max<size_t>(1, group.shape->triangles));
        visibleRuns(frustum, _boxes, group.firstInstance, int(group.places.size()), gap,
                    found.runs);
        found.group.emplace_back(before, found.runs.size());
    }
    return found;
}

ScenePlan RasterScene::plan() const {
    ScenePlan plan = _materials.plan();
    plan.add(_subdivision);
    return plan;
}

size_t RasterScene::trianglesDrawn() const {
    size_t sum = 0;
    for (const RasterDraw& d : _draws)
        sum += d.surface->triangles * _groups[size_t(d.group)].places.size();
    return sum;
}

void RasterScene::bind(GLuint vertexArray) const {
    _linkBuffer.bindStorage(9);
    gl.VertexArrayVertexBuffer(vertexArray, 1, _instanceBuffer.id(), 0, sizeof(GpuInstance));
}

void RasterScene::describe(GLuint vertexArray) {
    const auto attribute = [&](GLuint i, GLint components, GLuint offset, GLuint binding) {
        gl.EnableVertexArrayAttrib(vertexArray, i);
        gl.VertexArrayAttribFormat(vertexArray, i, components, GL_FLOAT, GL_FALSE, offset);
        gl.VertexArrayAttribBinding(vertexArray, i, binding);
    };
    attribute(0, 4, offsetof(RasterChunk::Vertex, position), 0);
    attribute(1, 3, offsetof(RasterChunk::Vertex, normal), 0);
    for (GLuint i = 0; i < 7; ++i) // columns and normals
        attribute(2 + i, 4, i * GLuint(sizeof(vec4)), 1);
    gl.EnableVertexArrayAttrib(vertexArray, 9);
    gl.VertexArrayAttribIFormat(vertexArray, 9, 4, GL_INT, 7 * sizeof(vec4));
    gl.VertexArrayAttribBinding(vertexArray, 9, 1);
    gl.VertexArrayBindingDivisor(vertexArray, 1, 1);
}

} // namespace patina
