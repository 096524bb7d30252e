#pragma once

#include "hdDelegate/compiled/compiledMaterials.h"
#include "hdDelegate/image/textureSystem.h"
#include "hdDelegate/lights/lightImages.h"

#include <memory>

namespace patina {

/// What every back end needs of a scene: texels, images of lights, programs of materials. Renderers
/// of one scene share it, so that nothing is read, compiled or held twice. Thread safe.
class CompiledScene {
public:
    explicit CompiledScene(const std::shared_ptr<Scene>& scene);

    /// The one of a scene. It lives for as long as a renderer holds it, which holds the scene too.
    static std::shared_ptr<CompiledScene> of(const std::shared_ptr<Scene>& scene);

    const std::shared_ptr<Scene>& scene() const { return _scene; }
    TextureSystem& textures() { return _textures; }
    LightImages& lightImages() { return _lightImages; }
    CompiledMaterials& materials() { return _materials; }

private:
    std::shared_ptr<Scene> _scene;
    TextureSystem _textures;
    LightImages _lightImages;
    CompiledMaterials _materials;
};

} // namespace patina
