// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/gl/heldFences.h"
#include "hdDelegate/raster/passes/rasterPasses.h"

#include <algorithm>

namespace patina {

void RasterPasses::drawRuns(const RasterDraw& draw, const RasterSurface& surface,
                            const RasterVisible& visible) const {
    const auto [begin, end] = visible.group[size_t(draw.group)];
    if (begin == end) return;
    for (const RasterChunk& chunk : surface.chunks) {
        chunk.bind(_vertexArray);
        const size_t triangles = std::max(1, chunk.indexCount() / 3);
        const int most =
            int(std::clamp<size_t>(HeldFences::mostTriangles() / triangles, 1, 1 << 30));
        for (size_t r = begin; r < end; ++r) {
            const RasterRun& run = visible.runs[r];
            for (int drawn = 0; drawn < run.count; drawn += most)
                gl.DrawElementsInstancedBaseInstance(
                    GL_TRIANGLES, chunk.indexCount(), GL_UNSIGNED_INT, chunk.firstIndex(),
                    std::min(most, run.count - drawn), GLuint(run.first + drawn));
        }
    }
}

} // namespace patina
