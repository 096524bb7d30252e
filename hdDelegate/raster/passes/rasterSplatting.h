// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/raster/gl/glProgram.h"
#include "hdDelegate/raster/passes/splatTiles.h"

#include <map>

namespace patina {

/// Draws splats over pictures, with the numbers of the pass that is bound. Lives with one context.
class RasterSplatting {
public:
    /// Sorts the kernels for a view.
    /// @param width, height of what is drawn into
    void sort(const RasterSplats& splats, const RasterView& view, int width, int height);
    /// Finds what the kernels before the depths show.
    /// @param behind null, or depths: only pixels that are before them are drawn anew
    void find(const RasterSplats& splats, const GlTexture& depth, const GlTexture* behind);
    /// Draws what find() has found, in its last call or in any, over a target without depths.
    enum class Over { Last, AnyFactorsAlone };
    void draw(Over what) const;
    /// Draws ids and places over a target without depths.
    /// @param others targets after the three of shaders/raster/splats.frag.glsl
    void drawAovs(const RasterSplats& splats, const GlTexture& depth, int others);

private:
    void bind(const RasterSplats& splats, const GlTexture& depth, int stage) const;

    std::unique_ptr<GlProgram> _color, _over;
    std::map<int, std::unique_ptr<GlProgram>> _aovs; ///< by other targets
    GlBuffer _entries, _tiles;
    int _side = 0, _across = 0, _width = 0, _height = 0, _stage = 0;
    GlTexture _light, _left;
    GlFramebuffer _target;
};

} // namespace patina
