// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/passes/rasterLook.h"

namespace patina {

RasterLook::RasterLook(std::string& error) {
    _program = GlProgram::make(
        {{GL_VERTEX_SHADER, "background", "#include \"shaders/raster/background.vert.glsl\"\n"},
         {GL_FRAGMENT_SHADER, "first look", "#include \"shaders/raster/firstLook.frag.glsl\"\n"}},
        error);
}

bool RasterLook::resize(const GlTexture& color, const GlTexture& depth) {
    const auto make = [&](GLenum format) {
        return GlTexture(GL_TEXTURE_2D, format, color.width(), color.height());
    };
    _noisy = make(GL_RGBA32F);
    _guide = make(GL_RGBA32F);
    _place = make(GL_RGBA32F);
    _normal = make(GL_RGBA16F);
    _difference = make(GL_RGBA32F);
    for (const GlTexture* t : {&_noisy, &_guide, &_place, &_normal}) {
        t->parameter(GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        t->parameter(GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    }
    _target = GlFramebuffer({&color, &_noisy, &_guide, &_place, &_normal}, &depth);
    _differenceTarget = GlFramebuffer({&_difference}, &depth);
    return _target.complete() && _differenceTarget.complete();
}

void RasterLook::clear() const {
    const float none[4] = {0, 0, 0, 0};
    for (GLint i = 1; i <= 4; ++i)
        gl.ClearNamedFramebufferfv(_target.id(), GL_COLOR, i, none);
    gl.ClearNamedFramebufferfv(_differenceTarget.id(), GL_COLOR, 0, none);
}

void RasterLook::smooth() const {
    gl.Disable(GL_DEPTH_TEST);
    _noisy.bind(21);
    _guide.bind(22);
    _place.bind(23);
    _normal.bind(24);
    _differenceTarget.bind();
    _program->use();
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
    gl.Enable(GL_DEPTH_TEST);
}

void RasterLook::read(std::vector<glm::vec4>& pixels, GlDownload& download) const {
    pixels.resize(size_t(_difference.width()) * size_t(_difference.height()));
    download.read(_difference, GL_RGBA, GL_FLOAT, pixels.size() * sizeof(glm::vec4), pixels.data());
}

} // namespace patina
