// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/raster/gl/glResources.h"
#include "hdDelegate/raster/lights/lightCells.h"

#include <vector>

namespace patina {

/// What shaders/raster/manyLights.glsl reads, on the GPU. Lives with one context.
class RasterManyLights {
public:
    /// Uploads what a pass needs and binds it: 5 of uniform blocks, 26 of textures.
    void bind(const std::vector<LightEstimate>& estimates, const LightCells& cells, size_t lights);

private:
    GlBuffer _estimates;
    GlTexture _lists;
};

} // namespace patina
