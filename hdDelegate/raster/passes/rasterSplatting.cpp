// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/passes/rasterSplatting.h"

#include "hdDelegate/raster/gl/deviceError.h"

namespace patina {

void RasterSplatting::sort(const RasterSplats& splats, const RasterView& view, int width,
                           int height) {
    const SplatTiles tiles(splats.placed(), view, width, height, RasterSplats::mostEntries());
    _entries = GlBuffer(tiles.entries);
    _tiles = GlBuffer(tiles.first);
    _side = tiles.side;
    _across = tiles.across;
    _width = width;
    _height = height;
}

void RasterSplatting::bind(const RasterSplats& splats, const GlTexture& depth, int stage) const {
    splats.bind();
    _entries.bindStorage(3);
    _tiles.bindStorage(6);
    depth.bind(0);
    gl.Uniform4i(0, _side, _across, stage, 0);
    gl.Viewport(0, 0, _width, _height);
    gl.Disable(GL_DEPTH_TEST);
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
    gl.Enable(GL_DEPTH_TEST);
}

void RasterSplatting::find(const RasterSplats& splats, const GlTexture& depth,
                           const GlTexture* behind) {
    if (!_color) {
        _color = GlProgram::own("background", "splats");
        _over = GlProgram::own("background", "splatsOver");
    }
    if (_light.width() != _width || _light.height() != _height) {
        _light = GlTexture(GL_TEXTURE_2D, GL_RGBA32F, _width, _height);
        _left = GlTexture(GL_TEXTURE_2D, GL_RG32F, _width, _height);
        _target = GlFramebuffer({&_light, &_left}, nullptr);
        if (!_target.complete()) throw DeviceError("the driver has no room for the splats");
    }
    _target.bind();
    (behind ? *behind : depth).bind(1);
    _stage = behind ? 1 : 0;
    _color->use();
    bind(splats, depth, _stage);
}

void RasterSplatting::draw(Over what) const {
    _light.bind(0);
    _left.bind(1);
    _over->use();
    const bool alone = what == Over::AnyFactorsAlone;
    gl.Uniform4i(0, alone ? -1 : _stage, alone ? 1 : 0, 0, 0);
    gl.Disable(GL_DEPTH_TEST);
    gl.Enable(GL_BLEND);
    gl.BlendFunc(GL_ONE, GL_SRC1_COLOR);
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
    gl.BlendFunc(GL_ONE, GL_ZERO);
    gl.Disable(GL_BLEND);
    gl.Enable(GL_DEPTH_TEST);
}

void RasterSplatting::drawAovs(const RasterSplats& splats, const GlTexture& depth, int others) {
    auto& program = _aovs[others];
    if (!program)
        program =
            GlProgram::own("background", "splats", "#define AOVS " + std::to_string(others) + "\n");
    program->use();
    bind(splats, depth, 0);
}

} // namespace patina
