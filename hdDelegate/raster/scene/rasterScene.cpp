// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/scene/rasterScene.h"

#include "hdDelegate/compiled/drawFilter.h"

#include "hdDelegate/scene/instancerCheck.h"
#include "hdDelegate/scene/lightUnits.h"
#include "hdDelegate/scene/primCompare.h"
#include "base/limits.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <type_traits>

namespace patina {

/// Asks for all programs before the first is waited for.
void RasterScene::prepareMaterials(const SceneState& state, RasterInstances& places) {
    for (const auto& item : state.instancers)
        for (const Marked& marks : item.second->marks)
            if (const auto problem = notShownInRaster(marks)) {
                _diagnostics.warn(item.first, "primvars", *problem);
                break;
            }
    for (const auto& item : state.geometry) {
        const Geometry& prim = *item.second;
        const bool apart = prim.kind != GeometryKind::Splats; // they are seen by cameras alone
        const auto problem = apart ? notShownInRaster(prim) : std::nullopt;
        if (problem && isDrawn(prim, _settings)) _diagnostics.warn(prim.path, "primvars", *problem);
        if (!isSurface(prim.kind) || !isDrawnInRaster(prim, _settings) ||
            places.places(prim.group).empty())
            continue;
        _materials.prepare(prim.material, state, _settings);
        for (const GeomSubset& subset : prim.subsets)
            if (!subset.material.empty()) _materials.prepare(subset.material, state, _settings);
    }
}

void RasterScene::update(const SceneState& state, const vec3& origin, const RasterCamera& camera,
                         const RenderSettings& asked, const RasterLightPlan& lights,
                         const std::atomic<bool>& stop, const Compiling& compiling) {
    const CompiledState before = _parts;
    _parts = _compiled.compiled(state, asked);
    // With a tolerance all materials decide together.
    const bool moved = !sameCamera(camera.camera(), _camera);
    const bool same = _complete && asked.tolerance < 0.0 && origin == _origin &&
                      asked == _settings && camera.timeCode(0.0f) == _shutterOpen &&
                      camera.timeCode(1.0f) == _shutterClose &&
                      _parts.placements == before.placements && _parts.links == before.links &&
                      _parts.meshLights == before.meshLights &&
                      lights.needsFilters() == _filtered && lights.text() == _lightText;
    auto edits = same ? _compiled.editsSince(_version, state) : std::nullopt;
    if (edits && moved) addResized(state, camera, stop, *edits);
    if (!edits || edits->delta.size() != edits->delta.cameras.size()) ++_shadowVersion;
    _complete = false;
    _origin = origin;
    _camera = camera.camera();
    _settings = asked;
    _version = state.version;
    _filtered = lights.needsFilters();
    _lightText = lights.text();
    _shapes.retainFixed(asked.interactive);
    _lightsMayDiffer = !edits || !edits->delta.lights.empty();
    if (!edits || !updateTouched(*edits, state, camera, stop, compiling)) {
        _lightsMayDiffer = true;
        updateAll(state, camera, lights, stop, compiling);
    }
    _complete = !stop && _materials.standIns() == 0;
}

void RasterScene::finishPrograms(const std::atomic<bool>& stop, const Compiling& compiling) {
    _materials.showStandIns(!compiling);
    if (compiling) _materials.finish(stop, compiling);
}

void RasterScene::updateAll(const SceneState& state, const RasterCamera& camera,
                            const RasterLightPlan& lights, const std::atomic<bool>& stop,
                            const Compiling& compiling) {
    // Until the prims are there again, what was measured of them is held.
    const std::map<std::string, Span> before = std::move(_spans);
    _spans.clear();
    _draws.clear();
    _groups.clear();
    _instances.clear();
    _values.clear();
    _boxes.clear();
    _triangles = _trianglesDrawn = 0;
    _moves = false;
    _shutterOpen = camera.timeCode(0.0f);
    _shutterClose = camera.timeCode(1.0f);
    _boundsMin = vec3(INFINITY);
    _boundsMax = vec3(-INFINITY);
    _looked += state.geometry.size();
    _materials.update(state, _settings, lights);
    _links = {(int(_parts.links->size()) + 31) / 32};
    _linkRows.clear();
    _emitters.clear();
    _volumes.begin();
    _splats.begin();
    RasterInstances places(_parts.placements, camera.timeCode(0.5f), _origin);
    Camera inWorld = camera.camera(); // which is relative to the origin, as places are
    for (dmat4& place : inWorld.transform.values)
        place[3] += glm::dvec4(dvec3(_origin), 0.0);
    _subdivision = _compiled.subdivision().of(state, *_parts.placements, inWorld, _settings);
    prepareMaterials(state, places);
    finishPrograms(stop, compiling);
    for (const auto& item : state.instancers) {
        warnOfInstances(*item.second, camera.timeCode(0.5f), _diagnostics);
        for (const MotionTransform& transform : item.second->transforms)
            _moves |= transform.moves();
    }
    int rank = 0;
    size_t listed = 0; // each prim at each of its places
    for (const auto& item : state.geometry) {
        if (stop) return;
        const int own = rank++;
        if (!isDrawnInRaster(*item.second, _settings)) continue;
        const size_t here = places.places(item.second->group).size();
        if (listed + here > std::min<uint64_t>(limitOf(Limit::instances), INT32_MAX)) {
            _diagnostics.warn(item.second->path, "",
                              messages::rasterPrimsTooMany(limitText(Limit::instances)));
            continue;
        }
        listed += here;
        if (item.second->kind == GeometryKind::Volume) {
            const auto volume = std::static_pointer_cast<const Volume>(item.second);
            const dmat4 toGroup = exactTransformAt(volume->transform, camera.timeCode(0.0f));
            std::vector<mat4> toWorld;
            for (const RasterPlace& place : places.places(volume->group))
                toWorld.push_back(mat4(place.groupToWorld * toGroup));
            _volumes.add(volume, state, _settings, toWorld, _boundsMin, _boundsMax);
            continue;
        }
        if (item.second->kind == GeometryKind::Splats) {
            const auto splats = std::static_pointer_cast<const Splats>(item.second);
            _splats.add(splats, splats->id >= 0 ? splats->id : own, *state.renderingSpace);
            _moves |= splats->transform.moves();
            continue;
        }
        addPrim(item.second, own, state, camera, places);
    }
    _shapes.forgetUnused();
    _materials.forgetUnused(_settings);
    _volumes.end();
    _splats.end();
    _splats.moveTo(places, camera.timeCode(0.5f));
    if (_draws.empty() && _volumes.placed().empty()) {
        _boundsMin = _splats.empty() ? vec3(0.0f) : _splats.boundsMin();
        _boundsMax = _splats.empty() ? vec3(0.0f) : _splats.boundsMax();
    }
    _linkBuffer = GlBuffer(_links);
    if (_values.empty()) _values.emplace_back(0.0f);
    _valueBuffer = GlBuffer(_values);
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

bool RasterScene::moveTo(float timeCode) {
    if (!_moves || !(_shutterClose > _shutterOpen)) return false;
    deform(timeCode);
    RasterInstances places(_parts.placements, timeCode, _origin);
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
    _splats.moveTo(places, timeCode);
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
    plan.add(_subdivision.method);
    return plan;
}

void RasterScene::bind(GLuint vertexArray) const {
    _linkBuffer.bindStorage(9);
    _valueBuffer.bindStorage(11);
    gl.VertexArrayVertexBuffer(vertexArray, 1, _instanceBuffer.id(), 0, sizeof(GpuInstance));
}

void RasterScene::describe(GLuint vertexArray) {
    const auto attribute = [&](GLuint i, GLint components, size_t offset, GLuint binding,
                               bool integers) {
        gl.EnableVertexArrayAttrib(vertexArray, i);
        if (integers)
            gl.VertexArrayAttribIFormat(vertexArray, i, components, GL_INT, GLuint(offset));
        else
            gl.VertexArrayAttribFormat(vertexArray, i, components, GL_FLOAT, GL_FALSE,
                                       GLuint(offset));
        gl.VertexArrayAttribBinding(vertexArray, i, binding);
    };
    attribute(0, 4, offsetof(RasterChunk::Vertex, position), 0, false);
    attribute(1, 3, offsetof(RasterChunk::Vertex, normal), 0, false);
#define PATINA_ATTRIBUTE(place, type, name)                                                        \
    attribute(place, 4, offsetof(InstanceRows, name), 1, std::is_same_v<glm::type, glm::ivec4>);
#include "shaders/raster/instanceFields.glsl"
#undef PATINA_ATTRIBUTE
    gl.VertexArrayBindingDivisor(vertexArray, 1, 1);
}

} // namespace patina
