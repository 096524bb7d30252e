#pragma once

#include "hdDelegate/film/film.h"
#include "hdDelegate/raster/rasterCamera.h"

namespace patina {

/// Writes what the AOV pass found into a film.
struct RasterAovs {
    const RasterCamera& camera;
    const std::vector<AovSpec>& aovs;
    int width, height;
    const int* window; ///< pixels that are written: xmin, ymin, xmax, ymax, inclusive

    /// @param positions world space, w 0 where nothing is; @param ids prim, instance, element, -.
    /// Rows from the bottom, as OpenGL counts.
    void write(const std::vector<vec4>& positions, const std::vector<vec4>& normals,
               const std::vector<int>& ids, Film& film) const;
};

} // namespace patina
