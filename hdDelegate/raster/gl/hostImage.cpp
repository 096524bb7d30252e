// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/gl/hostImage.h"

#include "hdDelegate/raster/gl/glDownload.h"

namespace patina {

namespace {

/// Marks the end of this context's commands, for those of another.
void mark(GLsync& fence) {
    if (fence) gl.DeleteSync(fence);
    fence = gl.FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    gl.Flush(); // what another context waits for has to be under way
}

/// Those of the host, of which OpenGL keeps one of each kind. A lost context has one for ever.
void forgetErrors() {
    constexpr int kinds = 8;
    for (int i = 0; i < kinds && gl.GetError() != GL_NO_ERROR;)
        ++i;
}

void wait(GLsync fence) {
    if (fence) gl.WaitSync(fence, 0, GL_TIMEOUT_IGNORED);
}

} // namespace

PixelTransfer::PixelTransfer(GLenum textureFormat, int components) {
    const GLenum formats[4] = {GL_RED, GL_RG, GL_RGB, GL_RGBA};
    const bool half = textureFormat == GL_RGBA16F || textureFormat == GL_R16F;
    const bool id = textureFormat == GL_R32I;
    format = id                                       ? GL_RED_INTEGER
             : textureFormat == GL_DEPTH_COMPONENT32F ? GL_DEPTH_COMPONENT
                                                      : formats[components - 1];
    type = id ? GL_INT : half ? GL_HALF_FLOAT : GL_FLOAT;
    size = size_t(components) * (half ? 2 : 4);
}

HostImage::HostImage(std::shared_ptr<HostContext> host, GLenum format, int components, int width,
                     int height)
    : _host(std::move(host)), _format(format), _components(components),
      _texture(GL_TEXTURE_2D, format, width, height) {}

HostImage::~HostImage() {
    const bool gone = _host->use([this] {
        for (const GLsync fence : {_drawn, _read})
            if (fence) gl.DeleteSync(fence);
        _texture = GlTexture();
    });
    if (!gone) _texture.abandon();
}

void HostImage::waitForReaders() {
    const std::lock_guard<std::mutex> lock(_mutex);
    wait(_read);
}

void HostImage::setDrawn() {
    const std::lock_guard<std::mutex> lock(_mutex);
    mark(_drawn);
}

bool HostImage::copyTo(uint64_t texture) {
    const std::lock_guard<std::mutex> lock(_mutex);
    const bool known = texture == _copiedTo; // that it fits was seen
    if (!known) forgetErrors();
    wait(_drawn);
    gl.CopyImageSubData(_texture.id(), GL_TEXTURE_2D, 0, 0, 0, 0, GLuint(texture), GL_TEXTURE_2D, 0,
                        0, 0, 0, _texture.width(), _texture.height(), 1);
    mark(_read);
    if (!known && gl.GetError() != GL_NO_ERROR) return false;
    _copiedTo = texture;
    return true;
}

bool HostImage::read(void* bytes) {
    const std::lock_guard<std::mutex> lock(_mutex);
    bool fine = false;
    const bool used = _host->use([&] {
        const PixelTransfer pixels(_format, _components);
        forgetErrors();
        GLint alignment = 4, buffer = 0;
        gl.GetIntegerv(GL_PACK_ALIGNMENT, &alignment);
        gl.GetIntegerv(GL_PIXEL_PACK_BUFFER_BINDING, &buffer);
        wait(_drawn);
        GlDownload().read(_texture, pixels.format, pixels.type,
                          pixels.size * size_t(_texture.width()) * size_t(_texture.height()),
                          bytes);
        fine = gl.GetError() == GL_NO_ERROR;
        gl.PixelStorei(GL_PACK_ALIGNMENT, alignment);
        gl.BindBuffer(GL_PIXEL_PACK_BUFFER, GLuint(buffer));
    });
    return used && fine;
}

} // namespace patina
