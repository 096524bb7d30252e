// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/embree/embreeScene.h"

namespace patina {

/// Everything that SceneLights is made from: as long as two keys are equal, so are the lights. The
/// key keeps alive what the lights point to.
struct LightsKey {
    std::vector<std::shared_ptr<const void>> objects;
    std::vector<double> numbers;

    bool operator==(const LightsKey& other) const {
        return objects == other.objects && numbers == other.numbers;
    }
};

LightsKey makeLightsKey(const SceneState& state, const EmbreeScene& scene, const Camera& camera,
                        const RenderSettings& settings);

} // namespace patina
