// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/passes/rasterRefraction.h"

namespace patina {

RasterRefraction::RasterRefraction() {
    const std::string head = "#define PRIMVARS 0\n";
    _program = GlProgram::own(
        {{GL_VERTEX_SHADER, "surface", head + "#include \"shaders/raster/surface.vert.glsl\"\n"},
         {GL_FRAGMENT_SHADER, "back",
          head + "#include \"shaders/raster/material.glsl\"\n"
                 "#include \"shaders/raster/pass.glsl\"\n"
                 "vec4 materialParameter(int i) { return vec4(0.0); }\n"
                 "MaterialEval materialEvalBut(vec3 wi, int i) { return materialEvalNone(); }\n"
                 "float materialPresence(out vec3 passes) { passes = vec3(1.0); return 1.0; }\n"
                 "#include \"shaders/raster/surface.frag.glsl\"\n"
                 "#include \"shaders/raster/back.frag.glsl\"\n"}});
}

void RasterRefraction::drawVolume(const RasterVolume& volume, int index) const {
    volume.bind();
    _volume->use();
    const vec3 &low = volume.boundsMin, &high = volume.boundsMax;
    gl.UniformMatrix4fv(10, 1, GL_FALSE, &volume.worldToObject[0][0]);
    gl.Uniform3f(14, low.x, low.y, low.z);
    gl.Uniform3f(15, high.x, high.y, high.z);
    gl.Uniform1i(16, index);
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
}

bool RasterRefraction::resize(int width, int height) {
    if (_color.width() == width && _color.height() == height) return true;
    const auto make = [&](GLenum format) {
        GlTexture texture(GL_TEXTURE_2D, format, width, height);
        texture.filter(GL_NEAREST);
        texture.parameter(GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
        texture.parameter(GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
        return texture;
    };
    _color = make(GL_RGBA32F);
    _depth = make(GL_DEPTH_COMPONENT32F);
    _backPosition = make(GL_RGBA32F);
    _backNormal = make(GL_RGBA32F);
    _backDepth = make(GL_DEPTH_COMPONENT32F);
    _target = GlFramebuffer({&_backPosition, &_backNormal}, &_backDepth);
    return _target.complete();
}

void RasterRefraction::beginBacks() const {
    const float none[4] = {0, 0, 0, 0}, far = 1.0f;
    _target.bind();
    gl.ClearNamedFramebufferfv(_target.id(), GL_COLOR, 0, none);
    gl.ClearNamedFramebufferfv(_target.id(), GL_COLOR, 1, none);
    gl.ClearNamedFramebufferfv(_target.id(), GL_DEPTH, 0, &far);
    _program->use();
}

void RasterRefraction::keep(const GlTexture& color, const GlTexture& depth) {
    const auto copy = [](const GlTexture& from, const GlTexture& to) {
        gl.CopyImageSubData(from.id(), GL_TEXTURE_2D, 0, 0, 0, 0, to.id(), GL_TEXTURE_2D, 0, 0, 0,
                            0, to.width(), to.height(), 1);
    };
    copy(color, _color);
    copy(depth, _depth);
}

void RasterRefraction::bind() const {
    _color.bind(21);
    _depth.bind(22);
    _backPosition.bind(23);
    _backNormal.bind(24);
}

} // namespace patina
