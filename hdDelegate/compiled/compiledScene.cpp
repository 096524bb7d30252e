// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/compiled/compiledScene.h"

#include <algorithm>
#include <map>

namespace patina {

CompiledScene::CompiledScene(const std::shared_ptr<Scene>& scene)
    : _scene(scene), _textures(scene->diagnostics()), _lightImages(scene->diagnostics()),
      _materials(_textures, scene->diagnostics()), _shapes(scene->diagnostics()),
      _volumes(_materials, scene->diagnostics()), _subdivision(_materials, _extents) {}

std::shared_ptr<CompiledScene> CompiledScene::of(const std::shared_ptr<Scene>& scene) {
    static std::mutex mutex;
    static std::map<const Scene*, std::weak_ptr<CompiledScene>> known;
    const std::lock_guard<std::mutex> lock(mutex);
    for (auto it = known.begin(); it != known.end();)
        it = it->second.expired() ? known.erase(it) : std::next(it);
    std::weak_ptr<CompiledScene>& entry = known[scene.get()];
    std::shared_ptr<CompiledScene> compiled = entry.lock();
    if (!compiled) entry = compiled = std::make_shared<CompiledScene>(scene);
    return compiled;
}

CompiledState CompiledScene::compiled(const SceneState& state, const RenderSettings& settings) {
    const std::lock_guard<std::mutex> lock(_mutex);
    _textures.setRenderingSpace(*state.renderingSpace);
    _lightImages.setRenderingSpace(*state.renderingSpace);
    _materials.setRenderingSpace(*state.renderingSpace);
    constexpr double most = 1e12; // MiB
    _textures.setMemory(uint64_t(std::min(settings.textureMemory, most) * (1 << 20)));
    const auto delta = _scene->changes(_compiledVersion, state.version);
    const bool known = delta && _compiled.placements;
    if (!known || !delta->instancers.empty() || _excludePaths != settings.excludePaths)
        _compiled.placements = std::make_shared<Placements>(state, settings, _scene->diagnostics(),
                                                            _compiled.placements.get());
    if (!known || !delta->lights.empty()) {
        const auto keep = [](auto& part, auto made) {
            if (!part || !(*part == *made)) part = std::move(made);
        };
        keep(_compiled.links, std::make_shared<const LinkNames>(state));
        keep(_compiled.meshLights, std::make_shared<const MeshLights>(state));
    }
    _compiledVersion = state.version;
    _excludePaths = settings.excludePaths;
    return _compiled;
}

std::optional<SceneEdits> CompiledScene::editsSince(uint64_t version, const SceneState& state) {
    auto delta = _scene->changes(version, state.version);
    if (!delta) return std::nullopt;
    SceneEdits edits;
    for (const auto& [path, edit] : delta->geometry)
        if (edit == PrimEdit::Set || edit == PrimEdit::Added) edits.touched.insert(path);
    if (!delta->materials.empty()) {
        const std::lock_guard<std::mutex> lock(_mutex);
        _users.update(state,
                      _usersKnown ? _scene->changes(_usersVersion, state.version) : std::nullopt);
        _usersKnown = true;
        _usersVersion = state.version;
        for (const auto& item : delta->materials)
            for (const std::string& user : _users.of(item.first))
                edits.touched.insert(user);
    }
    edits.delta = std::move(*delta);
    return edits;
}

} // namespace patina
