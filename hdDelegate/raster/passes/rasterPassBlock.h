// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/raster/passes/rasterPasses.h"

#include <algorithm>

namespace patina {

/// The uniform block `Pass` of passBlock.glsl.
struct RasterPasses::PassBlock {
    mat4 worldToClip{1.0f}, clipToWorld{1.0f};
    vec4 eye{0.0f}, forward{0.0f};
    int counts[4] = {0, 0, 0, 0};
    vec4 extra{0.0f};
    int lightInfo[4] = {0, 0, 0, 0};
    vec4 origin{0.0f}, range{0.0f};
    vec4 clipPlanes[RasterPasses::maxPlanes];
    int look[4] = {0, 0, 0, 1};
};

/// Clips what is drawn while it lives.
class RasterPasses::Clipping {
public:
    explicit Clipping(const RasterView& view) : _planes(planesOf(view)) {
        for (int i = 0; i < _planes; ++i)
            gl.Enable(GL_CLIP_DISTANCE0 + GLenum(i));
    }
    ~Clipping() {
        for (int i = 0; i < _planes; ++i)
            gl.Disable(GL_CLIP_DISTANCE0 + GLenum(i));
    }
    Clipping(const Clipping&) = delete;
    Clipping& operator=(const Clipping&) = delete;
    static int planesOf(const RasterView& view) {
        return std::min(int(view.planes.size()), maxPlanes);
    }

private:
    int _planes;
};

} // namespace patina
