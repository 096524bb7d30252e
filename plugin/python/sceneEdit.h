// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/scene/scene.h"

namespace patina {

struct SceneHolder {
    std::shared_ptr<Scene> scene;
};

/// An edit that keeps its scene alive: the scene is a base, and so outlives the commit of
/// ~SceneEdit.
struct PythonEdit : SceneHolder, SceneEdit {
    explicit PythonEdit(std::shared_ptr<Scene> s) : SceneHolder{s}, SceneEdit(*s) {}
};

} // namespace patina
