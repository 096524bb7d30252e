// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/raster/passes/rasterPasses.h"

#include <algorithm>
#include <cstddef>
#include <glm/glm.hpp>
#include <iterator>

namespace patina {

#define PATINA_STRUCT PassRows
#define PATINA_FIELDS "shaders/raster/passFields.glsl"
#include "shaders/gpuStruct.inc"

/// The uniform block `Pass` of passBlock.glsl.
struct RasterPasses::PassBlock : PassRows {
    PassBlock() { sharedEvery = 1; }
};
static_assert(std::size(PassRows().clipPlanes) == size_t(RasterPasses::maxPlanes));

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
