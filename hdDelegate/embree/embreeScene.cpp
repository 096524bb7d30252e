// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/embreeScene.h"

#include "hdDelegate/compiled/drawFilter.h"
#include "hdDelegate/embree/cameraRays.h"
#include "hdDelegate/film/aovTable.h"
#include "hdDelegate/scene/primCompare.h"

#include <algorithm>

namespace patina {

namespace {

bool onEmbreeMemory(void* user, ssize_t bytes, bool) {
    *static_cast<std::atomic<int64_t>*>(user) += bytes;
    return true;
}

bool anyHasPriority(const Placements& placements) {
    for (const auto& instancer : placements.drawn())
        for (const Marked& marks : instancer->marks)
            if (marks.dielectricPriority > 0) return true;
    return false;
}

} // namespace

void EmbreeScene::onError(void* self, RTCError code, const char* text) {
    EmbreeScene& scene = *static_cast<EmbreeScene*>(self);
    if (code == RTC_ERROR_OUT_OF_MEMORY)
        scene._outOfMemory = true;
    else if (code != RTC_ERROR_NONE && code != RTC_ERROR_CANCELLED)
        scene._diagnostics.warn("Embree", "",
                                text ? messages::embreeError(text) : messages::embreeSilent());
}

EmbreeScene::EmbreeScene(CompiledScene& compiled)
    : WorldRays(compiled.scene()->diagnostics()), _compiled(compiled), _surfaces(compiled, _counts),
      _groups(_diagnostics, _counts) {
    _device = rtcNewDevice(nullptr);
    rtcSetDeviceErrorFunction(_device, onError, this);
    rtcSetDeviceMemoryMonitorFunction(_device, onEmbreeMemory, &_embreeBytes);
}

EmbreeScene::~EmbreeScene() {
    _groups.clear();
    _surfaces.clear();
    _filled.splats.clear();
    rtcSetDeviceMemoryMonitorFunction(_device, nullptr, nullptr);
    rtcReleaseDevice(_device);
}

void EmbreeScene::update(const SceneState& state, const Camera& camera,
                         const RenderSettings& settings, const std::atomic<bool>& stop,
                         const dvec3& origin) {
    const CompiledState before = _parts;
    _parts = _compiled.compiled(state, settings);
    const bool sameView = _complete && origin == _space.origin && settings == _settings &&
                          sameCamera(camera, _camera);
    const bool sameParts = _parts.placements == before.placements && _parts.links == before.links &&
                           _parts.meshLights == before.meshLights;
    const auto edits = sameView && sameParts ? _compiled.editsSince(_version, state) : std::nullopt;
    _complete = false;
    _outOfMemory = false;
    if (_parts.placements != before.placements) _instancesRank = anyHasPriority(*_parts.placements);
    const vec2 shutter = shutterOf(camera, settings);
    const TracedSpace space{origin, shutter.x, shutter.y, tellMotion(settings.aovs)};
    if (!(space == _space)) {
        _surfaces.forgetSurfaces();
        _groups.forgetInstances();
    }
    _space = space;
    _places = GroupPlaces(_parts.placements, _space);
    const ScreenScale screen = screenScale(camera, settings, origin);
    const SceneView view{state, camera, settings, _parts, screen, _space, stop};
    if (!edits || !updateTouched(view, *edits)) {
        updateAll(view);
        _lightsMayDiffer = true;
    }
    if (_outOfMemory.exchange(false)) { // Embree does not say which structures lack it
        _world = nullptr;
        _groups.clear();
        _surfaces.clear();
        _filled.splats.clear();
        throw std::bad_alloc();
    }
    _ranksMedia = _instancesRank || _surfaces.totals().withPriority > 0;
    _complete = !stop;
    _version = state.version;
    _camera = camera;
    _settings = settings;
}

void EmbreeScene::updateAll(const SceneView& view) {
    _surfaces.subdivision =
        _compiled.subdivision().of(view.state, *_parts.placements, view.camera, view.settings);
    _counts.looked += view.state.geometry.size();
    std::vector<Ranked<Geometry>> prims;
    std::vector<std::shared_ptr<const Volume>> volumes;
    std::vector<SplatScene::Prim> splats;
    int rank = 0;
    for (const auto& item : view.state.geometry) {
        const auto& prim = item.second;
        const int own = rank++;
        if (!isDrawn(*prim, view.settings)) continue;
        if (prim->kind == GeometryKind::Volume)
            volumes.push_back(std::static_pointer_cast<const Volume>(prim));
        else if (prim->kind == GeometryKind::Splats)
            splats.push_back(
                {std::static_pointer_cast<const Splats>(prim), prim->id >= 0 ? prim->id : own});
        else
            prims.push_back({prim, own});
    }
    if (!_surfaces.update(_device, view, _places, prims)) return;
    _world = _groups.build(_device, view, _surfaces.members());
    if (view.stop) return;
    updateFilled(view, volumes, splats);
    takeBounds();
    _surfaces.collectEmissive(*_parts.placements);
}

/// After edits of prims that stay where they are in the scene: only what they touch is looked at.
bool EmbreeScene::updateTouched(const SceneView& view, const SceneEdits& edits) {
    const SceneDelta& delta = edits.delta;
    const bool inPlace =
        delta.instancers.empty() && onlySets(delta.geometry) &&
        std::none_of(delta.materials.begin(), delta.materials.end(),
                     [](const auto& item) { return item.second == PrimEdit::Removed; });
    if (!inPlace) return false;
    const auto changes = _surfaces.updateTouched(view, _places, edits.touched, _fillsSpace);
    if (!changes) return false;
    _lightsMayDiffer = !delta.lights.empty() || changes->meshLights || changes->emissive;
    if (view.stop) return true; // the next update looks at everything
    if (!changes->surfaces.empty()) {
        if (EmbreeGroup* world = _groups.rebuild(_device, view, changes->surfaces)) _world = world;
        if (view.stop) return true;
        takeBounds();
    }
    if (changes->emissive) _surfaces.collectEmissive(*_parts.placements);
    return true;
}

void EmbreeScene::updateFilled(const SceneView& view,
                               const std::vector<std::shared_ptr<const Volume>>& volumes,
                               const std::vector<SplatScene::Prim>& splats) {
    const auto mediumOf = [&](const std::shared_ptr<const Volume>& prim) {
        if (view.state.materials.count(prim->material))
            _surfaces.program(prim->material, prim->path, view);
        return _compiled.volumes().medium(prim, view.state, view.settings);
    };
    _filled.volumes.update(
        volumes, mediumOf, [&](const std::string& group) { return _places.transforms(group); },
        _space.open, _space.origin, _diagnostics);
    _filled.splats.update(
        _device, _compiled.splats(), splats,
        [&](const std::string& group) { return _places.moving(group); }, _space.open, _space.close,
        _space.origin, *view.state.renderingSpace, view.stop, _diagnostics);
    _fillsSpace = !_filled.empty();
}

void EmbreeScene::takeBounds() {
    RTCBounds bounds;
    rtcGetSceneBounds(_world->scene, &bounds);
    _boundsMin = vec3(bounds.lower_x, bounds.lower_y, bounds.lower_z);
    _boundsMax = vec3(bounds.upper_x, bounds.upper_y, bounds.upper_z);
    if (!_fillsSpace) return;
    _boundsMin = glm::min(glm::min(_boundsMin, volumes().boundsMin()), splats().boundsMin());
    _boundsMax = glm::max(glm::max(_boundsMax, volumes().boundsMax()), splats().boundsMax());
}

size_t EmbreeScene::bytes() const {
    return size_t(std::max<int64_t>(0, _embreeBytes)) + _surfaces.bytes() + splats().bytes();
}

} // namespace patina
