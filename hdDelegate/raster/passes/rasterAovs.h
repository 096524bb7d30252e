// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/film/film.h"
#include "hdDelegate/raster/passes/rasterAovRequest.h"
#include "hdDelegate/raster/scene/rasterCamera.h"

namespace patina {

/// Results of the AOV pass, by pixel, rows from the bottom as OpenGL counts.
struct RasterAovImages {
    std::vector<vec4> positions; ///< world space beside the origin, w 0 where nothing is
    std::vector<vec4> normals, albedos;
    std::vector<std::vector<vec4>> primvars;
    std::vector<int> ids; ///< prim, instance, element, place of the prim
};

/// Writes what the AOV pass found into a film.
struct RasterAovs {
    const RasterCamera& camera;
    const std::vector<AovSpec>& aovs;
    vec3 origin; ///< of positions
    int width, height;
    const int* window; ///< pixels that are written: xmin, ymin, xmax, ymax, inclusive

    /// @param request that the images were made for
    void write(const RasterAovImages& images, const RasterAovRequest& request, Film& film) const;
};

} // namespace patina
