// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/gl/heldFences.h"
#include "hdDelegate/raster/passes/rasterPasses.h"

#include <algorithm>

namespace patina {

void RasterPasses::drawRuns(const RasterDraw& draw, const RasterSurface& surface,
                            const RasterVisible& visible, bool shades) const {
    const auto [begin, end] = visible.group[size_t(draw.group)];
    if (begin == end) return;
    uint32_t first = draw.noise + 0x9e3779b9u * uint32_t(draw.subset);
    for (const RasterChunk& chunk : surface.chunks) {
        const uint32_t triangles = uint32_t(std::max(1, chunk.indexCount() / 3));
        chunk.bind(_vertexArray, shades);
        if (shades) gl.Uniform1ui(18, first);
        first += triangles;
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
