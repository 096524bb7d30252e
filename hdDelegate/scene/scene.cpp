// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/scene/scene.h"

#include "hdDelegate/scene/cameraCheck.h"
#include "hdDelegate/scene/instancerCheck.h"
#include "hdDelegate/scene/lightNetwork.h"
#include "hdDelegate/scene/lightUnits.h"
#include "hdDelegate/scene/sceneLimits.h"

#include <cmath>
#include <utility>

namespace patina {

bool sameContent(const SceneState& a, const SceneState& b) {
    return a.geometry == b.geometry && a.instancers == b.instancers && a.lights == b.lights &&
           a.cameras == b.cameras && a.materials == b.materials &&
           a.metersPerUnit == b.metersPerUnit && a.renderingSpace == b.renderingSpace;
}

const Primvar* Geometry::primvar(const std::string& name) const {
    for (const Primvar& candidate : primvars)
        if (candidate.name == name) return &candidate;
    return nullptr;
}

namespace {

/// A temperature is a colour of linear Rec.709 (UsdLux), and so are colours of filters, whose space
/// nobody tells.
std::shared_ptr<const Light> withRenderedColors(const Light& given, const RenderingSpace& space) {
    auto light = std::make_shared<Light>(given);
    if (light->enableColorTemperature)
        light->color *= glm::max(space.from709(blackbodyColor(light->colorTemperature)), 0.0f);
    light->enableColorTemperature = false;
    for (LightFilter& filter : light->filters)
        for (vec3& color : filter.colors)
            color = space.from709(color);
    return light;
}

/// Takes over changes to the prims of one kind.
/// @returns what differs thereafter
template <class T>
SceneDelta::Paths take(PrimMap<T>& prims, const typename PrimMap<T>::Changes& changes) {
    SceneDelta::Paths paths;
    for (const auto& [path, after] : changes) {
        const auto before = prims.find(path);
        if (before == prims.end()) {
            if (after) paths.emplace_hint(paths.end(), path, PrimEdit::Added);
        } else if (before->second != after) {
            paths.emplace_hint(paths.end(), path, after ? PrimEdit::Set : PrimEdit::Removed);
        }
    }
    if (!paths.empty()) prims = prims.changed(changes);
    return paths;
}

} // namespace

Scene::Scene() : _state(std::make_shared<SceneState>()) {}

SceneEdit Scene::edit() {
    return SceneEdit(*this);
}

std::shared_ptr<const SceneState> Scene::snapshot() const {
    std::lock_guard<std::mutex> lock(_mutex);
    return _state;
}

std::optional<SceneDelta> Scene::changes(uint64_t from, uint64_t to) const {
    std::lock_guard<std::mutex> lock(_mutex);
    return _log.between(from, to);
}

SceneEdit::SceneEdit(SceneEdit&& other) noexcept
    : _scene(std::exchange(other._scene, nullptr)), _clear(other._clear),
      _metersPerUnit(other._metersPerUnit), _renderingSpace(other._renderingSpace),
      _geometry(std::move(other._geometry)), _instancers(std::move(other._instancers)),
      _lights(std::move(other._lights)), _cameras(std::move(other._cameras)),
      _materials(std::move(other._materials)) {}

template <class F> void SceneEdit::forMaps(PrimKind kind, const F& f) {
    const auto wanted = [kind](PrimKind own) { return kind == PrimKind::Any || kind == own; };
    if (wanted(PrimKind::Geometry)) f(_geometry);
    if (wanted(PrimKind::Instancer)) f(_instancers);
    if (wanted(PrimKind::Light)) f(_lights);
    if (wanted(PrimKind::Camera)) f(_cameras);
    if (wanted(PrimKind::Material)) f(_materials);
}

template <class T>
bool SceneEdit::stands(const T& prim, PrimKind kind, const MessageMaker<1>& what) {
    if (isPlace(prim.transform)) return true;
    if (_scene)
        _scene->diagnostics().warn(prim.path, "transform", what(placeProblem(prim.transform)));
    remove(prim.path, kind);
    return false;
}

void SceneEdit::set(std::shared_ptr<const Geometry> prim) {
    if (prim && stands(*prim, PrimKind::Geometry, messages::primTransformUnusable))
        _geometry[prim->path] = std::move(prim);
}

void SceneEdit::set(std::shared_ptr<const Instancer> prim) {
    if (prim) _instancers[prim->path] = std::move(prim);
}

void SceneEdit::set(std::shared_ptr<const Light> prim) {
    if (!prim || !stands(*prim, PrimKind::Light, messages::lightTransformUnusable)) return;
    const RenderingSpace& space =
        _renderingSpace ? *_renderingSpace : *_scene->snapshot()->renderingSpace;
    if (!prim->network.empty()) prim = withNetworkValues(*prim, space, _scene->diagnostics());
    if (!space.isRec709()) prim = withRenderedColors(*prim, space);
    _lights[prim->path] = std::move(prim);
}

void SceneEdit::set(std::shared_ptr<const Camera> prim) {
    if (prim && _scene) prim = checkedCamera(std::move(prim), _scene->diagnostics());
    if (prim) _cameras[prim->path] = std::move(prim);
}

void SceneEdit::set(std::shared_ptr<const MaterialPrim> prim) {
    if (prim) _materials[prim->path] = std::move(prim);
}

void SceneEdit::setMetersPerUnit(double metersPerUnit) {
    if (std::isfinite(metersPerUnit) && metersPerUnit > 0.0)
        _metersPerUnit = metersPerUnit;
    else if (_scene)
        _scene->diagnostics().warn("/", "metersPerUnit", messages::metersPerUnitUnusable);
}

void SceneEdit::remove(const std::string& path, PrimKind kind) {
    forMaps(kind, [&](auto& changes) { changes[path] = nullptr; });
}

void SceneEdit::clear() {
    _clear = true;
    forMaps(PrimKind::Any, [](auto& changes) { changes.clear(); });
}

void SceneEdit::commit() {
    if (!_scene) return;
    bool changed = _clear || _metersPerUnit > 0.0 || _renderingSpace;
    forMaps(PrimKind::Any, [&](auto& changes) { changed |= !changes.empty(); });
    if (!changed) return;

    std::lock_guard<std::mutex> lock(_scene->_mutex);
    const SceneState& before = *_scene->_state;
    auto after = std::make_shared<SceneState>(_clear ? SceneState() : before);
    {
        SceneLimits limits(after->triangles, _scene->diagnostics());
        limits.keep(after->geometry, _geometry);
        limits.keep(after->instancers, _instancers);
        limits.keep(after->lights, _lights);
        limits.keep(after->cameras, _cameras);
        limits.keep(after->materials, _materials);
    }
    SceneDelta delta;
    delta.geometry = take(after->geometry, _geometry);
    delta.instancers = take(after->instancers, _instancers);
    delta.lights = take(after->lights, _lights);
    delta.cameras = take(after->cameras, _cameras);
    delta.materials = take(after->materials, _materials);
    delta.metersPerUnit = _metersPerUnit > 0.0 && _metersPerUnit != after->metersPerUnit;
    if (delta.metersPerUnit) after->metersPerUnit = _metersPerUnit;
    if (_renderingSpace) after->renderingSpace = _renderingSpace;
    const bool all = _clear || after->renderingSpace != before.renderingSpace;
    if (all ? !sameContent(before, *after) : !delta.empty()) {
        after->version = before.version + 1;
        if (all)
            _scene->_log.clear();
        else
            _scene->_log.add(after->version, std::move(delta));
        _scene->_state = std::move(after);
    }
    _clear = false;
    _metersPerUnit = -1.0;
    _renderingSpace = nullptr;
    forMaps(PrimKind::Any, [](auto& changes) { changes.clear(); });
}

} // namespace patina
