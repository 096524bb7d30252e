// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/compiled/compiledMaterials.h"
#include "hdDelegate/compiled/compiledShapes.h"
#include "hdDelegate/compiled/compiledVolumes.h"
#include "hdDelegate/compiled/linkNames.h"
#include "hdDelegate/compiled/materialUsers.h"
#include "hdDelegate/compiled/meshLights.h"
#include "hdDelegate/compiled/placements.h"
#include "hdDelegate/compiled/splatKernels.h"
#include "hdDelegate/compiled/subdivision.h"
#include "hdDelegate/image/textureSystem.h"
#include "hdDelegate/lights/lightImages.h"

#include <memory>
#include <optional>
#include <set>

namespace patina {

/// The compiled parts of one state. A part that an edit leaves as it was is the same
/// object as before the edit.
struct CompiledState {
    std::shared_ptr<const Placements> placements;
    std::shared_ptr<const LinkNames> links;
    std::shared_ptr<const MeshLights> meshLights;
};

/// The effect of edits on a back end that knows the state before them.
struct SceneEdits {
    SceneDelta delta;
    /// Geometry that is there and has changed, or is bound to a material that has.
    std::set<std::string> touched;
};

/// The part of a scene that every back end needs, made once for all its renderers: texels, images
/// of lights, programs of materials, shapes, media of volumes, kernels of splats, where instances
/// are, how finely surfaces are drawn, and what edits touch. Thread safe.
class CompiledScene {
public:
    explicit CompiledScene(const std::shared_ptr<Scene>& scene);

    /// The one of a scene. It lives for as long as a renderer holds it, which holds the scene too.
    static std::shared_ptr<CompiledScene> of(const std::shared_ptr<Scene>& scene);

    const std::shared_ptr<Scene>& scene() const { return _scene; }
    TextureSystem& textures() { return _textures; }
    LightImages& lightImages() { return _lightImages; }
    CompiledMaterials& materials() { return _materials; }
    CompiledShapes& shapes() { return _shapes; }
    CompiledVolumes& volumes() { return _volumes; }
    CompiledSplats& splats() { return _splats; }
    Extents& extents() { return _extents; }
    SubdivisionChoice& subdivision() { return _subdivision; }

    CompiledState compiled(const SceneState& state, const RenderSettings& settings);
    /// The edits between an earlier version and a state.
    /// @returns nothing where that is not known any more: everything may differ
    std::optional<SceneEdits> editsSince(uint64_t version, const SceneState& state);

private:
    std::shared_ptr<Scene> _scene;
    TextureSystem _textures;
    LightImages _lightImages;
    CompiledMaterials _materials;
    CompiledShapes _shapes;
    CompiledVolumes _volumes;
    CompiledSplats _splats;
    Extents _extents;
    SubdivisionChoice _subdivision;

    std::mutex _mutex; ///< guards what follows
    CompiledState _compiled;
    uint64_t _compiledVersion = 0, _usersVersion = 0;
    Names _excludePaths; ///< of _compiled.placements
    bool _usersKnown = false;
    MaterialUsers _users;
};

} // namespace patina
