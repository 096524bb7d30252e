// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/raster/gl/glProgram.h"
#include "hdDelegate/raster/samples/lightSampler.h"
#include "hdDelegate/raster/scene/rasterCamera.h"

#include <memory>
#include <string>
#include <vector>

namespace patina {

/// Lights that are drawn as solid shapes together, within a part of the image.
struct ShownLights {
    int first = 0, count = 0;          ///< of the lights
    int left = 0, bottom = 0;          ///< pixels
    int width = 0, height = 0;         ///< 0: none of the lights is in view
    bool near = false, beyond = false; ///< their depth may not tell which is in front
    bool alone() const { return !near && !beyond; }
};

/// The part of the image that a light's shape covers at most.
/// @param width,height of the image, in pixels
ShownLights shownLight(const GpuLight& light, const mat4& worldToClip, int width, int height);

/// What cameras see where no surface is: domes, and area lights as solid shapes.
class RasterBackground {
public:
    /// Over a target of which colour and depth are cleared; needs the numbers of the pass. Leaves
    /// the lights at binding 4 of storage buffers.
    void draw(const SampledLights& sampled, const RasterView& view, int width, int height);

private:
    std::unique_ptr<GlProgram> _sky = GlProgram::own("background", "background");
    std::unique_ptr<GlProgram> _shapes =
        GlProgram::own("background", "background", "#define LIGHT_SHAPES\n");
    GlBuffer _lights;
};

} // namespace patina
