// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/compiled/materialUsers.h"

namespace patina {

void MaterialUsers::bind(const Geometry& prim) {
    std::set<std::string> materials;
    if (!prim.material.empty()) materials.insert(prim.material);
    for (const GeomSubset& subset : prim.subsets)
        if (!subset.material.empty()) materials.insert(subset.material);
    if (materials.empty()) return;
    for (const std::string& material : materials)
        _users[material].insert(prim.path);
    _materials[prim.path] = std::move(materials);
}

void MaterialUsers::unbind(const std::string& path) {
    const auto found = _materials.find(path);
    if (found == _materials.end()) return;
    for (const std::string& material : found->second) {
        const auto users = _users.find(material);
        users->second.erase(path);
        if (users->second.empty()) _users.erase(users);
    }
    _materials.erase(found);
}

void MaterialUsers::update(const SceneState& state, const std::optional<SceneDelta>& delta) {
    if (!delta) {
        _users.clear();
        _materials.clear();
        for (const auto& item : state.geometry)
            bind(*item.second);
        return;
    }
    for (const auto& [path, edit] : delta->geometry) {
        unbind(path);
        const auto prim = state.geometry.find(path);
        if (prim != state.geometry.end()) bind(*prim->second);
    }
}

const std::set<std::string>& MaterialUsers::of(const std::string& material) const {
    static const std::set<std::string> none;
    const auto found = _users.find(material);
    return found == _users.end() ? none : found->second;
}

} // namespace patina
