// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/gl/glResources.h"

#include "hdDelegate/raster/gl/glFaults.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>

namespace patina {

GlBuffer::GlBuffer(size_t size, const void* data) : _size(std::max(size, minSize)) {
    gl.CreateBuffers(1, &_id);
    // The driver reads as much as the buffer holds, which may be more than there is.
    unsigned char padded[minSize] = {};
    const bool pads = size < minSize && size > 0 && data;
    if (pads) std::memcpy(padded, data, size);
    gl.NamedBufferStorage(_id, GLsizeiptr(_size),
                          size == 0 ? nullptr
                          : pads    ? padded
                                    : data,
                          GL_DYNAMIC_STORAGE_BIT);
}

GlBuffer::~GlBuffer() {
    if (_id) gl.DeleteBuffers(1, &_id);
}

void GlBuffer::write(const void* data, size_t size, size_t offset) {
    gl.NamedBufferSubData(_id, GLintptr(offset), GLsizeiptr(size), data);
}

void GlBuffer::read(void* data, size_t size, size_t offset) const {
    gl.GetNamedBufferSubData(_id, GLintptr(offset), GLsizeiptr(size), data);
}

int largestTexture() {
    const std::string fault = glFault("textureSize");
    if (!fault.empty()) return std::max(1, std::atoi(fault.c_str()));
    GLint largest = 0;
    gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    return largest;
}

GlTexture::GlTexture(GLenum target, GLenum format, int width, int height, int depth, int levels)
    : _width(width), _height(height), _levels(levels) {
    if (levels == 0)
        for (int side = std::max(width, height); side > 0; side /= 2)
            ++_levels;
    gl.CreateTextures(target, 1, &_id);
    if (target == GL_TEXTURE_2D_ARRAY || target == GL_TEXTURE_3D)
        gl.TextureStorage3D(_id, _levels, format, width, height, depth);
    else
        gl.TextureStorage2D(_id, _levels, format, width, height);
}

GlTexture::~GlTexture() {
    if (_id) gl.DeleteTextures(1, &_id);
}

GlFramebuffer::GlFramebuffer(const std::vector<const GlTexture*>& colors, const GlTexture* depth) {
    gl.CreateFramebuffers(1, &_id);
    std::vector<GLenum> buffers;
    for (size_t i = 0; i < colors.size(); ++i) {
        buffers.push_back(GLenum(GL_COLOR_ATTACHMENT0 + i));
        gl.NamedFramebufferTexture(_id, buffers.back(), colors[i]->id(), 0);
    }
    if (depth) gl.NamedFramebufferTexture(_id, GL_DEPTH_ATTACHMENT, depth->id(), 0);
    if (buffers.empty()) buffers.push_back(GL_NONE);
    gl.NamedFramebufferDrawBuffers(_id, GLsizei(buffers.size()), buffers.data());
}

GlFramebuffer::~GlFramebuffer() {
    if (_id) gl.DeleteFramebuffers(1, &_id);
}

bool GlFramebuffer::complete() const {
    return _id && gl.CheckNamedFramebufferStatus(_id, GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
}

} // namespace patina
