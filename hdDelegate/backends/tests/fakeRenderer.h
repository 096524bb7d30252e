// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/renderer/renderLoop.h"

#include <functional>
#include <random>

namespace patina {

/// Renders what a function says, pixel by pixel, and does as told: a renderer without a scene.
class FakeRenderer : public RenderLoop {
public:
    using Shade = std::function<glm::vec3(int x, int y, std::mt19937& random)>;

    struct Plan {
        std::string backend;
        Shade shade;
        int failAfter = -1; ///< passes; -1: never
        bool deviceFails = true;
        int millisecondsPerPass = 0;
        bool onDevice = false; ///< the listener's film has a source, but at the end
    };

    explicit FakeRenderer(const Plan& plan) : RenderLoop(plan.backend), _plan(plan) {}
    ~FakeRenderer() override { stop(); }

    std::atomic<int> starts{0};

private:
    void prepareAndRender(const SceneState&, const std::string&) override;
    void render(const SceneState&, const Camera&) override {}

    Plan _plan;
};

} // namespace patina
