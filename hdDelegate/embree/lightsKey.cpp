// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/lightsKey.h"

#include "hdDelegate/scene/settingRows.h"

namespace patina {

LightsKey makeLightsKey(const SceneState& state, const EmbreeScene& scene, const Camera& camera,
                        const RenderSettings& settings) {
    LightsKey key;
    key.numbers = {camera.shutterOpen, camera.shutterClose, scene.origin().x, scene.origin().y,
                   scene.origin().z};
    for (const SettingRow& setting : settingRows())
        if (setting.ofLights) key.numbers.push_back(setting.number(settings));
    bool inGroups = false;
    for (const auto& item : state.lights) {
        const Light& light = *item.second;
        key.objects.push_back(item.second);
        inGroups |= !light.group.empty();
        if (light.type != LightType::Mesh) continue;
        const auto surface = scene.surfaces().find(light.geometry);
        key.objects.push_back(surface);
        if (!surface) continue;
        inGroups |= !surface->prim->group.empty();
        for (const MaterialSlot& slot : surface->materials)
            key.objects.push_back(slot.program);
    }
    const auto append = [&](const auto& list) {
        key.objects.insert(key.objects.end(), list.begin(), list.end());
    };
    append(scene.surfaces().emissiveSources());
    if (inGroups) append(scene.places().placements()->drawn());
    return key;
}

} // namespace patina
