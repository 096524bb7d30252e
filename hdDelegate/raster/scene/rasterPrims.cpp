// SPDX-License-Identifier: Apache-2.0
// RasterScene: the groups, instances and draws of one prim.

#include "hdDelegate/raster/scene/rasterScene.h"

#include "hdDelegate/film/cryptomatteHash.h"
#include "hdDelegate/geometry/mortonOrder.h"
#include "hdDelegate/scene/lightUnits.h"

#include <algorithm>
#include <cmath>

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

} // namespace

/// @returns the row of bits of a prim in a place
int RasterScene::linksOf(const std::vector<std::string>& prim,
                         const std::vector<std::string>& place) {
    std::vector<int> row(size_t(_links[0]), 0);
    for (const auto* names : {&prim, &place})
        for (const int link : _parts.links->of(*names))
            row[size_t(link / 32)] |= int(1u << (link % 32));
    const auto known = _linkRows.emplace(row, int(_linkRows.size()));
    if (known.second) _links.insert(_links.end(), row.begin(), row.end());
    return known.first->second;
}

void GpuInstance::place(const mat4& toWorld) {
    const mat3 linear(toWorld), forNormals = glm::transpose(glm::inverse(linear));
    column0 = vec4(vec3(toWorld[0]), std::cbrt(std::fabs(glm::determinant(linear))));
    column1 = vec4(vec3(toWorld[1]), 0.0f);
    column2 = vec4(vec3(toWorld[2]), 0.0f);
    column3 = vec4(vec3(toWorld[3]), 0.0f);
    normalColumn0 = vec4(forNormals[0], 0.0f);
    normalColumn1 = vec4(forNormals[1], 0.0f);
    normalColumn2 = vec4(forNormals[2], 0.0f);
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
        instance.instanceIds = {places[i].id, linksOf(group.prim->categories, places[i].categories),
                                int(_instances.size()) - group.firstInstance, int(i)};
        _instances.push_back(instance);
        const RasterBox box =
            RasterBox::around(group.shape->boundsMin, group.shape->boundsMax, toWorld);
        _boundsMin = glm::min(_boundsMin, box.center - box.half);
        _boundsMax = glm::max(_boundsMax, box.center + box.half);
        _boxes.push_back(box);
    }
    _groups.push_back(std::move(group));
}

namespace {

/// @returns the area of a mesh at a place, above zero
float areaAt(const RasterGroup& group, const RasterPlace& place, const dmat4& toGroup) {
    return std::max(areaOf(*group.shape->mesh, mat4(place.groupToWorld * toGroup)), 1e-30f);
}

} // namespace

void RasterScene::addPrim(const std::shared_ptr<const Geometry>& prim, int rank,
                          const SceneState& state, const RasterCamera& camera,
                          RasterInstances& places) {
    const auto& where = places.places(prim->group);
    if (where.empty()) return;
    Span& span = _spans[prim->path];
    span.rank = rank;
    span.firstGroup = _groups.size();
    span.firstDraw = _draws.size();
    std::vector<const RasterMaterial*> materials = {
        &_materials.get(prim->material, prim->path, state, _settings)};
    for (const GeomSubset& subset : prim->subsets)
        materials.push_back(
            &_materials.get(subset.material.empty() ? prim->material : subset.material, prim->path,
                            state, _settings));
    const dmat4 toGroup = exactTransformAt(prim->transform, camera.timeCode(0.5f));
    RasterShapeCache::Request request;
    request.prim = prim;
    request.timeCode = camera.timeCode(0.5f);
    request.toWorld = displacementSpace(*prim, request.timeCode);
    const auto meshLight = _parts.meshLights->of(prim->path, _settings);
    request.needsMesh = meshLight != nullptr;
    for (const RasterMaterial* material : materials) {
        const MaterialProgram& program = *material->program;
        _compiled.materials().tellOfSpaces(program, *prim);
        request.primvars.push_back(material->primvars);
        request.tangentSets.push_back(program.tangentSet());
        const bool bends = program.hasDisplacement() && (prim->kind == GeometryKind::Mesh ||
                                                         prim->kind == GeometryKind::Implicit);
        request.displacers.push_back(bends ? material->program : nullptr);
        request.needsMesh |= _settings.enableSceneLights && program.hasEmission();
    }
    request.strips = !request.needsMesh;
    // Places that are equally far away share a tessellation.
    const bool displaced =
        std::any_of(request.displacers.begin(), request.displacers.end(),
                    [](const std::shared_ptr<const MaterialProgram>& p) { return p != nullptr; });
    span.extent = _compiled.extents().of(prim);
    const RasterDetail detail(*prim, *span.extent, camera, _settings,
                              _subdivision.edgeOf(displaced), displaced, request.needsMesh);
    std::map<float, std::vector<uint32_t>> byEdge;
    for (size_t i = 0; i < where.size(); ++i)
        byEdge[detail.edgeAt(where[i])].push_back(uint32_t(i));
    span.displaced = displaced;
    span.byEdge.clear();
    if (detail.refines()) span.byEdge = byEdge;
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
        if (group.shape->triangles == 0) continue;
        // A light that is divided by its area gives another radiance at places of another size.
        std::map<float, std::vector<uint32_t>> byArea; // to four digits: those of turned places
        for (const uint32_t i : list)
            byArea[meshLight && meshLight->normalize
                       ? std::round(std::log(areaAt(group, where[i], toGroup)) * 1e4f)
                       : 0.0f]
                .push_back(i);
        for (auto& [area, equal] : byArea) {
            group.places = std::move(equal);
            addGroup(group, where, toGroup);
        }
    }
    _moves |= prim->transform.moves();
    addDraws(prim, rank, materials, firstGroup, where, toGroup);
    span.groups = _groups.size() - span.firstGroup;
    span.draws = _draws.size() - span.firstDraw;
    span.emits = request.needsMesh;
}

