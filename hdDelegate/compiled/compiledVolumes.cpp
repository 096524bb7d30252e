// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/compiled/compiledVolumes.h"

namespace patina {

std::shared_ptr<const MaterialProgram> CompiledVolumes::plain() {
    std::call_once(_plainMade, [this] { _plain = _materials.compile(plainVolume()); });
    return _plain;
}

std::shared_ptr<const VolumeMedium>
CompiledVolumes::medium(const std::shared_ptr<const Volume>& prim, const SceneState& state,
                        const RenderSettings& settings) {
    Request request{prim, nullptr};
    if (settings.enableSceneMaterials) {
        const auto found = state.materials.find(prim->material);
        if (found != state.materials.end())
            request.program =
                _materials.program(found->second, settings.methods, settings.tolerance);
        if (!request.program || !request.program->hasInterior()) {
            _diagnostics.warn(prim->path, "material:binding",
                              prim->material.empty()
                                  ? messages::volumeWithoutMaterial()
                                  : messages::volumeMaterialUnusable(prim->material));
            request.program = nullptr;
        }
    }
    if (!request.program) request.program = plain();
    return _media.get(prim.get(), request, [&] {
        return std::make_shared<const VolumeMedium>(*prim, request.program, _diagnostics, &_grids);
    });
}

} // namespace patina
