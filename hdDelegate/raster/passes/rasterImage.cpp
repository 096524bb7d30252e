// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/passes/rasterImage.h"

#include "hdDelegate/raster/gl/deviceError.h"
#include "hdDelegate/raster/gl/glContext.h"
#include "hdDelegate/raster/passes/previewPasses.h"

#include <algorithm>

namespace patina {

bool RasterImage::begin(int width, int height, const int window[4], const RasterCamera& camera,
                        const GlTexture& places, const GlTexture& ids) {
    _camera = std::make_unique<RasterCamera>(camera);
    _placesDrawn = &places;
    _idsDrawn = &ids;
    _window[0] = window[0];
    _window[1] = height - 1 - window[3];
    _window[2] = window[2];
    _window[3] = height - 1 - window[1];
    _passes = 0;
    _weight = 0.0f;
    _hasFirst = _negative = false;
    if (width != _width || height != _height) {
        const auto make = [&] { return GlTexture(GL_TEXTURE_2D, GL_RGBA32F, width, height); };
        _sums = make();
        _smoothings = make();
        _first = make();
        _sumTarget = GlFramebuffer({&_sums, &_smoothings}, nullptr);
        _firstTarget = GlFramebuffer({&_first}, nullptr);
        _complete = _sumTarget.complete() && _firstTarget.complete();
        _targets.clear();
        _hostTargets.clear();
        _width = width;
        _height = height;
        // Those that hosts ask for as a rule: that there is no room shows before anything is drawn.
        for (const GLenum format : {GL_RGBA16F, GL_R32F, GL_R32I})
            _complete = target(format).complete && _complete;
    }
    const float none[4] = {0, 0, 0, 0};
    for (GLint i = 0; i < 2; ++i)
        gl.ClearNamedFramebufferfv(_sumTarget.id(), GL_COLOR, i, none);
    gl.ClearNamedFramebufferfv(_firstTarget.id(), GL_COLOR, 0, none);
    return _complete;
}

void RasterImage::add(const GlTexture& color, const GlTexture* difference,
                      const RasterSample& sample, bool first, bool negative) {
    if (sample.pass == 0) _hasFirst = first;
    _negative = negative;
    // A film counts the mean without the first image for as many passes as there were with it.
    const float whole = float(PreviewPasses::smoothed);
    const float weight =
        _hasFirst && _passes >= PreviewPasses::smoothed ? (whole - 1.0f) / whole : 1.0f;
    if (!first) _weight += weight;
    ++_passes;
    (first ? _firstTarget : _sumTarget).bind();
    gl.Viewport(0, 0, _width, _height);
    gl.Disable(GL_DEPTH_TEST);
    gl.Enable(GL_BLEND);
    gl.BlendFunc(GL_ONE, GL_ONE);
    color.bind(0);
    (difference ? *difference : color).bind(1); // not what is drawn into
    _accumulate->use();
    gl.Uniform4i(0, _window[0], _window[1], _window[2], _window[3]);
    gl.Uniform4i(1, sample.border(), !difference ? 0 : first ? 2 : 1, negative ? 1 : 0, 0);
    for (size_t i = 0; i < sample.splatX.size(); ++i)
        gl.Uniform2f(2 + GLint(i), weight * sample.splatX[i], sample.splatY[i]);
    gl.BindVertexArray(_vertexArray.id());
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
    gl.BlendFunc(GL_ONE, GL_ZERO);
    gl.Disable(GL_BLEND);
}

bool RasterImage::has(AovId aov) const {
    switch (aov) {
    case AovId::color:
    case AovId::alpha:
    case AovId::deviceDepth:
    case AovId::depth:
    case AovId::cameraDepth:
    case AovId::primId:
    case AovId::instanceId:
    case AovId::elementId: return true;
    default: return false;
    }
}

const RasterImage::Target& RasterImage::target(GLenum format) const {
    Target& target = _targets[format];
    if (!target.image) {
        target.format = format;
        target.image = GlTexture(GL_TEXTURE_2D, format, _width, _height);
        target.framebuffer = GlFramebuffer({&target.image}, nullptr);
        target.complete = target.framebuffer.complete();
    }
    return target;
}

namespace {

bool isId(AovId aov) {
    return aov == AovId::primId || aov == AovId::instanceId || aov == AovId::elementId;
}

/// Of the textures that hold a form.
GLenum formatOf(AovId aov, const PixelForm& form) {
    const bool many = aov == AovId::color, half = form.type == PixelForm::Type::Half;
    if (isId(aov)) return GL_R32I;
    if (form.depth) return GL_DEPTH_COMPONENT32F;
    return half ? (many ? GL_RGBA16F : GL_R16F) : (many ? GL_RGBA32F : GL_R32F);
}

} // namespace

bool RasterImage::canDraw(AovId aov, const PixelForm& form) const {
    return has(aov) && _width > 0 && isId(aov) == (form.type == PixelForm::Type::Int) &&
           (aov == AovId::color || form.components == 1);
}

void RasterImage::drawInto(const GlFramebuffer& framebuffer, AovId aov,
                           const PixelForm& form) const {
    const bool id = isId(aov), half = form.type == PixelForm::Type::Half;
    framebuffer.bind();
    gl.Viewport(0, 0, _width, _height);
    if (form.depth) {
        gl.Enable(GL_DEPTH_TEST);
        gl.DepthFunc(GL_ALWAYS);
        gl.DepthMask(GL_TRUE);
    } else {
        gl.Disable(GL_DEPTH_TEST);
    }
    _sums.bind(0);
    _smoothings.bind(1);
    _first.bind(2);
    _placesDrawn->bind(3);
    _idsDrawn->bind(4);
    (id ? _ids : form.depth ? _depths : _numbers)->use();
    const int wanted = aov == AovId::color         ? Color
                       : aov == AovId::alpha       ? Alpha
                       : aov == AovId::deviceDepth ? WindowDepth
                       : aov == AovId::depth       ? AxisDepth
                                                   : CentreDepth;
    const int last = !id ? int(half) : aov == AovId::primId ? 0 : aov == AovId::instanceId ? 1 : 2;
    gl.Uniform4i(0, _window[0], _window[1], _window[2], _window[3]);
    gl.Uniform4i(1, wanted, form.bottomFirst ? 0 : 1, _negative ? 1 : 0, last);
    if (id) {
        gl.Uniform1i(3, glm::floatBitsToInt(form.nothing));
    } else {
        gl.Uniform4f(2, _weight, _hasFirst ? 0.0f : PreviewPasses::share(_passes),
                     !_hasFirst    ? 0.0f
                     : _passes < 2 ? 1.0f
                                   : PreviewPasses::shareOfFirst(_passes),
                     0.0f);
        const vec4 other = aov == AovId::color ? form.background : vec4(form.nothing);
        gl.Uniform4f(3, other.x, other.y, other.z, other.w);
        const CameraFrame& frame = _camera->frame();
        gl.UniformMatrix4fv(4, 1, GL_FALSE, &_camera->worldToCamera()[0][0]);
        gl.Uniform4f(8, frame.clipNear, frame.clipFar, frame.orthographic ? 1.0f : 0.0f,
                     frame.radial ? 1.0f : 0.0f);
    }
    gl.BindVertexArray(_vertexArray.id());
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
    if (form.depth) {
        gl.DepthFunc(GL_LESS);
        gl.Disable(GL_DEPTH_TEST);
    }
}

bool RasterImage::read(AovId aov, const PixelForm& form, void* bytes) const {
    if (!canDraw(aov, form) || form.depth) return false;
    const GlContext::Use use(_context);
    if (!use.ok()) throw DeviceError("the OpenGL context cannot be used");
    const Target& to = target(formatOf(aov, form));
    if (!to.complete) throw DeviceError("the driver has no room for an image of this size");
    drawInto(to.framebuffer, aov, form);
    const PixelTransfer pixels(to.format, form.components);
    _download.read(to.image, pixels.format, pixels.type,
                   pixels.size * size_t(_width) * size_t(_height), bytes);
    if (gl.GetError() != GL_NO_ERROR) throw DeviceError("the driver gives no image");
    return true;
}

const RasterImage::HostTarget& RasterImage::hostTarget(GLenum format, int components) const {
    for (const HostTarget& target : _hostTargets)
        if (target.image.use_count() == 1 && target.image->isOf(format, components)) return target;
    HostTarget made;
    made.image = std::make_shared<HostImage>(_host, format, components, _width, _height);
    made.framebuffer = format == GL_DEPTH_COMPONENT32F
                           ? GlFramebuffer({}, &made.image->texture())
                           : GlFramebuffer({&made.image->texture()}, nullptr);
    if (!made.framebuffer.complete())
        throw DeviceError("the driver has no room for an image of this size");
    _hostTargets.push_back(std::move(made));
    return _hostTargets.back();
}

std::shared_ptr<DeviceImage> RasterImage::draw(AovId aov, const PixelForm& form) const {
    if (!_host || !canDraw(aov, form) ||
        (form.depth && (form.type != PixelForm::Type::Float || aov == AovId::color)))
        return nullptr;
    const GlContext::Use use(_context);
    if (!use.ok()) throw DeviceError("the OpenGL context cannot be used");
    const HostTarget& to = hostTarget(formatOf(aov, form), form.components);
    to.image->waitForReaders();
    drawInto(to.framebuffer, aov, form);
    to.image->setDrawn();
    if (gl.GetError() != GL_NO_ERROR) throw DeviceError("the driver draws no image");
    return to.image;
}

} // namespace patina
