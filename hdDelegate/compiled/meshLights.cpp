// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/compiled/meshLights.h"

namespace patina {

MeshLights::MeshLights(const SceneState& state) {
    for (const auto& item : state.lights)
        if (item.second->type == LightType::Mesh)
            _lights[item.second->geometry].push_back(item.second);
}

std::shared_ptr<const Light> MeshLights::of(const std::string& mesh,
                                            const RenderSettings& settings) const {
    std::shared_ptr<const Light> result;
    const auto found = _lights.find(mesh);
    if (found != _lights.end() && settings.enableSceneLights)
        for (const auto& light : found->second)
            if (light->visible) result = light;
    return result;
}

} // namespace patina
