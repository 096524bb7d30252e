#include "hdDelegate/compiled/compiledScene.h"

namespace patina {

CompiledScene::CompiledScene(const std::shared_ptr<Scene>& scene)
    : _scene(scene), _textures(scene->diagnostics()), _lightImages(scene->diagnostics()),
      _materials(_textures, scene->diagnostics()) {}

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

} // namespace patina
