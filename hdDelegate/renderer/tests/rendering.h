// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/renderer/renderer.h"

namespace patina {

/// Renders to the end, through "/camera". @returns the film
inline std::shared_ptr<Film> rendered(Renderer& renderer, const std::shared_ptr<Scene>& scene,
                                      const RenderSettings& settings,
                                      std::shared_ptr<Film> film = std::make_shared<Film>()) {
    renderer.start(scene, "/camera", settings, film);
    renderer.wait();
    return film;
}

} // namespace patina
