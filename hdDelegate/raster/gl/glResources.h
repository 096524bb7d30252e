// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/raster/gl/glFunctions.h"

#include <cstddef>
#include <utility>
#include <vector>

namespace patina {

/// Buffer of a fixed size. Like all of these: made, used and destroyed with one context current,
/// movable, empty when default constructed.
class GlBuffer {
public:
    GlBuffer() = default;
    static constexpr size_t minSize = 16; ///< bytes, since OpenGL knows no empty buffer
    /// @param data null leaves the contents open. Sizes in bytes; what is smaller than minSize
    /// is followed by zeros.
    GlBuffer(size_t size, const void* data);
    template <typename T> explicit GlBuffer(const std::vector<T>& v)
        : GlBuffer(v.size() * sizeof(T), v.data()) {}
    ~GlBuffer();
    GlBuffer(GlBuffer&& o) noexcept { swap(o); }
    GlBuffer& operator=(GlBuffer&& o) noexcept {
        swap(o);
        return *this;
    }

    GLuint id() const { return _id; }
    size_t size() const { return _size; }
    void write(const void* data, size_t size, size_t offset = 0);
    void read(void* data, size_t size, size_t offset = 0) const;
    void bindStorage(GLuint binding) const {
        gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, _id);
    }
    /// @param offset,size in bytes; the offset a multiple of 256
    void bindStorage(GLuint binding, size_t offset, size_t size) const {
        gl.BindBufferRange(GL_SHADER_STORAGE_BUFFER, binding, _id, GLintptr(offset),
                           GLsizeiptr(size));
    }
    void bindUniform(GLuint binding) const { gl.BindBufferBase(GL_UNIFORM_BUFFER, binding, _id); }

private:
    void swap(GlBuffer& o) noexcept {
        std::swap(_id, o._id);
        std::swap(_size, o._size);
    }
    GLuint _id = 0;
    size_t _size = 0;
};

/// Pixels along a side of the driver's largest texture.
int largestTexture();

/// A texture with storage that does not change.
class GlTexture {
public:
    GlTexture() = default;
    /// @param target GL_TEXTURE_2D, GL_TEXTURE_2D_MULTISAMPLE is not among them
    /// @param levels 0: the whole mip chain
    GlTexture(GLenum target, GLenum format, int width, int height, int depth = 1, int levels = 1);
    ~GlTexture();
    GlTexture(GlTexture&& o) noexcept { swap(o); }
    GlTexture& operator=(GlTexture&& o) noexcept {
        swap(o);
        return *this;
    }

    GLuint id() const { return _id; }
    int width() const { return _width; }
    int height() const { return _height; }
    int levels() const { return _levels; }
    explicit operator bool() const { return _id != 0; }
    void bind(GLuint unit) const { gl.BindTextureUnit(unit, _id); }
    void abandon() { _id = 0; } ///< leaves it to the driver: no context is left that knows it
    void parameter(GLenum name, GLint value) const { gl.TextureParameteri(_id, name, value); }
    void filter(GLint both) const { ///< of smaller and larger pictures of it
        parameter(GL_TEXTURE_MIN_FILTER, both);
        parameter(GL_TEXTURE_MAG_FILTER, both);
    }

private:
    void swap(GlTexture& o) noexcept {
        std::swap(_id, o._id);
        std::swap(_width, o._width);
        std::swap(_height, o._height);
        std::swap(_levels, o._levels);
    }
    GLuint _id = 0;
    int _width = 0, _height = 0, _levels = 0;
};

/// Where vertices are read from.
class GlVertexArray {
public:
    GlVertexArray() { gl.CreateVertexArrays(1, &_id); }
    ~GlVertexArray() { gl.DeleteVertexArrays(1, &_id); }
    GlVertexArray(const GlVertexArray&) = delete;
    GlVertexArray& operator=(const GlVertexArray&) = delete;
    GLuint id() const { return _id; }

private:
    GLuint _id = 0;
};

/// Colour attachments 0.. and a depth attachment, which it does not own.
class GlFramebuffer {
public:
    GlFramebuffer() = default;
    GlFramebuffer(const std::vector<const GlTexture*>& colors, const GlTexture* depth);
    ~GlFramebuffer();
    GlFramebuffer(GlFramebuffer&& o) noexcept { std::swap(_id, o._id); }
    GlFramebuffer& operator=(GlFramebuffer&& o) noexcept {
        std::swap(_id, o._id);
        return *this;
    }

    GLuint id() const { return _id; }
    bool complete() const;
    void bind() const { gl.BindFramebuffer(GL_FRAMEBUFFER, _id); }

private:
    GLuint _id = 0;
};

} // namespace patina
