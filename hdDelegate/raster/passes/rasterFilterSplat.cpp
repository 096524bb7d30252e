// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/passes/rasterFilterSplat.h"

#include "hdDelegate/parallel.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace patina {

void takeSplats(std::vector<glm::vec4>& pixels, const RasterSample& sample, const int window[4],
                const Film& film,
                const std::function<void(int x, int y, const glm::vec4& value)>& take) {
    const int width = film.width(), height = film.height();
    const int border = sample.border(), stride = width + 2 * border;
    const int above = std::max(window[1], window[3] + 1);
    const auto rowOf = [&](int y) { // of the film, or beside it
        return &pixels[size_t(height - 1 - y + border) * size_t(stride)] + border;
    };
    // A value that is no number stays where it is, for the film to count.
    std::vector<uint8_t> broken(border > 0 ? pixels.size() : 0, 0);
    if (border > 0)
        parallelFor(0, height + 2 * border, [&](int y) {
            for (int x = 0; x < stride; ++x) {
                const size_t i = size_t(y) * size_t(stride) + size_t(x);
                glm::vec4& p = pixels[i];
                if (std::isfinite(p.x + p.y + p.z + p.w)) continue;
                p = glm::vec4(0.0f);
                broken[i] = 1;
            }
        });
    // The share of number i goes i - border pixels further, so a pixel takes it from there back.
    if (border > 0)
        parallelFor(window[1] - border, above + border, [&](int y) {
            glm::vec4* row = rowOf(y);
            std::vector<glm::vec4> whole(row - border, row + width + border);
            for (int x = window[0]; x <= window[2]; ++x) {
                glm::vec4 sum(0.0f);
                for (int i = 0; i <= 2 * border; ++i)
                    sum += sample.splatX[size_t(i)] * whole[size_t(x + 2 * border - i)];
                row[x] = sum;
            }
        });
    parallelFor(window[1], above, [&](int y) {
        for (int x = window[0]; x <= window[2]; ++x) {
            glm::vec4 sum(0.0f);
            for (int i = 0; i <= 2 * border; ++i)
                sum += sample.splatY[size_t(i)] * rowOf(y + border - i)[x];
            if (border > 0 && broken[size_t(&rowOf(y)[x] - pixels.data())] != 0) sum.x = NAN;
            take(x, y, sum);
        }
    });
}

void addSplats(std::vector<glm::vec4>& pixels, const RasterSample& sample, const int window[4],
               Film& film) {
    takeSplats(pixels, sample, window, film, [&](int x, int y, const glm::vec4& value) {
        film.addColor(x, y, glm::vec3(value), value.w);
    });
}

} // namespace patina
