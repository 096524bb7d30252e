// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/lights/rasterManyLights.h"

namespace patina {

void RasterManyLights::bind(const std::vector<LightEstimate>& estimates, const LightCells& cells,
                            size_t lights) {
    std::vector<LightEstimate> all = estimates;
    all.resize(lights);
    if (_estimates.size() != all.size() * sizeof(LightEstimate))
        _estimates = GlBuffer(all);
    else
        _estimates.write(all.data(), all.size() * sizeof(LightEstimate));
    _estimates.bindUniform(5);
    constexpr int width = LightCells::aRow * LightCells::listed;
    if (!_lists) {
        _lists = GlTexture(GL_TEXTURE_2D, GL_R32UI, width, LightCells::rows);
        _lists.parameter(GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        _lists.parameter(GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    }
    std::vector<uint32_t> texels = cells.lists;
    const size_t rows = (texels.size() + width - 1) / width;
    texels.resize(rows * width);
    if (rows > 0)
        gl.TextureSubImage2D(_lists.id(), 0, 0, 0, width, GLsizei(rows), GL_RED_INTEGER,
                             GL_UNSIGNED_INT, texels.data());
    _lists.bind(26);
}

} // namespace patina
