// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/gl/glDownload.h"

#include "hdDelegate/parallel.h"

#include <algorithm>
#include <cstring>

namespace patina {

GlDownload::~GlDownload() {
    if (_id) gl.DeleteBuffers(1, &_id);
}

void GlDownload::read(const GlTexture& from, GLenum format, GLenum type, size_t bytes, void* to) {
    if (bytes == 0) return;
    const size_t rows = size_t(from.height()), row = bytes / rows;
    const size_t most = std::max<size_t>(1, std::min(rows, _most / std::max<size_t>(row, 1)));
    for (size_t y = 0; y < rows; y += most) {
        const size_t some = std::min(most, rows - y);
        readRows(from, format, type, int(y), int(some), some * row,
                 static_cast<char*>(to) + y * row);
    }
}

void GlDownload::readRows(const GlTexture& from, GLenum format, GLenum type, int first, int rows,
                          size_t bytes, char* to) {
    if (bytes > _size) {
        if (_id) gl.DeleteBuffers(1, &_id);
        gl.CreateBuffers(1, &_id);
        // GL_CLIENT_STORAGE_BIT: the program reads it, and the graphics processor only writes.
        gl.NamedBufferStorage(_id, GLsizeiptr(bytes), nullptr,
                              GL_MAP_READ_BIT | GL_CLIENT_STORAGE_BIT);
        _size = bytes;
    }
    gl.BindBuffer(GL_PIXEL_PACK_BUFFER, _id);
    gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl.GetTextureSubImage(from.id(), 0, 0, first, 0, from.width(), rows, 1, format, type,
                          GLsizei(bytes), nullptr);
    gl.BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    const void* mapped = gl.MapNamedBufferRange(_id, 0, GLsizeiptr(bytes), GL_MAP_READ_BIT);
    if (!mapped) return;
    constexpr size_t part = size_t(1) << 18;
    parallelFor(size_t(0), (bytes + part - 1) / part, [&](size_t i) {
        std::memcpy(to + i * part, static_cast<const char*>(mapped) + i * part,
                    std::min(part, bytes - i * part));
    });
    gl.UnmapNamedBuffer(_id);
}

} // namespace patina
