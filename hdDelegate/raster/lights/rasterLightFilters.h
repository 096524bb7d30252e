// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/lights/lightFilters.h"
#include "hdDelegate/raster/lights/rasterLightTables.h"
#include "hdDelegate/raster/scene/rasterInstances.h"

#include <map>

namespace patina {

/// Filters of lights as rows of the tables that shaders read: see shaders/lights/filters/rows.glsl.
class RasterLightFilters {
public:
    /// Those of a light in one place.
    /// @returns where they begin in the tables; -1 where it has none that work
    int add(const Light& light, const RasterPlace& place, float timeCode, LightImages& images,
            RasterLightTables& tables, Diagnostics& diagnostics);
    /// Those of a mesh light in all places of its group.
    void addMesh(const Light& light, const std::vector<RasterPlace>& places, float timeCode,
                 LightImages& images, RasterLightTables& tables, Diagnostics& diagnostics);

    /// Filters of a mesh light: -1 where it has none. @param place of its group
    int ofMesh(const std::string& light, size_t place) const;
    /// Where a table of ofMesh() for all places begins; -1 where it has none.
    int tableOfMesh(const std::string& light) const;

private:
    struct OfMesh {
        int table = -1;
        std::vector<int> places;
    };
    int image(const std::shared_ptr<const ImageRGB>& image, RasterLightTables& tables, int& width,
              int& height);

    std::map<std::string, OfMesh> _meshes;
    struct Shown {
        std::shared_ptr<const ImageRGB> image;
        int first = 0, width = 0, height = 0;
    };
    std::vector<Shown> _images;
};

} // namespace patina
