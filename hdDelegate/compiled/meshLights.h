// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/scene/scene.h"
#include "hdDelegate/scene/settings.h"

#include <map>
#include <memory>
#include <string>

namespace patina {

/// The mesh lights of a scene by the mesh that each makes glow. Immutable.
class MeshLights {
public:
    explicit MeshLights(const SceneState& state);

    /// Whether any light names the mesh, be it on or off.
    bool names(const std::string& mesh) const { return _lights.count(mesh) > 0; }
    /// The light of a mesh that gives light: of several the last by its path. Null for none.
    std::shared_ptr<const Light> of(const std::string& mesh, const RenderSettings& settings) const;
    bool operator==(const MeshLights& other) const { return _lights == other._lights; }

private:
    std::map<std::string, std::vector<std::shared_ptr<const Light>>> _lights;
};

} // namespace patina
