// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/raster/gl/glResources.h"

#include <glm/glm.hpp>

#include <vector>

namespace patina {

/// Reads images of textures by way of a buffer that the driver shares with the program. Drivers of
/// graphics processors copy into other memory at a tenth of the speed.
class GlDownload {
public:
    /// @param most bytes that are read at a time: OpenGL counts them by 32 bits
    explicit GlDownload(size_t most = size_t(1) << 30) : _most(most) {}
    ~GlDownload();
    GlDownload(const GlDownload&) = delete;
    GlDownload& operator=(const GlDownload&) = delete;

    /// Reads the largest level of a texture without layers. Waits until the texture is drawn.
    /// @param bytes of `to`: what the image has in that format and type. `to` stays as it is where
    ///        the driver gives no memory, which its errors tell.
    void read(const GlTexture& from, GLenum format, GLenum type, size_t bytes, void* to);
    /// The same of a texture with four numbers in each texel.
    void read(const GlTexture& from, std::vector<glm::vec4>& to) {
        to.resize(size_t(from.width()) * size_t(from.height()));
        read(from, GL_RGBA, GL_FLOAT, to.size() * sizeof(glm::vec4), to.data());
    }

private:
    GLuint _id = 0;
    void readRows(const GlTexture& from, GLenum format, GLenum type, int first, int rows,
                  size_t bytes, char* to);

    size_t _size = 0, _most;
};

} // namespace patina
