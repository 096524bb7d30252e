// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/embree/embreeScene.h"
#include "hdDelegate/scene/tests/prims.h"

#include <gtest/gtest.h>

#include <atomic>

namespace patina::test {

/// A scene and what the path tracer makes of it.
struct BuiltScene {
    std::shared_ptr<Scene> owner = std::make_shared<Scene>();
    Scene& scene = *owner;
    Camera camera;
    RenderSettings settings;
    CompiledScene compiled{owner};
    EmbreeScene embree{compiled};
    std::atomic<bool> stop{false};

    Hit hit; ///< the last

    void update() { embree.update(*scene.snapshot(), camera, settings, stop); }
    /// Sets prims in one edit, and builds them.
    template <class... Prims> void set(const Prims&... prims) {
        setPrims(scene, prims...);
        update();
    }
    bool meets(const vec3& origin, const vec3& direction = {0, 0, -1}, float time = 0.0f,
               unsigned rays = RayCamera) {
        return embree.intersect(origin, direction, 0, INFINITY, time, rays, hit);
    }
};

} // namespace patina::test
