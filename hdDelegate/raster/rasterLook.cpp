#include "hdDelegate/raster/rasterLook.h"

namespace patina {

RasterLook::RasterLook(std::string& error) {
    const auto make = [&](const std::string& head) {
        return GlProgram::make(
            {{GL_VERTEX_SHADER, "background", "#include \"shaders/raster/background.vert.glsl\"\n"},
             {GL_FRAGMENT_SHADER, "first look",
              head + "#include \"shaders/raster/firstLook.frag.glsl\"\n"}},
            error);
    };
    _rows = make("#define ROWS\n");
    if (_rows) _columns = make("");
}

bool RasterLook::resize(const GlTexture& color, const GlTexture& depth) {
    const auto make = [&](GLenum format) {
        return GlTexture(GL_TEXTURE_2D, format, color.width(), color.height());
    };
    _noisy = make(GL_RGBA32F);
    _guide = make(GL_RGBA32F);
    _place = make(GL_RGBA32F);
    _normal = make(GL_RGBA16F);
    _rowLight = make(GL_RGBA32F);
    _rowGuide = make(GL_RGBA32F);
    _difference = make(GL_RGBA32F);
    for (const GlTexture* t : {&_noisy, &_guide, &_place, &_normal, &_rowLight, &_rowGuide}) {
        t->parameter(GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        t->parameter(GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    }
    _target = GlFramebuffer({&color, &_noisy, &_guide, &_place, &_normal}, &depth);
    _rowTarget = GlFramebuffer({&_rowLight, &_rowGuide}, nullptr);
    _differenceTarget = GlFramebuffer({&_difference}, &depth);
    return _target.complete() && _rowTarget.complete() && _differenceTarget.complete();
}

void RasterLook::clear() const {
    const float none[4] = {0, 0, 0, 0};
    for (GLint i = 1; i <= 4; ++i)
        gl.ClearNamedFramebufferfv(_target.id(), GL_COLOR, i, none);
    gl.ClearNamedFramebufferfv(_differenceTarget.id(), GL_COLOR, 0, none);
}

void RasterLook::smooth() const {
    gl.Disable(GL_DEPTH_TEST);
    _guide.bind(22);
    _place.bind(23);
    _normal.bind(24);
    _noisy.bind(21);
    _rowTarget.bind();
    _rows->use();
    gl.Uniform4i(0, 1, 0, reach, 0);
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
    _rowLight.bind(21);
    _rowGuide.bind(25);
    _noisy.bind(26);
    _differenceTarget.bind();
    _columns->use();
    gl.Uniform4i(0, 0, 1, reach, 0);
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
    gl.Enable(GL_DEPTH_TEST);
}

void RasterLook::read(std::vector<glm::vec4>& pixels) const {
    pixels.resize(size_t(_difference.width()) * size_t(_difference.height()));
    gl.GetTextureImage(_difference.id(), 0, GL_RGBA, GL_FLOAT,
                       GLsizei(pixels.size() * sizeof(glm::vec4)), pixels.data());
}

} // namespace patina
