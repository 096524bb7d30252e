// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/scene/scene.h"

#include <map>
#include <optional>
#include <set>
#include <string>

namespace patina {

/// Which geometry is bound to which material, kept up with a scene by what its edits touch.
class MaterialUsers {
public:
    /// Brings the index to a state.
    /// @param delta from the state of the call before; nothing: all prims are looked at
    void update(const SceneState& state, const std::optional<SceneDelta>& delta);
    /// Paths of prims with the material, or with a subset that has it.
    const std::set<std::string>& of(const std::string& material) const;

private:
    void bind(const Geometry& prim);
    void unbind(const std::string& path);

    std::map<std::string, std::set<std::string>> _users;     ///< by material
    std::map<std::string, std::set<std::string>> _materials; ///< by prim; without those of none
};

} // namespace patina
