// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/raster/scene/rasterCamera.h"
#include "hdDelegate/raster/scene/rasterSplats.h"

namespace patina {

/// The kernels that each square tile of an image may show, the nearest first: in the order of the
/// points where they are densest along one ray for each tile and kernel.
struct SplatTiles {
    struct Entry {
        uint32_t place, kernel; ///< kernel: of all kernels of the scene
    };
    int side = 0;                ///< of a tile, pixels
    int across = 0;              ///< tiles
    std::vector<uint32_t> first; ///< of each tile's entries, row by row from the bottom; the end
    std::vector<Entry> entries;

    /// @param width, height of the image
    /// @param most entries; tiles are larger where there would be more
    SplatTiles(const std::vector<RasterSplatPlace>& placed, const RasterView& view, int width,
               int height, size_t most);
};

/// The part of the window, -1 to 1, outside of which a kernel's alpha is below the cut. After the
/// planes that touch a quadric (Sigg et al. 2006).
struct SplatWindow {
    vec2 low{-1.0f}, high{1.0f};
    vec2 middle{0.0f};
    bool shows = true;    ///< some of it is before the eye
    bool crosses = false; ///< the plane of the eye: low and high are those of all that is seen

    SplatWindow(const SplatKernel& kernel, const mat4& localToClip);
};

} // namespace patina
