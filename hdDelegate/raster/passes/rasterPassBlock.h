// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/raster/gl/glFunctions.h"
#include "hdDelegate/raster/scene/rasterScene.h"

#include <algorithm>
#include <cstddef>
#include <iterator>

namespace patina {

#define PATINA_STRUCT PassRows
#define PATINA_FIELDS "shaders/raster/passFields.glsl"
#include "shaders/gpuStruct.inc"

/// The uniform block `Pass` of passBlock.glsl.
struct RasterPassBlock : PassRows {
    static constexpr int maxPlanes = int(std::size(PassRows().clipPlanes)); ///< a camera clips with

    explicit RasterPassBlock(const RasterScene& scene) {
        passOrigin = scene.origin();
        sharedEvery = 1;
    }
    RasterPassBlock(const RasterScene& scene, const RasterView& view) : RasterPassBlock(scene) {
        nearShift = view.fitted;
        farReach = view.reach;
        planes = std::min(int(view.planes.size()), maxPlanes);
        std::copy_n(view.planes.begin(), planes, clipPlanes);
        worldToClip = view.worldToClip;
        clipToWorld = view.clipToWorld;
        isPerspective = view.perspective ? 1 : 0;
        eye = view.eye;
        forward = view.forward;
        pixelSpread = view.pixelSpread;
    }
};

/// Clips what is drawn while it lives.
class RasterClipping {
public:
    explicit RasterClipping(const RasterPassBlock& block) : _planes(block.planes) {
        for (int i = 0; i < _planes; ++i)
            gl.Enable(GL_CLIP_DISTANCE0 + GLenum(i));
    }
    ~RasterClipping() {
        for (int i = 0; i < _planes; ++i)
            gl.Disable(GL_CLIP_DISTANCE0 + GLenum(i));
    }
    RasterClipping(const RasterClipping&) = delete;
    RasterClipping& operator=(const RasterClipping&) = delete;

private:
    int _planes;
};

} // namespace patina
