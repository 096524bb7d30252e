#include "hdDelegate/scene/scene.h"

#include "hdDelegate/scene/cameraCheck.h"
#include "hdDelegate/scene/instancerCheck.h"

#include <cmath>
#include <utility>

namespace patina {

namespace {

template <class T> void merge(PrimMap<T>& into, const PrimMap<T>& changes) {
    for (const auto& item : changes)
        into[item.first] = item.second;
}

template <class F> void forMaps(SceneState& state, PrimKind kind, const F& f) {
    const auto wanted = [kind](PrimKind own) { return kind == PrimKind::Any || kind == own; };
    if (wanted(PrimKind::Geometry)) f(state.geometry);
    if (wanted(PrimKind::Instancer)) f(state.instancers);
    if (wanted(PrimKind::Light)) f(state.lights);
    if (wanted(PrimKind::Camera)) f(state.cameras);
    if (wanted(PrimKind::Material)) f(state.materials);
}

/// Whether both hold the same prim objects.
bool sameContent(const SceneState& a, const SceneState& b) {
    return a.geometry == b.geometry && a.instancers == b.instancers && a.lights == b.lights &&
           a.cameras == b.cameras && a.materials == b.materials &&
           a.metersPerUnit == b.metersPerUnit;
}

} // namespace

const Primvar* Geometry::primvar(const std::string& name) const {
    for (const Primvar& candidate : primvars)
        if (candidate.name == name) return &candidate;
    return nullptr;
}

Scene::Scene() : _state(std::make_shared<SceneState>()) {}

SceneEdit Scene::edit() {
    return SceneEdit(*this);
}

std::shared_ptr<const SceneState> Scene::snapshot() const {
    std::lock_guard<std::mutex> lock(_mutex);
    return _state;
}

SceneEdit::SceneEdit(SceneEdit&& other) noexcept
    : _scene(std::exchange(other._scene, nullptr)), _clear(other._clear),
      _metersPerUnit(other._metersPerUnit), _changes(std::move(other._changes)),
      _removed(std::move(other._removed)) {}

template <class T> bool SceneEdit::stands(const T& prim, PrimKind kind, const char* consequence) {
    if (isPlace(prim.transform)) return true;
    if (_scene)
        _scene->diagnostics().warn(
            prim.path, "transform",
            std::string("has numbers that are not finite or beyond 1e15; ") + consequence);
    remove(prim.path, kind);
    return false;
}

void SceneEdit::set(std::shared_ptr<const Geometry> prim) {
    if (prim && stands(*prim, PrimKind::Geometry, "the prim is not drawn"))
        _changes.geometry[prim->path] = std::move(prim);
}

void SceneEdit::set(std::shared_ptr<const Instancer> prim) {
    if (prim) _changes.instancers[prim->path] = std::move(prim);
}

void SceneEdit::set(std::shared_ptr<const Light> prim) {
    if (prim && stands(*prim, PrimKind::Light, "the light is off"))
        _changes.lights[prim->path] = std::move(prim);
}

void SceneEdit::set(std::shared_ptr<const Camera> prim) {
    if (prim && _scene) prim = checkedCamera(std::move(prim), _scene->diagnostics());
    if (prim) _changes.cameras[prim->path] = std::move(prim);
}

void SceneEdit::set(std::shared_ptr<const MaterialPrim> prim) {
    if (prim) _changes.materials[prim->path] = std::move(prim);
}

void SceneEdit::setMetersPerUnit(double metersPerUnit) {
    if (std::isfinite(metersPerUnit) && metersPerUnit > 0.0)
        _metersPerUnit = metersPerUnit;
    else if (_scene)
        _scene->diagnostics().warn("/", "metersPerUnit",
                                   "is not a positive number; the value before is kept");
}

void SceneEdit::remove(const std::string& path, PrimKind kind) {
    // What was set before in this edit goes too; what is set after stays, since commit removes
    // first.
    forMaps(_changes, kind, [&](auto& map) { map.erase(path); });
    _removed.emplace_back(path, kind);
}

void SceneEdit::clear() {
    _clear = true;
    _changes = SceneState();
    _removed.clear();
}

void SceneEdit::commit() {
    if (!_scene) return;
    bool changed = _clear || !_removed.empty() || _metersPerUnit > 0.0;
    forMaps(_changes, PrimKind::Any, [&](auto& map) { changed |= !map.empty(); });
    if (!changed) return;

    std::lock_guard<std::mutex> lock(_scene->_mutex);
    const SceneState& before = *_scene->_state;
    auto after = std::make_shared<SceneState>(_clear ? SceneState() : before);
    for (const auto& removed : _removed)
        forMaps(*after, removed.second, [&](auto& map) { map.erase(removed.first); });
    merge(after->geometry, _changes.geometry);
    merge(after->instancers, _changes.instancers);
    merge(after->lights, _changes.lights);
    merge(after->cameras, _changes.cameras);
    merge(after->materials, _changes.materials);
    if (_metersPerUnit > 0.0) after->metersPerUnit = _metersPerUnit;
    if (!sameContent(before, *after)) {
        after->version = before.version + 1;
        _scene->_state = std::move(after);
    }
    _clear = false;
    _metersPerUnit = -1.0;
    _changes = SceneState();
    _removed.clear();
}

} // namespace patina
