// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/film/film.h"
#include "hdDelegate/raster/scene/rasterScene.h"

#include <map>

namespace patina {

/// Names what the passes of a render see, for the AOVs of Cryptomatte.
class RasterMattes {
public:
    /// @param aovs of the film
    RasterMattes(const RasterScene& scene, float timeCode, const std::vector<AovSpec>& aovs);
    bool wanted() const { return !_aovs.empty(); }

    /// Counts one sample of every pixel.
    /// @param ids of aovs.frag.glsl, rows from the bottom
    /// @param window xmin, ymin, xmax, ymax of the film, inclusive, y down
    void count(const std::vector<int>& ids, int width, int height, const int window[4],
               Film& film) const;

private:
    struct Prim {
        std::shared_ptr<const Geometry> prim;
        const std::vector<RasterPlace>* places = nullptr;
        std::vector<size_t> slots; ///< of materials, by element; empty: 0
    };
    static std::vector<size_t> slotsOf(const Geometry& prim);
    static std::string nameOf(AovId id, const Prim& prim, int place, int element);

    std::vector<std::pair<int, AovId>> _aovs; ///< with places in the film
    std::unique_ptr<RasterInstances> _places;
    std::map<int, Prim> _prims; ///< by primId
};

} // namespace patina
