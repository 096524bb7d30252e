// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/scene/scene.h"
#include "hdDelegate/scene/settings.h"

#include <glm/gtc/matrix_transform.hpp>

namespace patina {

inline mat4 translate(float x, float y, float z) {
    return glm::translate(mat4(1.0f), vec3(x, y, z));
}
inline mat4 scaled(float scale) {
    return glm::scale(mat4(1.0f), vec3(scale));
}

template <class Prim> std::shared_ptr<Prim> makePrim(const std::string& path) {
    auto prim = std::make_shared<Prim>();
    prim->path = path;
    return prim;
}
template <class Prim>
std::shared_ptr<Prim> makePrim(const std::string& path, const MotionTransform& transform) {
    auto prim = makePrim<Prim>(path);
    prim->transform = transform;
    return prim;
}

inline Primvar makePrimvar(const std::string& name, Interpolation interpolation, int components,
                           std::vector<float> values, std::vector<int> indices = {}) {
    Primvar primvar;
    primvar.name = name;
    primvar.interpolation = interpolation;
    primvar.components = components;
    primvar.values = std::move(values);
    primvar.indices = std::move(indices);
    return primvar;
}

/// A square around a place, facing +z.
inline std::shared_ptr<Mesh> makeQuad(const std::string& path, const std::string& group = "",
                                      const vec2& middle = vec2(0.0f), float half = 1.0f) {
    auto mesh = makePrim<Mesh>(path);
    mesh->group = group;
    mesh->points = std::vector<vec3>();
    for (const vec2& corner : {vec2(-1, -1), vec2(1, -1), vec2(1, 1), vec2(-1, 1)})
        mesh->points.values[0].emplace_back(middle + half * corner, 0.0f);
    mesh->faceVertexCounts = {4};
    mesh->faceVertexIndices = {0, 1, 2, 3};
    return mesh;
}

inline std::shared_ptr<Instancer> makeInstancer(const std::string& path, const std::string& group,
                                                const std::string& prototype,
                                                const std::vector<mat4>& transforms) {
    auto instancer = makePrim<Instancer>(path);
    instancer->group = group;
    instancer->prototypes = {prototype};
    instancer->transforms.assign(transforms.begin(), transforms.end());
    instancer->prototypeIndices.assign(transforms.size(), 0);
    return instancer;
}

inline std::shared_ptr<Light> makeLight(const std::string& path, LightType type) {
    auto light = makePrim<Light>(path);
    light->type = type;
    return light;
}

/// @param nodes the first is the one on the terminal
inline std::shared_ptr<MaterialPrim> makeMaterial(const std::string& path,
                                                  std::vector<NetworkNode> nodes,
                                                  const std::string& terminal = "surface") {
    auto material = makePrim<MaterialPrim>(path);
    material->network.path = path;
    material->network.terminals[terminal] = {nodes.at(0).path, ""};
    material->network.nodes = std::move(nodes);
    return material;
}

inline RenderSettings imageOf(int width, int height, int samples = RenderSettings().samples) {
    RenderSettings settings;
    settings.width = width;
    settings.height = height;
    settings.samples = samples;
    return settings;
}

/// Sets prims in one edit.
template <class... Prims> void setPrims(Scene& scene, const Prims&... prims) {
    SceneEdit edit = scene.edit();
    (edit.set(prims), ...);
}

template <class... Prims> std::shared_ptr<Scene> sceneOf(const Prims&... prims) {
    auto scene = std::make_shared<Scene>();
    setPrims(*scene, prims...);
    return scene;
}

} // namespace patina
