// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/scene/rasterDrawList.h"

#include "hdDelegate/raster/gl/heldFences.h"

#include <algorithm>

namespace patina {

namespace {

constexpr size_t bindable = size_t(1) << 18; ///< records that one binding shows, 8 MB

} // namespace

void RasterDrawList::add(const RasterDraw& draw, const RasterSurface& surface,
                         const RasterVisible& visible) {
    const auto [begin, end] = visible.group[size_t(draw.group)];
    if (begin == end) return;
    uint32_t first = draw.noise + 0x9e3779b9u * uint32_t(draw.subset);
    for (const RasterChunk& chunk : surface.chunks) {
        const uint32_t triangles = std::max(1u, chunk.indexCount() / 3);
        Record record;
        record.info = glm::ivec4(surface.primvarBits, draw.primId, draw.flags, draw.values);
        record.rows = glm::ivec4(int(first), chunk.firstTriangle(), chunk.firstPrimvar(),
                                 chunk.firstVertex());
        first += triangles;
        const int most =
            int(std::clamp<size_t>(HeldFences::mostTriangles() / triangles, 1, 1 << 30));
        for (size_t r = begin; r < end; ++r) {
            const RasterRun& run = visible.runs[r];
            for (int drawn = 0; drawn < run.count; drawn += most) {
                _commands.push_back({chunk.indexCount(), GLuint(std::min(most, run.count - drawn)),
                                     chunk.firstIndex(), chunk.firstVertex(),
                                     GLuint(run.first + drawn)});
                _records.push_back(record);
                _chunks.push_back(&chunk);
            }
        }
    }
}

void RasterDrawList::upload(bool shades) {
    _bound = nullptr;
    if (_commands.empty()) return;
    _commandBuffer = GlBuffer(_commands);
    if (shades) _recordBuffer = GlBuffer(_records);
}

void RasterDrawList::draw(GLuint vertexArray, size_t first, size_t last, bool shades) {
    if (first >= last) return;
    if (!_bound) gl.BindBuffer(GL_DRAW_INDIRECT_BUFFER, _commandBuffer.id());
    for (size_t i = first, next; i < last; i = next) {
        const RasterChunk& chunk = *_chunks[i];
        const size_t firstRecord = i / bindable * bindable;
        if (shades && (!(_bound && _boundShades) || firstRecord != _firstRecord))
            _recordBuffer.bindStorage(12, firstRecord * sizeof(Record),
                                      std::min(bindable, _records.size() - firstRecord) *
                                          sizeof(Record));
        if (shades) _firstRecord = firstRecord;
        if (!_bound || !chunk.sharesBindings(*_bound) || (shades && !_boundShades))
            chunk.bind(vertexArray, shades);
        _boundShades = shades || (_bound && _boundShades && chunk.sharesBindings(*_bound));
        _bound = &chunk;
        size_t triangles = 0;
        for (next = i; next < last; ++next) {
            const Command& c = _commands[next];
            triangles += size_t(c.count) / 3 * c.instances;
            if (next > i && (triangles > HeldFences::mostTriangles() ||
                             (shades && (!gl.tellsDraws || next % bindable == 0)) ||
                             !_chunks[next]->sharesBindings(chunk)))
                break;
        }
        if (shades) gl.Uniform1i(18, GLint(i - firstRecord));
        gl.MultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT,
                                     reinterpret_cast<const void*>(i * sizeof(Command)),
                                     GLsizei(next - i), 0);
    }
}

} // namespace patina
