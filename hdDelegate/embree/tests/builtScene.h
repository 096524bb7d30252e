// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/embree/embreeScene.h"

#include <glm/gtc/matrix_transform.hpp>

#include <atomic>

namespace patina::test {

inline std::shared_ptr<Mesh> makeQuad(const std::string& path, const std::string& group = "") {
    auto mesh = std::make_shared<Mesh>();
    mesh->path = path;
    mesh->group = group;
    mesh->points = std::vector<vec3>{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    mesh->faceVertexCounts = {4};
    mesh->faceVertexIndices = {0, 1, 2, 3};
    return mesh;
}

inline std::shared_ptr<Instancer> makeInstancer(const std::string& path, const std::string& group,
                                                const std::string& prototype,
                                                const std::vector<mat4>& transforms) {
    auto instancer = std::make_shared<Instancer>();
    instancer->path = path;
    instancer->group = group;
    instancer->prototypes = {prototype};
    for (const mat4& m : transforms) {
        instancer->transforms.push_back(m);
        instancer->prototypeIndices.push_back(0);
    }
    return instancer;
}

inline mat4 translate(float x, float y, float z) {
    return glm::translate(mat4(1.0f), vec3(x, y, z));
}

/// A scene and what the path tracer makes of it.
struct BuiltScene {
    std::shared_ptr<Scene> owner = std::make_shared<Scene>();
    Scene& scene = *owner;
    Camera camera;
    RenderSettings settings;
    CompiledScene compiled{owner};
    EmbreeScene embree{compiled};
    std::atomic<bool> stop{false};

    void update() { embree.update(*scene.snapshot(), camera, settings, stop); }
};

} // namespace patina::test
