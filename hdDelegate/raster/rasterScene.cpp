#include "hdDelegate/raster/rasterScene.h"

#include "hdDelegate/raster/rasterShapes.h"
#include "hdDelegate/scene/displace.h"
#include "hdDelegate/scene/lightUnits.h"
#include "hdDelegate/scene/primvarEval.h"
#include "hdDelegate/scene/splitTriangles.h"
#include "hdDelegate/scene/tessellate.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>

namespace patina {

namespace {

float maxScale(const mat4& m) {
    return std::max({glm::length(vec3(m[0])), glm::length(vec3(m[1])), glm::length(vec3(m[2]))});
}

float intBits(int value) {
    float bits;
    std::memcpy(&bits, &value, sizeof bits);
    return bits;
}

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

/// The longest edge, in object units, that looks `pixels` long from the camera.
float wantedEdge(const Geometry& prim, const RasterCamera& camera, const RenderSettings& settings,
                 const std::vector<RasterPlace>& places) {
    if (prim.kind != GeometryKind::Mesh || !(settings.edgeLength > 0.0f)) return 0.0f;
    const Mesh& mesh = static_cast<const Mesh&>(prim);
    if (mesh.scheme == SubdivisionScheme::None || mesh.points.empty()) return 0.0f;
    vec3 low(INFINITY), high(-INFINITY);
    for (const vec3& p : mesh.points.first())
        if (std::isfinite(p.x + p.y + p.z)) {
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
    const RasterView view = camera.view(vec2(0.0f), vec2(0.0f), 0.5f, low, high);
    float edge = 0.0f;
    for (const RasterPlace& place : places) {
        const mat4 m = place.groupToWorld * transformAt(prim.transform, camera.timeCode(0.0f));
        const float scale = maxScale(m);
        const vec3 center = vec3(m * vec4(0.5f * (low + high), 1.0f));
        const float radius = 0.5f * glm::length(high - low) * scale;
        const float distance = view.perspective ? std::max(camera.camera().clipNear,
                                                           glm::length(center - view.eye) - radius)
                                                : 1.0f;
        const float wanted = settings.edgeLength * view.pixelSpread * distance / scale;
        if (std::isfinite(wanted) && wanted > 0.0f)
            edge = edge > 0.0f ? std::min(edge, wanted) : wanted;
    }
    return edge > 0.0f ? std::exp2(std::floor(std::log2(edge))) : 0.0f;
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
    objectToWorld = toWorld;
    const mat3 linear(toWorld);
    normalToWorld = mat4(glm::transpose(glm::inverse(linear)));
    normalToWorld[3].w = std::cbrt(std::fabs(glm::determinant(linear)));
}

void RasterScene::addCaster(const std::shared_ptr<const Geometry>& prim, const TriangleMesh& mesh,
                            const std::vector<const RasterMaterial*>& materials,
                            const RasterDraw& draw) {
    if (!prim->visibility.shadow) return;
    RasterCaster caster;
    caster.prim = prim;
    caster.firstIndex = int(_indices.size());
    caster.baseVertex = int(_positions.size());
    caster.firstInstance = draw.firstInstance;
    caster.instanceCount = draw.instanceCount;
    for (size_t t = 0; t < mesh.triangles.size(); ++t) {
        const size_t subset = t < mesh.triangleSubset.size() ? mesh.triangleSubset[t] : 0;
        const RasterMaterial* material = materials[subset < materials.size() ? subset : 0];
        if (material->program->isVolumeOnly() || (material->programs && material->programs->shadow))
            continue;
        for (int k = 0; k < 3; ++k)
            _indices.push_back(mesh.triangles[t][k]);
    }
    caster.indexCount = int(_indices.size()) - caster.firstIndex;
    if (caster.indexCount == 0) return;
    _positions.insert(_positions.end(), mesh.positions[0].begin(), mesh.positions[0].end());
    _casters.push_back(caster);
}

void RasterScene::addTriangles(const std::shared_ptr<const Geometry>& prim,
                               const TriangleMesh& mesh, size_t subset, RasterDraw draw) {
    const auto& primvars = draw.material->program->primvars();
    std::vector<const MeshAttribute*> attributes;
    for (const MaterialPrimvar& p : primvars) {
        attributes.push_back(mesh.attribute(p.name));
        if (attributes.back()) draw.primvarBits |= 1 << (attributes.size() - 1);
    }
    const MeshAttribute* st = mesh.attribute("st");
    draw.prim = prim;
    draw.floatsPerCorner = 17 + 4 * int(primvars.size());
    draw.firstFloat = int(_vertices.size());
    draw.boundsMin = mesh.boundsMin;
    draw.boundsMax = mesh.boundsMax;
    if (mesh.normals.empty()) draw.flags |= 2;
    const auto& positions = mesh.positions[0];
    for (unsigned t = 0; t < mesh.triangles.size(); ++t) {
        const size_t own = t < mesh.triangleSubset.size() ? mesh.triangleSubset[t] : 0;
        if (own != subset) continue;
        const uvec3 tri = mesh.triangles[t];
        const vec3 p[3] = {positions[tri.x], positions[tri.y], positions[tri.z]};
        vec3 dPdu(0.0f), dPdv(0.0f);
        float uvPerLength = 0.0f, uv[3][4];
        if (st && evalAttribute(mesh, *st, t, 0, 0, uv[0]) &&
            evalAttribute(mesh, *st, t, 1, 0, uv[1]) && evalAttribute(mesh, *st, t, 0, 1, uv[2])) {
            const float du1 = uv[1][0] - uv[0][0], dv1 = uv[1][1] - uv[0][1];
            const float du2 = uv[2][0] - uv[0][0], dv2 = uv[2][1] - uv[0][1];
            const float determinant = du1 * dv2 - du2 * dv1;
            if (determinant != 0.0f && std::isfinite(determinant)) {
                dPdu = ((p[1] - p[0]) * dv2 - (p[2] - p[0]) * dv1) / determinant;
                dPdv = ((p[2] - p[0]) * du1 - (p[1] - p[0]) * du2) / determinant;
                const float area2 = glm::length(glm::cross(p[1] - p[0], p[2] - p[0]));
                uvPerLength = std::sqrt(std::abs(determinant) / std::max(area2, 1e-30f));
            }
        }
        const vec3 ng = glm::cross(p[1] - p[0], p[2] - p[0]);
        const int element = t < mesh.triangleFace.size() ? mesh.triangleFace[t] : int(t);
        for (int c = 0; c < 3; ++c) {
            const float u = c == 1 ? 1.0f : 0.0f, v = c == 2 ? 1.0f : 0.0f;
            const vec3 n = mesh.normals.empty() ? vec3(0.0f) : evalNormal(mesh, t, u, v);
            const float record[] = {p[c].x,      p[c].y,           p[c].z, n.x,    n.y,    n.z,
                                    dPdu.x,      dPdu.y,           dPdu.z, dPdv.x, dPdv.y, dPdv.z,
                                    uvPerLength, intBits(element), ng.x,   ng.y,   ng.z};
            _vertices.insert(_vertices.end(), std::begin(record), std::end(record));
            for (const MeshAttribute* attribute : attributes) {
                float value[4] = {0, 0, 0, 0};
                if (attribute) evalAttribute(mesh, *attribute, t, u, v, value);
                _vertices.insert(_vertices.end(), value, value + 4);
            }
        }
        draw.cornerCount += 3;
    }
    if (draw.cornerCount == 0) return;
    _triangles += size_t(draw.cornerCount) / 3;
    _draws.push_back(draw);
}

void RasterScene::addPrim(const std::shared_ptr<const Geometry>& prim, int rank,
                          const SceneState& state, const RasterCamera& camera,
                          const RenderSettings& settings, RasterInstances& places) {
    const auto& where = places.places(prim->group);
    if (where.empty()) return;
    std::vector<const RasterMaterial*> materials = {
        &_materials.get(prim->material, prim->path, state, settings)};
    std::vector<std::shared_ptr<const MaterialProgram>> displacers = {materials[0]->program};
    for (const GeomSubset& subset : prim->subsets) {
        materials.push_back(
            &_materials.get(subset.material.empty() ? prim->material : subset.material, prim->path,
                            state, settings));
        displacers.push_back(materials.back()->program);
    }
    bool displaced = false;
    for (auto& program : displacers) {
        if (!program->hasDisplacement()) program = nullptr;
        displaced |= program != nullptr;
    }
    TessellationOptions options;
    options.shutterOpen = options.shutterClose = camera.timeCode(0.5f);
    options.targetEdge = wantedEdge(*prim, camera, settings, where);
    TriangleMesh mesh = rasterTriangles(*prim, options, _diagnostics);
    if (mesh.positions.empty() || mesh.triangles.empty()) return;
    const mat4 toGroup = transformAt(prim->transform, camera.timeCode(0.5f));
    if (displaced) {
        if (options.targetEdge > 0.0f)
            splitTriangles(mesh, options.targetEdge, options.triangleBudget);
        displace(mesh, displacers, where[0].groupToWorld * toGroup);
    }
    RasterDraw draw;
    draw.firstInstance = int(_instances.size());
    draw.primId = prim->id >= 0 ? prim->id : rank;
    for (const RasterPlace& place : where) {
        GpuInstance instance;
        instance.place(place.groupToWorld * toGroup);
        instance.ids[0] = place.id;
        instance.ids[1] = linksOf(prim->categories, place.categories);
        for (int i = 0; i < 8; ++i) {
            const vec3 corner(i & 1 ? mesh.boundsMax.x : mesh.boundsMin.x,
                              i & 2 ? mesh.boundsMax.y : mesh.boundsMin.y,
                              i & 4 ? mesh.boundsMax.z : mesh.boundsMin.z);
            const vec3 p = vec3(instance.objectToWorld * vec4(corner, 1.0f));
            _boundsMin = glm::min(_boundsMin, p);
            _boundsMax = glm::max(_boundsMax, p);
        }
        _instances.push_back(instance);
    }
    draw.instanceCount = int(where.size());
    _moves |= prim->transform.moves();
    addCaster(prim, mesh, materials, draw);
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
            draw.meshLight.radiance /=
                std::max(areaOf(mesh, where[0].groupToWorld * toGroup), 1e-30f);
        const auto category = _categories.find(light.lightLink);
        if (category != _categories.end()) lit = category->second;
    }
    for (size_t subset = 0; subset < materials.size(); ++subset) {
        draw.material = materials[subset];
        if (!draw.material->programs || draw.material->program->isVolumeOnly()) continue;
        if (settings.enableSceneLights)
            for (const RasterPlace& place : where)
                _emitters.add(mesh, subset, *draw.material->program, draw.meshLight,
                              place.groupToWorld * toGroup, lit);
        addTriangles(prim, mesh, subset, draw);
    }
}

void RasterScene::update(const SceneState& state, const RasterCamera& camera,
                         const RenderSettings& settings, const std::atomic<bool>& stop) {
    _draws.clear();
    _casters.clear();
    _positions.clear();
    _indices.clear();
    _vertices.clear();
    _instances.clear();
    _triangles = 0;
    _moves = false;
    _boundsMin = vec3(INFINITY);
    _boundsMax = vec3(-INFINITY);
    _materials.update(state, settings);
    collectCategories(state);
    collectMeshLights(state, settings);
    _emitters.clear();
    RasterInstances places(state, settings, camera.timeCode(0.5f));
    for (const auto& item : state.instancers)
        for (const MotionTransform& transform : item.second->transforms)
            _moves |= transform.moves();
    int rank = 0;
    for (const auto& item : state.geometry) {
        if (stop) return;
        const int own = rank++;
        if (!isDrawnInRaster(*item.second, settings)) continue;
        if (item.second->kind == GeometryKind::Volume) {
            _diagnostics.warn(item.first, "", "the rasterizer shows no volumes");
            continue;
        }
        addPrim(item.second, own, state, camera, settings, places);
    }
    if (_draws.empty()) _boundsMin = _boundsMax = vec3(0.0f);
    _vertexBuffer = GlBuffer(_vertices);
    _instanceBuffer = GlBuffer(_instances);
    _positionBuffer = GlBuffer(_positions);
    _indexBuffer = GlBuffer(_indices);
    _linkBuffer = GlBuffer(_links);
    std::vector<float>().swap(_vertices);
}

bool RasterScene::moveTo(const SceneState& state, const RenderSettings& settings, float timeCode) {
    if (!_moves) return false;
    RasterInstances places(state, settings, timeCode);
    const Geometry* last = nullptr;
    for (const RasterDraw& draw : _draws) {
        if (draw.prim.get() == last) continue; // subsets share their instances
        last = draw.prim.get();
        const auto& where = places.places(draw.prim->group);
        const mat4 toGroup = transformAt(draw.prim->transform, timeCode);
        for (int i = 0; i < draw.instanceCount && size_t(i) < where.size(); ++i)
            _instances[size_t(draw.firstInstance + i)].place(where[size_t(i)].groupToWorld *
                                                             toGroup);
    }
    _instanceBuffer.write(_instances.data(), _instances.size() * sizeof(GpuInstance));
    return true;
}

size_t RasterScene::trianglesDrawn() const {
    size_t sum = 0;
    for (const RasterDraw& d : _draws)
        sum += size_t(d.cornerCount) / 3 * size_t(d.instanceCount);
    return sum;
}

void RasterScene::bind(GLuint vertexArray) const {
    _vertexBuffer.bindStorage(2);
    _instanceBuffer.bindStorage(3);
    _positionBuffer.bindStorage(6);
    _linkBuffer.bindStorage(9);
    gl.VertexArrayElementBuffer(vertexArray, _indexBuffer.id());
}

} // namespace patina