/// As the path tracer's camera rays: what is no face shows its front from every side.
static int cullFlags(const Geometry& prim, const RenderSettings& settings) {
    const std::string& style = settings.cullStyle;
    if (prim.doubleSided && style.find("Unless") != std::string::npos) return 0;
    const bool faces = prim.kind == GeometryKind::Mesh || prim.kind == GeometryKind::Implicit;
    if (style.rfind("back", 0) == 0) return faces ? RasterDraw::cullsBack : 0;
    return style.rfind("front", 0) == 0 ? RasterDraw::cullsFront : 0;
}

bool RasterScene::readsInstances(const RasterDraw& draw) const {
    const std::vector<std::string>& names = draw.material->primvars;
    bool reads = false;
    for (size_t i = 0; i < names.size(); ++i)
        reads |=
            (draw.surface->primvarBits & (1 << i)) == 0 && _parts.placements->haveValue(names[i]);
    return reads && !draw.prim->group.empty();
}

int RasterScene::addValues(const RasterDraw& draw, const RasterGroup& group,
                           const std::vector<RasterPlace>& places) {
    if (!readsInstances(draw)) return 0;
    const std::vector<std::string>& names = draw.material->primvars;
    const size_t first = _values.size();
    for (const uint32_t place : group.places) {
        const std::vector<InstanceStep>& steps = places[place].steps;
        const size_t at = _values.size();
        _values.resize(at + 1 + names.size(), vec4(0.0f));
        int bits = 0;
        for (size_t i = 0; i < names.size(); ++i)
            if ((draw.surface->primvarBits & (1 << i)) == 0 &&
                readInstances(steps.data(), int(steps.size()), names[i], &_values[at + 1 + i].x))
                bits |= 1 << i;
        _values[at] = vec4(float(bits & 0xffff), float(bits >> 16), 0.0f, 0.0f);
    }
    return int(first) + 1;
}

void RasterScene::addDraws(const std::shared_ptr<const Geometry>& prim, int rank,
                           const std::vector<const RasterMaterial*>& materials, size_t firstGroup,
                           const std::vector<RasterPlace>& places, const dmat4& toGroup) {
    if (firstGroup == _groups.size()) return;
    RasterDraw draw;
    draw.prim = prim;
    draw.primId = prim->id >= 0 ? prim->id : rank;
    draw.noise = murmurHash3(prim->path); // hosts count prims in the order in which they came
    int lit = -1;
    vec3 radiance(0.0f);
    const auto meshLight = _parts.meshLights->of(prim->path, _settings);
    if (meshLight) {
        const Light& light = *meshLight;
        radiance = lightBaseRadiance(light);
        draw.meshLight.mode =
            light.materialSyncMode == "noMaterialResponse" ? RasterMeshLight::NoMaterialResponse
            : light.materialSyncMode == "materialGlowTintsLight" ? RasterMeshLight::GlowTintsLight
                                                                 : RasterMeshLight::Independent;
        if (!light.filters.empty()) draw.meshLight.filtered = light.path;
        lit = _parts.links->of(light.lightLink);
    }
    for (size_t g = firstGroup; g < _groups.size(); ++g) {
        const RasterGroup& group = _groups[g];
        draw.group = int(g);
        draw.flags = group.shape->flags | cullFlags(*prim, _settings);
        draw.meshLight.radiance = radiance;
        if (meshLight && meshLight->normalize)
            draw.meshLight.radiance /= areaAt(group, places[group.places.front()], toGroup);
        for (size_t subset = 0; subset < materials.size(); ++subset) {
            draw.material = materials[subset];
            if (!draw.material->programs) continue;
            const bool lights =
                prim->visibility.diffuse || draw.meshLight.mode != RasterMeshLight::NoLight;
            if (_settings.enableSceneLights && group.shape->mesh && lights)
                for (const uint32_t i : group.places)
                    _emitters.add(group.shape->mesh, subset, draw.material->program, draw.meshLight,
                                  mat4(places[i].groupToWorld * toGroup), lit,
                                  (draw.flags & RasterShape::tube) != 0, _origin, places[i].steps,
                                  i);
            draw.subset = int(subset);
            draw.show(*group.shape);
            if (draw.surface->triangles == 0) continue;
            draw.values = addValues(draw, group, places);
            _triangles += draw.surface->triangles;
            _trianglesDrawn += draw.surface->triangles * group.places.size();
            _draws.push_back(draw);
        }
    }
}

} // namespace patina
