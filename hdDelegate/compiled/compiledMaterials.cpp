// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/compiled/compiledMaterials.h"

namespace patina {

std::shared_ptr<const MaterialPrim> CompiledMaterials::find(const std::string& path,
                                                            const std::string& user,
                                                            const SceneState& state,
                                                            const RenderSettings& settings) const {
    if (path.empty() || !settings.enableSceneMaterials) return nullptr;
    const auto found = state.materials.find(path);
    if (found != state.materials.end()) return found->second;
    _diagnostics.warn(user, "material:binding", messages::materialMissing(path));
    return nullptr;
}

std::shared_ptr<const MaterialProgram>
CompiledMaterials::program(const std::shared_ptr<const MaterialPrim>& prim,
                           const MethodChoices& methods, double tolerance) {
    const RenderingSpace& space = *_renderingSpace;
    return _programs.get(prim.get(), {prim, methods, tolerance, &space}, [&] {
        return compileMaterial(prim && !prim->network.empty() ? prim->network
                                                              : makeDisplayColorNetwork(),
                               _textures, _diagnostics, methods, tolerance, space);
    });
}

void CompiledMaterials::tellOfSpaces(const MaterialProgram& program, const Geometry& prim) const {
    for (const MaterialPrimvar& primvar : program.primvars()) {
        const std::string space = spaceOfPrimvar(primvar.name);
        const bool isFirst = !space.empty() && primvar.name == spacePrimvar(space, 0);
        if (isFirst && !prim.primvar(primvar.name))
            _diagnostics.warn(prim.path, "coordSys:" + space, messages::coordSysNotBound());
    }
}

} // namespace patina
